// The bodies of a scene, from the IR's lists and the loaded meshes.
#include "core/heap.h"
#include "core/limits.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"
#include "scene/scene_parts.h"
#include "scene/transform.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

enum {
    PARALLELOGRAM_TRIANGLES = 2
};

// ---- boxes

struct box {
    vec3 lower, upper;
};

static const struct box EMPTY = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void include(struct box *box, vec3 point) {
    box->lower = vec3_least(box->lower, point);
    box->upper = vec3_greatest(box->upper, point);
}

static struct box sphere_box(vec3 center, double radius) {
    vec3 arm = {radius, radius, radius};
    return (struct box){vec3_sub(center, arm), vec3_add(center, arm)};
}

static struct box triangles_box(const struct scene_body *body, const affine3 *map) {
    struct box box = EMPTY;
    for (uint32_t i = 0; i < body->triangle_count; i++) {
        vec3 corners[3];
        scene_corners(body, map, i, corners);
        for (int k = 0; k < 3; k++)
            include(&box, corners[k]);
    }
    return box;
}

static struct box positions_box(const struct mesh *mesh, const affine3 *map) {
    struct box box = EMPTY;
    for (uint32_t i = 0; i < mesh->position_count; i++)
        include(&box, affine3_apply(*map, mesh->positions[i]));
    return box;
}

// Around the transformed corners of the mesh's own box.
static struct box transformed_box(const struct mesh *mesh, const affine3 *map) {
    struct box box = EMPTY;
    for (int i = 0; i < 8; i++)
        include(&box, affine3_apply(*map, (vec3){i & 1 ? mesh->upper.x : mesh->lower.x,
                                                 i & 2 ? mesh->upper.y : mesh->lower.y,
                                                 i & 4 ? mesh->upper.z : mesh->lower.z}));
    return box;
}

static struct box box_of(const struct scene_body *body) {
    if (body->shape == SCENE_SPHERE)
        return sphere_box(body->object_to_world.offset, body->radius);
    return body->mesh ? transformed_box(body->mesh, &body->object_to_world)
                      : triangles_box(body, &body->object_to_world);
}

void scene_body_place(struct scene_body *body, affine3 object_to_world, double radius) {
    body->object_to_world = object_to_world;
    body->radius = radius;
    body->mirrored = mat3_determinant(object_to_world.linear) < 0;
    struct box box = box_of(body);
    body->lower = box.lower;
    body->upper = box.upper;
}

// ---- bodies

struct building {
    struct scene *scene;
    uint32_t *material; // the next place for a body's one material
};

static struct scene_body *add(struct building *b, const struct schema_element *element, uint32_t index,
                              const struct ir_head *head, str name) {
    struct scene_body *body = &b->scene->bodies[b->scene->body_count++];
    *body = (struct scene_body){.element = element, .index = index, .head = head, .name = name};
    return body;
}

static void take_material(struct building *b, struct scene_body *body, const struct ir_material_ref *ref) {
    *b->material = assets_material(b->scene->ir, ref);
    body->materials = b->material++;
    body->group_count = 1;
}

affine3 scene_parallelogram(vec3 corner, vec3 u, vec3 v) {
    return (affine3){{{{u.x, v.x, 0}, {u.y, v.y, 0}, {u.z, v.z, 0}}}, corner};
}

static void add_sphere(struct building *b, uint32_t i) {
    static const mat3 identity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const struct ir_sphere *ir = &b->scene->ir->spheres.items[i];
    struct scene_body *body = add(b, &SCHEMA_SPHERE, i, &ir->head, ir->name);
    body->shape = SCENE_SPHERE;
    body->closed = true;
    take_material(b, body, &ir->material);
    scene_body_place(body, (affine3){identity, ir->center}, ir->radius);
}

static void add_rectangle(struct building *b, uint32_t i) {
    const struct ir_rectangle *ir = &b->scene->ir->rectangles.items[i];
    struct scene_body *body = add(b, &SCHEMA_RECTANGLE, i, &ir->head, ir->name);
    body->shape = SCENE_PARALLELOGRAM;
    body->triangle_count = PARALLELOGRAM_TRIANGLES;
    take_material(b, body, &ir->material);
    scene_body_place(body, scene_parallelogram(ir->corner, ir->edge_u, ir->edge_v), 0);
}

static void add_model(struct building *b, uint32_t i) {
    const struct ir_model *ir = &b->scene->ir->models.items[i];
    const struct assets *assets = b->scene->assets;
    struct scene_body *body = add(b, &SCHEMA_MODEL, i, &ir->head, ir->name);
    body->shape = SCENE_MESH;
    body->smooth = ir->smooth;
    if (i < assets->model_count && assets->models[i].mesh) {
        body->mesh = assets->models[i].mesh;
        body->materials = assets->models[i].group_material;
        body->group_count = body->mesh->group_count;
        body->triangle_count = body->mesh->triangle_count;
        body->closed = body->mesh->closed;
    }
    scene_body_place(body, transform_of_model(ir), 0);
}

