#include "scene/shape.h"

#include "core/angle.h"

#include <math.h>
#include <string.h>

struct shape_traits shape_traits(enum scene_shape shape) {
    switch (shape) {
    case SCENE_SPHERE:
        return (struct shape_traits){.items = SHAPE_BALL, .has_radius = true};
    case SCENE_PARALLELOGRAM:
        return (struct shape_traits){.items = SHAPE_TRIANGLES, .is_flat = true};
    case SCENE_MESH:
        return (struct shape_traits){.items = SHAPE_TRIANGLES, .needs_mesh = true, .sees_itself = true};
    }
    return (struct shape_traits){.items = SHAPE_TRIANGLES};
}

bool shape_is_there(const struct scene_body *body) {
    return body->mesh || !shape_traits(body->shape).needs_mesh;
}

uint32_t shape_item_count(const struct scene_body *body) {
    return shape_traits(body->shape).items == SHAPE_BALL ? 1 : body->triangle_count;
}

bool shape_is_same(const struct scene_body *a, const struct scene_body *b) {
    return a->shape == b->shape &&
           memcmp(&a->object_to_world, &b->object_to_world, sizeof b->object_to_world) == 0 &&
           a->radius == b->radius && a->mesh == b->mesh && a->triangle_count == b->triangle_count &&
           a->closed == b->closed && a->mirrored == b->mirrored && a->smooth == b->smooth;
}

// ---- corners

// Shared corners are computed the same way, so both triangles hold the same bits.
static void parallelogram_corners(const affine3 *map, uint32_t triangle, vec3 corners[3]) {
    vec3 v = mat3_column(map->linear, 1);
    vec3 along_u = vec3_add(map->offset, mat3_column(map->linear, 0));
    vec3 opposite = vec3_add(along_u, v);
    corners[0] = map->offset;
    corners[1] = triangle ? opposite : along_u;
    corners[2] = triangle ? vec3_add(map->offset, v) : opposite;
}

void scene_corners(const struct scene_body *body, const affine3 *map, uint32_t triangle, vec3 corners[3]) {
    switch (body->shape) {
    case SCENE_SPHERE: // has no triangles
        break;
    case SCENE_PARALLELOGRAM:
        parallelogram_corners(map, triangle, corners);
        break;
    case SCENE_MESH:
        for (int k = 0; k < 3; k++)
            corners[k] =
                affine3_apply(*map, body->mesh->positions[body->mesh->triangles[triangle].corners[k]]);
        break;
    }
}

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

// `is_least`: for a mesh, the box around its transformed positions, which takes time in proportion to their
// number.
static struct box box_of(const struct scene_body *body, const affine3 *map, bool is_least) {
    switch (body->shape) {
    case SCENE_SPHERE:
        return sphere_box(map->offset, body->radius);
    case SCENE_PARALLELOGRAM:
        return triangles_box(body, map);
    case SCENE_MESH:
        return !body->mesh ? EMPTY
               : is_least  ? positions_box(body->mesh, map)
                           : transformed_box(body->mesh, map);
    }
    return EMPTY;
}

void scene_body_place(struct scene_body *body, affine3 object_to_world, double radius) {
    body->object_to_world = object_to_world;
    body->radius = radius;
    body->mirrored = mat3_determinant(object_to_world.linear) < 0;
    const struct box box = box_of(body, &object_to_world, false);
    body->lower = box.lower;
    body->upper = box.upper;
}

bool scene_body_bounds(const struct scene_body *body, const affine3 *map, vec3 *lower, vec3 *upper) {
    const struct box box = box_of(body, map, true);
    *lower = box.lower;
    *upper = box.upper;
    return box.lower.x <= box.upper.x;
}

// ---- middle and volume

vec3 shape_middle(const struct scene_body *body) {
    const affine3 *map = &body->object_to_world;
    switch (body->shape) {
    case SCENE_SPHERE:
        break;
    case SCENE_PARALLELOGRAM: {
        const vec3 across = vec3_add(mat3_column(map->linear, 0), mat3_column(map->linear, 1));
        return vec3_add(map->offset, vec3_mul(across, 0.5));
    }
    case SCENE_MESH:
        return vec3_add(body->lower, vec3_mul(vec3_sub(body->upper, body->lower), 0.5));
    }
    return map->offset;
}

double shape_volume(const struct scene_body *body) {
    const double r = body->radius;
    switch (body->shape) {
    case SCENE_SPHERE:
        return 4.0 / 3 * PI * r * r * r;
    case SCENE_PARALLELOGRAM:
        break;
    case SCENE_MESH:
        return body->mesh ? fabs(body->mesh->volume * mat3_determinant(body->object_to_world.linear)) : 0;
    }
    return 0;
}
