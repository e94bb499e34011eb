// The bodies of a scene, from the IR's lists and the loaded meshes.
#include "core/heap.h"
#include "core/limits.h"
#include "diag/codes/limit.h"
#include "diag/codes/rule.h"
#include "grammar/ir.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"
#include "scene/mesh_use.h"
#include "scene/scene_internal.h"
#include "scene/shape.h"
#include "scene/transform.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PARALLELOGRAM_TRIANGLES = 2
};

// ---- bodies

const struct scene_cells SCENE_CELLS_OWN = {{1, 1, 1}, {0, 0, 0}};

struct building {
    struct scene *scene;
    struct arena *arena;
    uint32_t *material;              // the next place for a body's one material
    const struct scene_cells *cells; // the last ones made
};

static struct scene_body *add(struct building *b, const struct schema_element *element, uint32_t index,
                              const struct ir_head *head, str name) {
    struct scene_body *body = &b->scene->bodies[b->scene->body_count++];
    *body = (struct scene_body){
        .element = element, .index = index, .head = head, .name = name, .cells = &SCENE_CELLS_OWN};
    return body;
}

static void take_material(struct building *b, struct scene_body *body, const struct ir_reference *ref) {
    *b->material = assets_material(b->scene->ir, ref);
    body->materials = b->material++;
    body->group_count = 1;
}

// Bodies one after the other with the same cells share them, as copies of one entry do.
static void set_cells(struct building *b, struct scene_body *body, vec3 scale, vec3 offset) {
    const struct scene_cells wanted = {scale, offset};
    if (!b->cells || memcmp(b->cells, &wanted, sizeof wanted)) {
        struct scene_cells *cells = ARENA_NEW(b->arena, struct scene_cells);
        *cells = wanted;
        b->cells = cells;
    }
    body->cells = b->cells;
}

static void take_mesh(struct scene_body *body, const struct mesh *mesh) {
    body->mesh = mesh;
    body->group_count = mesh->group_count;
    body->triangle_count = mesh->triangle_count;
    body->closed = mesh->closed;
}

affine3 scene_parallelogram(vec3 corner, vec3 u, vec3 v) {
    return (affine3){{{{u.x, v.x, 0}, {u.y, v.y, 0}, {u.z, v.z, 0}}}, corner};
}

static void add_sphere(struct building *b, uint32_t i) {
    const struct ir_sphere *ir = &b->scene->ir->spheres.items[i];
    struct scene_body *body = add(b, &SCHEMA_SPHERE, i, &ir->head, ir->name);
    body->shape = SCENE_SPHERE;
    body->closed = true;
    take_material(b, body, &ir->material);
    scene_body_place(body, transform_of((vec3){1, 1, 1}, ir->rotation, ir->center), ir->radius);
}

static void add_rectangle(struct building *b, uint32_t i) {
    const struct ir_rectangle *ir = &b->scene->ir->rectangles.items[i];
    struct scene_body *body = add(b, &SCHEMA_RECTANGLE, i, &ir->head, ir->name);
    body->shape = SCENE_PARALLELOGRAM;
    body->triangle_count = PARALLELOGRAM_TRIANGLES;
    take_material(b, body, &ir->material);
    scene_body_place(body, scene_parallelogram(ir->corner, ir->edge_u, ir->edge_v), 0);
}

static void add_box(struct building *b, uint32_t i) {
    const struct ir_box *ir = &b->scene->ir->boxes.items[i];
    struct scene_body *body = add(b, &SCHEMA_BOX, i, &ir->head, ir->name);
    body->shape = SCENE_MESH;
    set_cells(b, body, vec3_mul(ir->size, 1 - SCENE_CELLS_WITHIN), (vec3){0, 0, 0});
    take_material(b, body, &ir->material);
    take_mesh(body, scene_box_mesh());
    scene_body_place(body, transform_of(ir->size, ir->rotation, ir->center), 0);
}

static void add_frustum(struct building *b, struct scene_body *body, vec3 from, vec3 to, double radius_from,
                        double radius_to, const struct ir_reference *material) {
    const vec3 axis = vec3_sub(to, from);
    body->shape = SCENE_CONE;
    body->closed = true;
    body->radius_to = radius_to;
    body->height = vec3_length(axis);
    take_material(b, body, material);
    scene_body_place(body, (affine3){scene_cone_frame(axis), from}, radius_from);
}