// The kinds of bodies, in the order in which bodies are numbered.
static const struct kind {
    const struct schema_element *element;
    void (*add)(struct building *b, uint32_t i);
} KINDS[] = {
    {&SCHEMA_SPHERE, add_sphere},
    {&SCHEMA_RECTANGLE, add_rectangle},
    {&SCHEMA_MODEL, add_model},
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
    struct building b = {scene, ARENA_ARRAY(arena, uint32_t, total)};
    scene->bodies = ARENA_ARRAY(arena, struct scene_body, total);
    for (int i = 0; i < KIND_COUNT; i++)
        for (uint32_t k = 0; k < counts[i]; k++)
            KINDS[i].add(&b, k);
}

// ---- questions about bodies

uint32_t scene_body_material(const struct scene_body *body, uint32_t triangle) {
    return body->materials[body->mesh ? body->mesh->triangles[triangle].group : 0];
}

// Shared corners are computed in one way, so that both triangles hold the same bits.
static void parallelogram_corners(const affine3 *map, uint32_t triangle, vec3 corners[3]) {
    vec3 v = mat3_column(map->linear, 1);
    vec3 along_u = vec3_add(map->offset, mat3_column(map->linear, 0));
    vec3 opposite = vec3_add(along_u, v);
    corners[0] = map->offset;
    corners[1] = triangle ? opposite : along_u;
    corners[2] = triangle ? vec3_add(map->offset, v) : opposite;
}

void scene_corners(const struct scene_body *body, const affine3 *map, uint32_t triangle, vec3 corners[3]) {
    if (body->shape == SCENE_PARALLELOGRAM) {
        parallelogram_corners(map, triangle, corners);
        return;
    }
    const uint32_t *indices = body->mesh->triangles[triangle].corners;
    for (int k = 0; k < 3; k++)
        corners[k] = affine3_apply(*map, body->mesh->positions[indices[k]]);
}

bool scene_body_bounds(const struct scene_body *body, const affine3 *map, vec3 *lower, vec3 *upper) {
    struct box box = body->shape == SCENE_SPHERE ? sphere_box(map->offset, body->radius)
                     : body->mesh                ? positions_box(body->mesh, map)
                                                 : triangles_box(body, map);
    *lower = box.lower;
    *upper = box.upper;
    return box.lower.x <= box.upper.x;
}

bool scene_bounds(const struct scene *scene, vec3 *lower, vec3 *upper) {
    struct box all = EMPTY;
    for (uint32_t i = 0; i < scene->body_count; i++) {
        struct box own;
        const struct scene_body *body = &scene->bodies[i];
        if (!scene_body_bounds(body, &body->object_to_world, &own.lower, &own.upper))
            continue;
        include(&all, own.lower);
        include(&all, own.upper);
    }
    bool any = all.lower.x <= all.upper.x;
    *lower = any ? all.lower : (vec3){0, 0, 0};
    *upper = any ? all.upper : (vec3){0, 0, 0};
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

struct triangle_use {
    const struct mesh *mesh; // NULL: none
    uint32_t body;
};

static int compare_uses(const void *a, const void *b) {
    const struct triangle_use *x = a, *y = b;
    if (x->mesh != y->mesh)
        return (uintptr_t)x->mesh < (uintptr_t)y->mesh ? -1 : 1;
    return x->body < y->body ? -1 : x->body > y->body;
}

static int compare_bodies(const void *a, const void *b) {
    const struct triangle_use *x = a, *y = b;
    return x->body < y->body ? -1 : x->body > y->body;
}

// The bodies that bring triangles: the first one of each mesh, and all without a mesh, in IR order.
static uint32_t keep_first_uses(struct triangle_use *uses, uint32_t count) {
    uint32_t kept = 0;
    qsort(uses, count, sizeof *uses, compare_uses);
    for (uint32_t i = 0; i < count; i++)
        if (!uses[i].mesh || kept == 0 || uses[kept - 1].mesh != uses[i].mesh)
            uses[kept++] = uses[i];
    qsort(uses, kept, sizeof *uses, compare_bodies);
    return kept;
}

// The body whose triangles exceed `most`, those of a mesh counted once; NULL: none does.
static const struct scene_body *first_over(const struct scene *scene, struct triangle_use *uses,
                                           uint64_t most, uint64_t *total) {
    const struct scene_body *over = NULL;
    *total = 0;
    for (uint32_t i = 0; i < scene->body_count; i++)
        uses[i] = (struct triangle_use){scene->bodies[i].mesh, i};
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

// Reported at the body with which there are too many.
static bool check_items(const struct scene *scene, struct diag_sink *sink) {
    const struct scene_body *over = NULL;
    uint64_t total = 0;
    for (uint32_t i = 0; i < scene->body_count; i++) {
        total += scene->bodies[i].shape == SCENE_SPHERE ? 1 : scene->bodies[i].triangle_count;
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
    struct triangle_use *uses = heap_array((size_t)scene->body_count + 1, sizeof *uses);
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
