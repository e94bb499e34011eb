#include "flat_kit.h"
#include "tracer/gpu_records.h"

#include "grammar/schema.h"
#include "shaders/gpu_scene.h"
#include "shaders/records.h"

#include <stdlib.h>
#include <string.h>

void kit_init(struct kit *kit) {
    memset(kit, 0, sizeof *kit);
    arena_init(&kit->arena, SIZE_MAX);
    schema_init(&SCHEMA_SCENE, &kit->scene);
    kit->scene.materials.items = ARENA_ARRAY(&kit->arena, struct ir_material, KIT_MAX);
    kit->scene.spheres.items = ARENA_ARRAY(&kit->arena, struct ir_sphere, KIT_MAX);
    kit->scene.rectangles.items = ARENA_ARRAY(&kit->arena, struct ir_rectangle, KIT_MAX);
    kit->scene.boxes.items = ARENA_ARRAY(&kit->arena, struct ir_box, KIT_MAX);
    kit->scene.cylinders.items = ARENA_ARRAY(&kit->arena, struct ir_cylinder, KIT_MAX);
    kit->scene.cones.items = ARENA_ARRAY(&kit->arena, struct ir_cone, KIT_MAX);
    kit->scene.models.items = ARENA_ARRAY(&kit->arena, struct ir_model, KIT_MAX);
    kit->assets.materials = ARENA_ARRAY(&kit->arena, struct ir_material, KIT_MAX + 1);
    kit->assets.models = ARENA_ARRAY(&kit->arena, struct assets_model, KIT_MAX);
    kit->view.lights = ARENA_ARRAY(&kit->arena, struct view_light, KIT_LIGHTS);
    kit->limits = limits_default();
    diag_sink_init(&kit->sink);
}

void kit_finish(struct kit *kit) {
    diag_sink_finish(&kit->sink);
    arena_finish(&kit->arena);
}

struct ir_material *kit_material(struct kit *kit) {
    struct ir_material *material = &kit->scene.materials.items[kit->scene.materials.count++];
    schema_init(&SCHEMA_MATERIAL, material);
    return material;
}

struct ir_sphere *kit_sphere(struct kit *kit) {
    struct ir_sphere *sphere = &kit->scene.spheres.items[kit->scene.spheres.count++];
    schema_init(&SCHEMA_SPHERE, sphere);
    sphere->radius = 1;
    sphere->material.index = IR_NO_INDEX;
    return sphere;
}

struct ir_rectangle *kit_rectangle(struct kit *kit) {
    struct ir_rectangle *rectangle = &kit->scene.rectangles.items[kit->scene.rectangles.count++];
    schema_init(&SCHEMA_RECTANGLE, rectangle);
    rectangle->edge_u = (vec3){1, 0, 0};
    rectangle->edge_v = (vec3){0, 1, 0};
    rectangle->material.index = IR_NO_INDEX;
    return rectangle;
}

struct ir_box *kit_box(struct kit *kit) {
    struct ir_box *box = &kit->scene.boxes.items[kit->scene.boxes.count++];
    schema_init(&SCHEMA_BOX, box);
    box->size = (vec3){1, 1, 1};
    box->material.index = IR_NO_INDEX;
    return box;
}

struct ir_cylinder *kit_cylinder(struct kit *kit) {
    struct ir_cylinder *cylinder = &kit->scene.cylinders.items[kit->scene.cylinders.count++];
    schema_init(&SCHEMA_CYLINDER, cylinder);
    cylinder->to = (vec3){0, 1, 0};
    cylinder->radius = 1;
    cylinder->material.index = IR_NO_INDEX;
    return cylinder;
}

struct ir_cone *kit_cone(struct kit *kit) {
    struct ir_cone *cone = &kit->scene.cones.items[kit->scene.cones.count++];
    schema_init(&SCHEMA_CONE, cone);
    cone->to = (vec3){0, 1, 0};
    cone->radius_from = 1;
    cone->material.index = IR_NO_INDEX;
    return cone;
}

struct ir_model *kit_model(struct kit *kit, struct mesh *mesh) {
    uint32_t i = kit->scene.models.count++;
    struct ir_model *model = &kit->scene.models.items[i];
    schema_init(&SCHEMA_MODEL, model);
    model->material.index = IR_NO_INDEX;
    kit->assets.models[i].mesh = mesh;
    kit->assets.models[i].group_material = ARENA_ARRAY(&kit->arena, uint32_t, 1);
    kit->assets.models[i].group_material[0] = UINT32_MAX;
    kit->assets.model_count = i + 1;
    return model;
}

struct view_light *kit_light(struct kit *kit, vec3 position) {
    struct view_light *light = &kit->view.lights[kit->view.light_count++];
    *light = (struct view_light){.position = position, .emission = {1, 1, 1}};
    return light;
}

void kit_use_material(struct ir_reference *ref, uint32_t index) {
    ref->index = index;
}

void kit_model_material(struct kit *kit, uint32_t model, uint32_t index) {
    kit->scene.models.items[model].material.index = index;
    kit->assets.models[model].group_material[0] = index;
}

struct mesh *kit_mesh(struct kit *kit, const vec3 *positions, uint32_t position_count,
                      const uint32_t (*faces)[3], uint32_t face_count, bool closed) {
    struct mesh *mesh = ARENA_NEW(&kit->arena, struct mesh);
    mesh->positions = ARENA_ARRAY(&kit->arena, vec3, position_count);
    mesh->merged = ARENA_ARRAY(&kit->arena, uint32_t, position_count);
    memcpy(mesh->positions, positions, position_count * sizeof *positions);
    for (uint32_t i = 0; i < position_count; i++)
        mesh->merged[i] = i;
    mesh->position_count = position_count;
    mesh->triangles = ARENA_ARRAY(&kit->arena, struct mesh_triangle, face_count);
    for (uint32_t i = 0; i < face_count; i++)
        mesh->triangles[i] = (struct mesh_triangle){
            {faces[i][0], faces[i][1], faces[i][2]}, {IR_NO_INDEX, IR_NO_INDEX, IR_NO_INDEX}, 0, i + 1};
    mesh->triangle_count = face_count;
    mesh->groups = ARENA_NEW(&kit->arena, struct mesh_group);
    mesh->group_count = 1;
    mesh->closed = closed;
    return mesh;
}

