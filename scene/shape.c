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
    case SCENE_CONE:
        return (struct shape_traits){.items = SHAPE_CONE, .has_radius = true};
    }
    return (struct shape_traits){.items = SHAPE_TRIANGLES};
}

bool shape_is_there(const struct scene_body *body) {
    return body->mesh || !shape_traits(body->shape).needs_mesh;
}

uint32_t shape_item_count(const struct scene_body *body) {
    return shape_traits(body->shape).items == SHAPE_TRIANGLES ? body->triangle_count : 1;
}

bool shape_is_same(const struct scene_body *a, const struct scene_body *b) {
    return a->shape == b->shape &&
           memcmp(&a->object_to_world, &b->object_to_world, sizeof b->object_to_world) == 0 &&
           a->radius == b->radius && a->radius_to == b->radius_to && a->height == b->height &&
           a->mesh == b->mesh && a->triangle_count == b->triangle_count && a->closed == b->closed &&
           a->mirrored == b->mirrored && a->smooth == b->smooth && a->crease_angle == b->crease_angle;
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
    case SCENE_SPHERE: // have no triangles
    case SCENE_CONE:
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

// Around its two discs: one of radius r reaches r times the sine of the angle between an axis and its normal.
static struct box cone_box(const struct scene_body *body, const affine3 *map) {
    const vec3 axis = mat3_column(map->linear, 1), to = vec3_add(map->offset, vec3_mul(axis, body->height));
    const vec3 sine = {hypot(axis.y, axis.z), hypot(axis.x, axis.z), hypot(axis.x, axis.y)};
    struct box box = EMPTY;
    for (int side = -1; side < 2; side += 2) {
        include(&box, vec3_add(map->offset, vec3_mul(sine, side * body->radius)));
        include(&box, vec3_add(to, vec3_mul(sine, side * body->radius_to)));
    }
    return box;
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
    case SCENE_CONE:
        return cone_box(body, map);
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
    case SCENE_CONE:
        return affine3_apply(*map, (vec3){0, body->height / 2, 0});
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
    case SCENE_CONE:
        return PI / 3 * body->height * (r * r + r * body->radius_to + body->radius_to * body->radius_to);
    }
    return 0;
}

// ---- cones

