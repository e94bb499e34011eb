#include "scene_map.h"

#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

// What is in an object is where its instance is, and as large.
static bool is_inside(const struct ir_scene *scene, const struct schema_element *element, uint32_t index) {
    return ir_copies_instance(scene->copies, ir_walk_pool(element), index) != 0;
}

static void map_point(const struct scene_map *map, vec3 *point) {
    if (map->point)
        map->point(point, map->context);
}

static void map_vector(const struct scene_map *map, vec3 *edge) {
    if (map->vector)
        map->vector(edge, map->context);
}

static void map_length(const struct scene_map *map, double *length) {
    if (map->length)
        map->length(length, map->context);
}

static void map_checker(const struct scene_map *map, struct ir_scene *scene, uint32_t material) {
    if (material != IR_NO_INDEX)
        map_length(map, &scene->materials.items[material].diffuse_color.checker.size);
}

static void map_lights(const struct scene_map *map, struct ir_scene *scene) {
    for (uint32_t i = 0; i < scene->lights.count; i++) {
        if (is_inside(scene, &SCHEMA_LIGHT, i))
            continue;
        struct ir_light *light = &scene->lights.items[i];
        if (light->kind == IR_LIGHT_POSITION)
            map_point(map, &light->position);
        map_length(map, &light->radius);
        if (light->kind == IR_LIGHT_RECTANGLE) {
            map_point(map, &light->rectangle.corner);
            map_vector(map, &light->rectangle.edge_u);
            map_vector(map, &light->rectangle.edge_v);
        }
    }
}

static void map_flat_bodies(const struct scene_map *map, struct ir_scene *scene) {
    for (uint32_t i = 0; i < scene->rectangles.count; i++) {
        if (is_inside(scene, &SCHEMA_RECTANGLE, i))
            continue;
        struct ir_rectangle *rectangle = &scene->rectangles.items[i];
        map_point(map, &rectangle->corner);
        map_vector(map, &rectangle->edge_u);
        map_vector(map, &rectangle->edge_v);
        map_checker(map, scene, rectangle->material.index);
    }
    for (uint32_t i = 0; i < scene->boxes.count; i++) {
        if (is_inside(scene, &SCHEMA_BOX, i))
            continue;
        map_point(map, &scene->boxes.items[i].center);
        map_vector(map, &scene->boxes.items[i].size);
        map_checker(map, scene, scene->boxes.items[i].material.index);
    }
    for (uint32_t i = 0; i < scene->models.count; i++) {
        if (is_inside(scene, &SCHEMA_MODEL, i))
            continue;
        map_point(map, &scene->models.items[i].translation);
        map_vector(map, &scene->models.items[i].scale);
    }
}

static void map_round_bodies(const struct scene_map *map, struct ir_scene *scene) {
    for (uint32_t i = 0; i < scene->spheres.count; i++) {
        if (is_inside(scene, &SCHEMA_SPHERE, i))
            continue;
        map_point(map, &scene->spheres.items[i].center);
        map_length(map, &scene->spheres.items[i].radius);
        map_checker(map, scene, scene->spheres.items[i].material.index);
    }
    for (uint32_t i = 0; i < scene->cylinders.count; i++) {
        if (is_inside(scene, &SCHEMA_CYLINDER, i))
            continue;
        struct ir_cylinder *cylinder = &scene->cylinders.items[i];
        map_point(map, &cylinder->from);
        map_point(map, &cylinder->to);
        map_length(map, &cylinder->radius);
        map_checker(map, scene, cylinder->material.index);
    }
    for (uint32_t i = 0; i < scene->cones.count; i++) {
        if (is_inside(scene, &SCHEMA_CONE, i))
            continue;
        struct ir_cone *cone = &scene->cones.items[i];
        map_point(map, &cone->from);
        map_point(map, &cone->to);
        map_length(map, &cone->radius_from);
        map_length(map, &cone->radius_to);
        map_checker(map, scene, cone->material.index);
    }
}

static void map_instances(const struct scene_map *map, struct ir_scene *scene) {
    for (uint32_t i = 0; i < scene->instances.count; i++) {
        struct ir_instance *instance = &scene->instances.items[i];
        if (is_inside(scene, &SCHEMA_INSTANCE, i))
            continue;
        map_point(map, &instance->translation);
        map_vector(map, &instance->scale);
        if (instance->matrix.rows.count != 3)
            continue;
        struct ir_matrix_row *rows = instance->matrix.rows.items;
        vec3 offset = {rows[0].numbers.t, rows[1].numbers.t, rows[2].numbers.t};
        map_point(map, &offset);
        rows[0].numbers.t = offset.x, rows[1].numbers.t = offset.y, rows[2].numbers.t = offset.z;
        for (int k = 0; k < 3; k++) {
            vec3 row = {rows[k].numbers.x, rows[k].numbers.y, rows[k].numbers.z};
            map_vector(map, &row);
            rows[k].numbers.x = row.x, rows[k].numbers.y = row.y, rows[k].numbers.z = row.z;
        }
    }
}

void scene_map_apply(struct ir_scene *scene, const struct scene_map *map) {
    for (uint32_t i = 0; i < scene->cameras.count; i++) {
        map_point(map, &scene->cameras.items[i].position);
        map_point(map, &scene->cameras.items[i].look_at);
    }
    map_lights(map, scene);
    map_flat_bodies(map, scene);
    map_round_bodies(map, scene);
    map_instances(map, scene);
}
