// Makes the bodies and materials that rays are traced against from the scene's.
#include "reference/reference_internal.h"
#include "scene/shape.h"
#include "scene/transform.h"

static struct material make_material(const struct scene_material *from) {
    struct material m = {.is = from, .specular = vec3_mul(from->specular, from->specular_weight)};
    for (int i = 0; i < 2; i++)
        m.diffuse[i] = vec3_mul(from->diffuse[i], from->diffuse_weight);
    return m;
}

// The origin is subtracted before any vertex is transformed.
static struct body make_body(const struct reference *r, const struct scene_body *from) {
    struct body body = {.is = from,
                        .object_to_world = transform_relative(from->object_to_world, r->origin),
                        .primitive_count = shape_item_count(from),
                        .instance = NO_INSTANCE};
    body.is_medium = scene_is_medium(r->input.scene, from);
    if (body.is_medium)
        body.filling = scene_medium_material(r->input.scene, from);
    if (from->mesh)
        body.normal_map = transform_for_normals(from->object_to_world.linear);
    return body;
}

// Bodies that show the same mesh with the same edges share its normals.
static const vec3 *make_normals(struct reference *r, uint32_t number) {
    const struct scene_body *own = r->bodies[number].is;
    for (uint32_t i = 0; i < number; i++) {
        const struct body *other = &r->bodies[i];
        if (other->is->mesh == own->mesh && other->is->crease_angle == own->crease_angle && other->normals)
            return other->normals;
    }
    return mesh_smooth_normals(own->mesh, own->crease_angle, &r->arena);
}

// Bodies first, in IR order, then the triangles of instances.
static bool number_primitives(struct reference *r) {
    uint64_t count = 0;
    for (uint32_t i = 0; i < r->input.scene->body_count; i++) {
        r->bodies[i].first_primitive = (uint32_t)count;
        count += r->bodies[i].primitive_count;
    }
    r->primitive_count = r->first_shared = (uint32_t)count;
    for (uint32_t i = 0; i < r->instance_count; i++) {
        r->instances[i].first = (uint32_t)count;
        count += r->bodies[r->instances[i].body].is->triangle_count;
    }
    return count < NO_PRIMITIVE;
}

bool reference_make_bodies(struct reference *r) {
    const struct scene *scene = r->input.scene;
    r->bodies = ARENA_ARRAY(&r->arena, struct body, scene->body_count);
    for (uint32_t i = 0; i < scene->body_count; i++) {
        const struct scene_body *from = &scene->bodies[i];
        r->bodies[i] = make_body(r, from);
        if (from->smooth && from->mesh)
            r->bodies[i].normals = make_normals(r, i);
    }
    r->materials = ARENA_ARRAY(&r->arena, struct material, scene->material_count);
    for (uint32_t i = 0; i < scene->material_count; i++)
        r->materials[i] = make_material(&scene->materials[i]);
    reference_share(r);
    return number_primitives(r);
}

// ---- primitives

static void put(const struct reference *r, double out[3], vec3 v) {
    v = reference_stored3(r, v);
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

bool reference_make_primitive(const struct reference *r, const struct body *body, uint32_t triangle,
                              struct primitive *out) {
    *out = (struct primitive){.body = (uint32_t)(body - r->bodies), .triangle = triangle};
    vec3 corners[3];
    switch (shape_traits(body->is->shape).items) {
    case SHAPE_BALL:
        out->is_sphere = true;
        put(r, out->v[0], body->object_to_world.offset);
        out->v[1][0] = reference_stored(r, body->is->radius);
        return true;
    case SHAPE_TRIANGLES:
        break;
    case SHAPE_CONE:
        out->is_cone = true;
        put(r, out->v[0], body->object_to_world.offset);
        put(r, out->v[1], mat3_column(body->object_to_world.linear, 1));
        put(r, out->v[2], (vec3){body->is->radius, body->is->radius_to, body->is->height});
        return true;
    }
    scene_corners(body->is, &body->object_to_world, triangle, corners);
    for (int k = 0; k < 3; k++)
        put(r, out->v[k], corners[k]);
    vec3 u = vec3_sub(corners[1], corners[0]), v = vec3_sub(corners[2], corners[0]);
    return !vec3_is_zero(vec3_cross(u, v));
}

struct shape_cone reference_cone_of(const struct primitive *p) {
    return (struct shape_cone){{p->v[0][0], p->v[0][1], p->v[0][2]},
                               {p->v[1][0], p->v[1][1], p->v[1][2]},
                               p->v[2][0],
                               p->v[2][1],
                               p->v[2][2]};
}

const struct primitive *reference_primitive(const struct reference *r, uint32_t index,
                                            struct primitive *room) {
    if (index < r->first_shared)
        return &r->primitives[index];
    const struct instance *instance = reference_instance(r, index);
    reference_make_primitive(r, &r->bodies[instance->body], index - instance->first, room);
    return room;
}