static double on_grid(double value, double grid) {
    return grid > 0 ? rint(value / grid) * grid : value;
}

// The position between two others, made once an edge.
static uint32_t middle(vec3 *positions, uint32_t *count, uint32_t *table, uint32_t a, uint32_t b,
                       uint32_t slots) {
    uint32_t low = a < b ? a : b;
    uint32_t high = a < b ? b : a;
    uint32_t slot = (low * 2654435761u ^ high * 40503u) % slots;
    while (table[3 * (size_t)slot] &&
           (table[3 * (size_t)slot] != low + 1 || table[3 * (size_t)slot + 1] != high))
        slot = (slot + 1) % slots;
    uint32_t *entry = &table[3 * (size_t)slot];
    if (!entry[0]) {
        entry[0] = low + 1;
        entry[1] = high;
        entry[2] = *count;
        positions[(*count)++] = vec3_unit(vec3_add(positions[a], positions[b]));
    }
    return entry[2];
}

struct mesh *kit_icosphere(struct kit *kit, int levels, double grid) {
    static const uint32_t start[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                          {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                          {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                          {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    const double g = 1.618033988749895;
    const vec3 corners[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    uint32_t faces = 20;
    uint32_t last = 20u << (2 * levels);
    uint32_t slots = last * 3;
    vec3 *positions = ARENA_ARRAY(&kit->arena, vec3, last);
    uint32_t(*indices)[3] = arena_alloc_array(&kit->arena, last, sizeof *indices);
    uint32_t(*old)[3] = arena_alloc_array(&kit->arena, last, sizeof *old);
    uint32_t *table = ARENA_ARRAY(&kit->arena, uint32_t, 3 * (size_t)slots);
    uint32_t count = 12;
    for (int i = 0; i < 12; i++)
        positions[i] = vec3_unit(corners[i]);
    memcpy(indices, start, sizeof start);
    for (int level = 0; level < levels; level++, faces *= 4) {
        memcpy(old, indices, faces * sizeof *old);
        for (uint32_t i = 0; i < faces; i++) {
            uint32_t mid[3];
            for (int k = 0; k < 3; k++)
                mid[k] = middle(positions, &count, table, old[i][k], old[i][(k + 1) % 3], slots);
            for (int k = 0; k < 3; k++)
                memcpy(indices[4 * i + (uint32_t)k], (uint32_t[3]){old[i][k], mid[k], mid[(k + 2) % 3]},
                       sizeof *old);
            memcpy(indices[4 * i + 3], mid, sizeof *old);
        }
    }
    for (uint32_t i = 0; i < count; i++)
        positions[i] = (vec3){on_grid(positions[i].x, grid), on_grid(positions[i].y, grid),
                              on_grid(positions[i].z, grid)};
    return kit_mesh(kit, positions, count, (const uint32_t(*)[3])indices, faces, true);
}

void kit_resolve(struct kit *kit) {
    uint32_t count = kit->scene.materials.count;
    memcpy(kit->assets.materials, kit->scene.materials.items, count * sizeof *kit->assets.materials);
    schema_init(&SCHEMA_MATERIAL, &kit->assets.materials[count]);
    kit->assets.material_count = count + 1;
    for (uint32_t i = 0; i < kit->scene.models.count; i++)
        if (kit->scene.models.items[i].material.index == IR_NO_INDEX)
            kit->assets.models[i].group_material[0] = count;
    scene_build(&kit->scene, &kit->assets, &kit->arena, &kit->resolved);
}

bool kit_flatten(struct kit *kit, struct flat_scene *flat) {
    kit_resolve(kit);
    return kit_flatten_resolved(kit, flat);
}

bool kit_flatten_resolved(struct kit *kit, struct flat_scene *flat) {
    struct flat_input input = {.scene = &kit->resolved,
                               .view = &kit->view,
                               .origin = kit->origin,
                               .is_double = kit->is_double,
                               .limits = &kit->limits,
                               .sink = &kit->sink};
    return flatten(&input, flat);
}

float kit_float(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

vec3 kit_vertex(const struct flat_scene *flat, uint32_t item, int corner) {
    if (flat->is_double) {
        const struct gpu_word *first =
            &flat->triangles.words[(size_t)TRIANGLE64_WORDS * item + (size_t)corner];
        const struct gpu_word *rest = first + TRIANGLE_REST;
        return (vec3){gpu_split_value(kit_float(first->x), rest->x),
                      gpu_split_value(kit_float(first->y), rest->y),
                      gpu_split_value(kit_float(first->z), rest->z)};
    }
    const struct gpu_word *word = &flat->triangles.words[(size_t)TRIANGLE_WORDS * item + (size_t)corner];
    return (vec3){kit_float(word->x), kit_float(word->y), kit_float(word->z)};
}

uint32_t kit_number(const struct flat_scene *flat, uint32_t item) {
    return flat->triangles.words[(size_t)flat->strides.triangle * item].w;
}

uint32_t kit_find_triangle(const struct flat_scene *flat, uint32_t number) {
    for (uint32_t i = 0; i < flat->triangle_count; i++)
        if (kit_number(flat, i) == number)
            return i;
    return UINT32_MAX;
}