mat3 scene_cone_frame(vec3 axis) {
    const vec3 y = vec3_unit(axis);
    const bool along_x = fabs(y.x) > fabs(y.y) && fabs(y.x) > fabs(y.z);
    const vec3 z = vec3_unit(vec3_cross(along_x ? (vec3){0, 1, 0} : (vec3){1, 0, 0}, y)),
               x = vec3_cross(y, z);
    return (mat3){{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
}

// Its columns are at right angles.
vec3 shape_into_frame(const struct scene_body *body, vec3 way) {
    const mat3 *frame = &body->object_to_world.linear;
    return (vec3){vec3_dot(mat3_column(*frame, 0), way), vec3_dot(mat3_column(*frame, 1), way),
                  vec3_dot(mat3_column(*frame, 2), way)};
}

struct shape_cone shape_cone_of(const struct scene_body *body) {
    return (struct shape_cone){body->object_to_world.offset, mat3_column(body->object_to_world.linear, 1),
                               body->radius, body->radius_to, body->height};
}

// In the half-plane of axis and point: how far it is from the segment between two of the outline's corners.
static double from_segment(double r, double y, const double a[2], const double b[2]) {
    const double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {r - a[0], y - a[1]};
    const double length2 = u[0] * u[0] + u[1] * u[1];
    const double along = length2 > 0 ? fmin(fmax((u[0] * v[0] + u[1] * v[1]) / length2, 0), 1) : 0;
    return hypot(v[0] - along * u[0], v[1] - along * u[1]);
}

double shape_cone_distance(const struct shape_cone *cone, vec3 point) {
    const vec3 p = vec3_sub(point, cone->from);
    const double y = vec3_dot(p, cone->axis), r = vec3_length(vec3_sub(p, vec3_mul(cone->axis, y)));
    const double corners[4][2] = {
        {0, 0}, {cone->radius, 0}, {cone->radius_to, cone->height}, {0, cone->height}};
    double nearest = INFINITY;
    for (int i = 0; i < 3; i++)
        nearest = fmin(nearest, from_segment(r, y, corners[i], corners[i + 1]));
    const double side = cone->radius + (cone->radius_to - cone->radius) * (y / cone->height);
    return y > 0 && y < cone->height && r < side ? -nearest : nearest;
}

// A line, and how far outside the side it is at t: the distance from the axis, less the radius at that
// height. Between the planes of the discs that is a convex function of t.
struct cone_line {
    vec3 across, direction; // from the axis at 0, and how that changes
    double radius, growth;  // the radius at the height of 0, and how it changes
};

static double outside_at(const struct cone_line *line, double t) {
    return vec3_length(vec3_add(line->across, vec3_mul(line->direction, t))) -
           (line->radius + line->growth * t);
}

// Newton's method from where the line is outside: on a convex function it never passes the root.
static double side_from(const struct cone_line *line, double t, double inside) {
    for (int i = 0; i < 200; i++) {
        const vec3 at = vec3_add(line->across, vec3_mul(line->direction, t));
        const double away = vec3_length(at), outside = away - (line->radius + line->growth * t);
        const double change = vec3_dot(at, line->direction) / away - line->growth,
                     next = t - outside / change;
        const bool is_nearer = t < inside ? next > t && next <= inside : next < t && next >= inside;
        if (!(outside > 0) || !is_nearer)
            break;
        t = next;
    }
    return t;
}

// The line between the planes, no farther than `reach`, within *t; false: it is not there.
static bool between_discs(double height, double y, double dy, double reach, double t[2]) {
    const double ends[2] = {-y / dy, (height - y) / dy};
    t[0] = dy != 0 ? fmax(fmin(ends[0], ends[1]), -reach) : -reach;
    t[1] = dy != 0 ? fmin(fmax(ends[0], ends[1]), reach) : reach;
    return dy != 0 ? t[0] <= t[1] : y >= 0 && y <= height;
}

bool shape_cone_crossing(const struct shape_cone *cone, vec3 point, vec3 direction, double t[2],
                         bool side[2]) {
    // From where the line comes nearest to the middle, so that numbers are as small as the cone.
    const vec3 middle = vec3_add(cone->from, vec3_mul(cone->axis, cone->height / 2));
    const double d2 = vec3_dot(direction, direction);
    const double shift = vec3_dot(vec3_sub(middle, point), direction) / d2;
    const vec3 p = vec3_sub(vec3_add(point, vec3_mul(direction, shift)), cone->from);
    const double y = vec3_dot(p, cone->axis), dy = vec3_dot(direction, cone->axis);
    const double slope = (cone->radius_to - cone->radius) / cone->height;
    const struct cone_line line = {vec3_sub(p, vec3_mul(cone->axis, y)),
                                   vec3_sub(direction, vec3_mul(cone->axis, dy)), cone->radius + slope * y,
                                   slope * dy};
    // Farther away the line is outside. Between the planes alone one that is nearly at right angles to the
    // axis may be so long that one step of Newton's method is rounded by more than the radius.
    const double reach =
        2 * (vec3_length(line.across) + fmax(cone->radius, cone->radius_to)) / vec3_length(line.direction);
    if (!between_discs(cone->height, y, dy, reach, t))
        return false;
    const double a = vec3_dot(line.direction, line.direction) - line.growth * line.growth;
    const double b = vec3_dot(line.across, line.direction) - line.radius * line.growth;
    const double deepest = a > 0 ? -b / a : line.growth > 0 ? t[1] : t[0];
    const double inside = fmin(fmax(deepest, t[0]), t[1]);
    if (outside_at(&line, inside) > 0)
        return false;
    for (int i = 0; i < 2; i++) {
        side[i] = outside_at(&line, t[i]) > 0;
        t[i] = side[i] ? side_from(&line, t[i], inside) : t[i];
        t[i] += shift;
    }
    return true;
}