static void add_cylinder(struct building *b, uint32_t i) {
    const struct ir_cylinder *ir = &b->scene->ir->cylinders.items[i];
    struct scene_body *body = add(b, &SCHEMA_CYLINDER, i, &ir->head, ir->name);
    add_frustum(b, body, ir->from, ir->to, ir->radius, ir->radius, &ir->material);
}

static void add_cone(struct building *b, uint32_t i) {
    const struct ir_cone *ir = &b->scene->ir->cones.items[i];
    struct scene_body *body = add(b, &SCHEMA_CONE, i, &ir->head, ir->name);
    add_frustum(b, body, ir->from, ir->to, ir->radius_from, ir->radius_to, &ir->material);
}

// A flat mesh has no inside: it shows the cells on one side.
static void set_mesh_cells(struct building *b, struct scene_body *body, const struct mesh *mesh) {
    const vec3 size = vec3_sub(mesh->upper, mesh->lower);
    const double most = vec3_max_abs(size) * SCENE_CELLS_WITHIN;
    const double scale = 1 - SCENE_CELLS_WITHIN;
    const vec3 offset = vec3_mul(vec3_add(mesh->lower, mesh->upper), SCENE_CELLS_WITHIN / 2);
    set_cells(b, body, (vec3){scale, scale, scale},
              vec3_add(offset, (vec3){size.x > 0 ? 0 : most, size.y > 0 ? 0 : most, size.z > 0 ? 0 : most}));
}

static void add_model(struct building *b, uint32_t i) {
    const struct ir_model *ir = &b->scene->ir->models.items[i];
    const struct assets *assets = b->scene->assets;
    struct scene_body *body = add(b, &SCHEMA_MODEL, i, &ir->head, ir->name);
    body->shape = SCENE_MESH;
    body->smooth = ir->smooth;
    body->crease_angle = ir->smooth ? ir->crease_angle : 180;
    if (i < assets->model_count && assets->models[i].mesh) {
        body->materials = assets->models[i].group_material;
        take_mesh(body, assets->models[i].mesh);
        if (body->mesh->is_made)
            set_mesh_cells(b, body, body->mesh);
    }
    scene_body_place(body, transform_of(ir->scale, ir->rotation, ir->translation), 0);
}

// The kinds of bodies, in the order in which bodies are numbered.
static const struct kind {
    const struct schema_element *element;
    void (*add)(struct building *b, uint32_t i);
} KINDS[] = {
    {&SCHEMA_SPHERE, add_sphere},     {&SCHEMA_RECTANGLE, add_rectangle}, {&SCHEMA_BOX, add_box},
    {&SCHEMA_CYLINDER, add_cylinder}, {&SCHEMA_CONE, add_cone},           {&SCHEMA_MODEL, add_model},
};

enum {
    KIND_COUNT = sizeof KINDS / sizeof *KINDS
};

bool scene_is_body(const struct schema_element *element) {
    for (int i = 0; i < KIND_COUNT; i++)
        if (KINDS[i].element == element)
            return true;
    return false;
}

void scene_build_bodies(struct scene *scene, struct arena *arena) {
    uint32_t counts[KIND_COUNT];
    uint32_t total = 0;
    for (int i = 0; i < KIND_COUNT; i++)
        total += counts[i] = ir_walk_list(ir_walk_pool(KINDS[i].element), scene->ir).count;
    struct building b = {.scene = scene, .arena = arena, .material = ARENA_ARRAY(arena, uint32_t, total)};
    scene->bodies = ARENA_ARRAY(arena, struct scene_body, total);
    for (int i = 0; i < KIND_COUNT; i++)
        for (uint32_t k = 0; k < counts[i]; k++) {
            const affine3 *place = scene_place(scene, KINDS[i].element, k);
            KINDS[i].add(&b, k);
            if (place)
                scene_body_into(&scene->bodies[scene->body_count - 1], place, arena);
        }
}

// ---- questions about bodies

uint32_t scene_body_material(const struct scene_body *body, uint32_t triangle) {
    return body->materials[body->mesh ? body->mesh->triangles[triangle].group : 0];
}

bool scene_bounds(const struct scene *scene, vec3 *lower, vec3 *upper) {
    bool any = false;
    *lower = *upper = (vec3){0, 0, 0};
    for (uint32_t i = 0; i < scene->body_count; i++) {
        vec3 low, high;
        const struct scene_body *body = &scene->bodies[i];
        if (!scene_body_bounds(body, &body->object_to_world, &low, &high))
            continue;
        *lower = any ? vec3_least(*lower, low) : low;
        *upper = any ? vec3_greatest(*upper, high) : high;
        any = true;
    }
    return any;
}

