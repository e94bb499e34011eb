// Shares the geometry of the earlier flat scene if nothing that it is made from has changed: after editing a
// material, light or camera, no remaining work grows with the number of triangles.
#include "scene/shape.h"
#include "tracer/flatten/flatten_internal.h"

#include <string.h>

// Records refer to materials by number, and say whether they have a checker.
static bool shows_same_materials(const struct flattening *f, const struct scene_body *was,
                                 const struct scene_body *is) {
    const struct scene_material *old = f->input->before->scene->materials, *now = f->scene->materials;
    for (uint32_t i = 0; i < is->group_count; i++)
        if (was->materials[i] != is->materials[i] ||
            old[was->materials[i]].checker != now[is->materials[i]].checker)
            return false;
    return true;
}

static bool is_same_body(const struct flattening *f, uint32_t number) {
    const struct scene_body *was = &f->input->before->scene->bodies[number];
    const struct scene_body *is = &f->scene->bodies[number];
    return shape_is_same(was, is) && was->group_count == is->group_count && shows_same_materials(f, was, is);
}

bool flatten_is_kept(const struct flattening *f) {
    const struct flat_scene *before = f->input->before, *out = f->out;
    if (!before || before->is_double != out->is_double ||
        !vec3_is_zero(vec3_sub(before->origin, out->origin)) || before->body_count != f->scene->body_count ||
        before->sharing != out->sharing || before->method != out->method ||
        before->most_triangles != out->most_triangles)
        return false;
    for (uint32_t i = 0; i < f->scene->body_count; i++)
        if (!is_same_body(f, i))
            return false;
    return true;
}

void flatten_keep(struct flattening *f) {
    const struct flat_scene *before = f->input->before;
    struct flat_scene *out = f->out;
    out->shares = true;
    out->strides = before->strides;
    out->scale_exponent = before->scale_exponent;
    out->triangle_nodes = before->triangle_nodes;
    out->triangles = before->triangles;
    out->normals = before->normals;
    out->sphere_nodes = before->sphere_nodes;
    out->spheres = before->spheres;
    out->instances = before->instances;
    out->instance_count = before->instance_count;
    out->top_nodes = before->top_nodes;
    out->instance_table = before->instance_table;
    out->instance_shift = before->instance_shift;
    out->uses = before->uses;
    out->use_count = before->use_count;
    out->sphere_count = before->sphere_count;
    out->cone_count = before->cone_count;
    out->triangle_count = before->triangle_count;
    out->shown_triangles = before->shown_triangles;
    out->dropped_triangles = before->dropped_triangles;
    out->triangle_depth = before->triangle_depth;
    out->sphere_depth = before->sphere_depth;
    out->first_triangle = before->first_triangle;
    out->normal_base = before->normal_base;
    out->instance_of = before->instance_of;
    f->factor = ldexp(1, out->scale_exponent);
    for (uint32_t i = 0; i < f->scene->body_count; i++)
        flatten_use_materials(f, &f->scene->bodies[i]);
    bvh_keep_all(f->input->keep);
}

void flat_take(struct flat_scene *flat, struct flat_scene *before) {
    if (!flat->shares)
        return;
    flat->shares = false;
    before->shares = true;
}
