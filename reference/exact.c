// A triangle and a ray in twice the digits of double, from the exact place that the ray leaves
// (shaders/exact.glsl has the same for the device).
#include "reference/exact.h"

#include <float.h>

// Above the error of a place computed with twice the digits, as a fraction of its coordinates.
#define STEP 0x1p-96
// Parallel planes whose heights differ by no more than this fraction of their coordinates are the same but
// for the rounding of the scene's numbers.
#define SAME_HEIGHT   4.0 // units
#define PARALLEL      (1 - 0x1p-14)
#define CORNER_FACTOR 8.0

static vec3 corner_of(const struct primitive *p, int k) {
    return (vec3){p->v[k][0], p->v[k][1], p->v[k][2]};
}

// The corner whose edges give the most accurate normal: the first one, unless another's are much shorter.
static int best_corner(const struct primitive *p) {
    double product[3];
    int best = 0;
    for (int k = 0; k < 3; k++) {
        const vec3 at = corner_of(p, k);
        product[k] = vec3_length(vec3_sub(corner_of(p, (k + 1) % 3), at)) *
                     vec3_length(vec3_sub(corner_of(p, (k + 2) % 3), at));
        best = product[k] < product[best] ? k : best;
    }
    return product[0] > CORNER_FACTOR * product[best] ? best : 0;
}

vec3 exact_normal(const struct primitive *p) {
    const int k = best_corner(p);
    const vec3 at = corner_of(p, k);
    return vec3_unit(
        vec3_cross(vec3_sub(corner_of(p, (k + 1) % 3), at), vec3_sub(corner_of(p, (k + 2) % 3), at)));
}

static double farthest(const struct primitive *p) {
    return fmax(vec3_max_abs(corner_of(p, 0)),
                fmax(vec3_max_abs(corner_of(p, 1)), vec3_max_abs(corner_of(p, 2))));
}

// Never outside the triangle, whatever the rounding of b1 and b2.
static struct wide3 place_on(const struct primitive *p, double b1, double b2) {
    struct wide w[3] = {{0, 0}, wide_of(b1), wide_of(b2)};
    const struct wide both = wide_add(w[1], w[2]);
    w[0] = wide_sub(wide_of(1), both);
    if (w[0].high < 0) {
        w[0] = wide_of(0);
        w[1] = wide_div(w[1], both);
        w[2] = wide_sub(wide_of(1), w[1]);
    }
    struct wide3 sum = wide3_mul(wide3_of(corner_of(p, 0)), w[0]);
    for (int k = 1; k < 3; k++)
        sum = wide3_add(sum, wide3_mul(wide3_of(corner_of(p, k)), w[k]));
    return sum;
}

void exact_begin(const struct reference *r, const struct ray *ray, const int axes[3], struct exact_ray *out) {
    const double d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    *out = (struct exact_ray){
        .origin = wide3_of(ray->start.at), .direction = ray->direction, .unit = reference_unit(r)};
    for (int k = 0; k < 3; k++)
        out->axes[k] = axes[k];
    out->sx = wide_div(wide_of(d[axes[0]]), wide_of(d[axes[2]]));
    out->sy = wide_div(wide_of(d[axes[1]]), wide_of(d[axes[2]]));
    if (ray->start.left == NO_PRIMITIVE)
        return;
    const struct primitive *left = reference_primitive(r, ray->start.left, &out->left_room);
    out->left = left;
    out->left_normal = exact_normal(left);
    // On the side that the ray heads to.
    const double step = STEP * farthest(left);
    const double side = vec3_dot(out->left_normal, ray->direction) < 0 ? -step : step;
    out->origin = wide3_add(place_on(left, ray->start.b1, ray->start.b2),
                            wide3_mul(wide3_of(out->left_normal), wide_of(side)));
}

// A corner's place across the ray: the same for all triangles around it, so no ray slips between them.
struct across {
    struct wide x, y;
};

static struct across across_of(const struct exact_ray *ray, vec3 corner) {
    const struct wide3 to = wide3_sub(wide3_of(corner), ray->origin);
    const struct wide part[3] = {to.x, to.y, to.z};
    const struct wide z = part[ray->axes[2]];
    return (struct across){wide_sub(part[ray->axes[0]], wide_mul(ray->sx, z)),
                           wide_sub(part[ray->axes[1]], wide_mul(ray->sy, z))};
}

static struct wide edge_of(struct across a, struct across b) {
    return wide_difference(a.x, b.y, a.y, b.x);
}

double exact_blur(const struct primitive *p, vec3 direction, double unit) {
    return SAME_HEIGHT * unit * farthest(p) / fabs(vec3_dot(exact_normal(p), direction));
}

// Whether the triangle belongs to another body and lies in the plane of the one that the ray leaves: then the
// ray leaves both.
static bool is_left_too(const struct exact_ray *ray, const struct primitive *p, vec3 unit, double height) {
    return ray->left && ray->left->body != p->body && fabs(height) <= SAME_HEIGHT * ray->unit * farthest(p) &&
           fabs(vec3_dot(unit, ray->left_normal)) > PARALLEL;
}

bool exact_intersect(const struct exact_ray *ray, const struct primitive *p, struct intersection *out) {
    const struct across a = across_of(ray, corner_of(p, 0)), b = across_of(ray, corner_of(p, 1)),
                        c = across_of(ray, corner_of(p, 2));
    const struct wide u = edge_of(c, b), v = edge_of(a, c), w = edge_of(b, a);
    const bool above = u.high > 0 || v.high > 0 || w.high > 0;
    const bool below = u.high < 0 || v.high < 0 || w.high < 0;
    if (above == below)
        return false;
    const int k = best_corner(p);
    const struct wide3 at = wide3_of(corner_of(p, k));
    const struct wide3 normal = wide3_cross(wide3_sub(wide3_of(corner_of(p, (k + 1) % 3)), at),
                                            wide3_sub(wide3_of(corner_of(p, (k + 2) % 3)), at));
    const struct wide height = wide3_dot(normal, wide3_sub(at, ray->origin));
    const struct wide along = wide3_dot(normal, wide3_of(ray->direction));
    if (!((height.high > 0 && along.high > 0) || (height.high < 0 && along.high < 0)))
        return false;
    const vec3 unit = exact_normal(p);
    const double size = fabs(wide3_dot(normal, wide3_of(unit)).high);
    if (is_left_too(ray, p, unit, height.high / size))
        return false;
    const struct wide det = wide_add(wide_add(u, v), w);
    out->t = wide_div(height, along).high;
    out->b1 = fmax(wide_div(v, det).high, 0);
    out->b2 = fmax(wide_div(w, det).high, 0);
    out->t_error = SAME_HEIGHT * REFERENCE_UNIT * farthest(p) * size / fabs(along.high);
    return true;
}