void scene_check_reach(const struct scene *scene, struct diag_sink *sink) {
    const double most = schema_range_info(SCHEMA_RANGE_COORDINATE)->greatest;
    for (uint32_t i = 0; i < scene->body_count; i++) {
        const struct scene_body *body = &scene->bodies[i];
        if (!body->mesh)
            continue;
        double largest = fmax(vec3_max_abs(body->lower), vec3_max_abs(body->upper));
        if (largest > most)
            diag_add(sink, DIAG_TRANSFORM_OVERFLOW, ir_place_label(scene->assets->origin, body->head),
                     "after scale, rotation and translation the model has coordinates of %.3g; at most 1e18 "
                     "is allowed",
                     largest);
    }
}

static int compare_bodies(const void *a, const void *b) {
    const struct mesh_use *x = a, *y = b;
    return x->body < y->body ? -1 : x->body > y->body;
}

// The bodies that bring triangles: the first body of each mesh, and every body without a mesh, in IR order.
static uint32_t keep_first_uses(struct mesh_use *uses, uint32_t count) {
    uint32_t kept = 0;
    qsort(uses, count, sizeof *uses, mesh_use_compare);
    for (uint32_t i = 0; i < count; i++)
        if (!uses[i].mesh || kept == 0 || uses[kept - 1].mesh != uses[i].mesh)
            uses[kept++] = uses[i];
    qsort(uses, kept, sizeof *uses, compare_bodies);
    return kept;
}

// The body whose triangles push the total over `most`, a mesh counted once; NULL: none does.
static const struct scene_body *first_over(const struct scene *scene, struct mesh_use *uses, uint64_t most,
                                           uint64_t *total) {
    const struct scene_body *over = NULL;
    *total = 0;
    for (uint32_t i = 0; i < scene->body_count; i++)
        uses[i] = (struct mesh_use){scene->bodies[i].mesh, i};
    const uint32_t count = keep_first_uses(uses, scene->body_count);
    for (uint32_t i = 0; i < count; i++) {
        const struct scene_body *body = &scene->bodies[uses[i].body];
        *total += body->triangle_count;
        if (*total > most && !over)
            over = body;
    }
    return over;
}

span scene_body_label(const struct scene *scene, const struct scene_body *body) {
    const struct ir_origin *places = scene->assets->origin;
    return places ? ir_place_label(places, body->head) : SPAN_NONE;
}

// Reported at the body where the count first exceeds the limit.
static bool check_items(const struct scene *scene, struct diag_sink *sink) {
    const struct scene_body *over = NULL;
    uint64_t total = 0;
    for (uint32_t i = 0; i < scene->body_count; i++) {
        total += shape_item_count(&scene->bodies[i]);
        if (total > SCENE_ITEMS_MAX && !over)
            over = &scene->bodies[i];
    }
    if (!over)
        return true;
    diag_add(
        sink, DIAG_LIMIT, scene_body_label(scene, over),
        "with this body all models together show more than %u triangles, those of a mesh counted for each "
        "model; in all they show %" PRIu64,
        SCENE_ITEMS_MAX, total);
    return false;
}

bool scene_check_triangles(const struct scene *scene, const struct limits *limits, struct diag_sink *sink) {
    const struct limit_info *info = limit_info(LIMIT_SCENE_TRIANGLES);
    const uint64_t most = limits->value[LIMIT_SCENE_TRIANGLES];
    struct mesh_use *uses = heap_array((size_t)scene->body_count + 1, sizeof *uses);
    uint64_t total = 0;
    if (!uses) {
        diag_add(sink, DIAG_OUT_OF_MEMORY, SPAN_NONE, "there is not enough memory for the scene's bodies");
        return false;
    }
    const struct scene_body *over = first_over(scene, uses, most, &total);
    free(uses);
    if (!over)
        return check_items(scene, sink);
    diag_add(sink, DIAG_LIMIT, scene_body_label(scene, over),
             "the scene has %" PRIu64 " triangles, those of a mesh counted once; the limit %s is %" PRIu64,
             total, info->name, most);
    if (total <= info->greatest)
        diag_help(sink, "if this is intended, raise the limit: --limit %s=%" PRIu64, info->name, total);
    return false;
}
