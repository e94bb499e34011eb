// A triangle as kernels will see it: its corners after rounding, and whether that leaves it an area.
#include "scene/shape.h"
#include "shaders/records.h"
#include "tracer/flatten/flatten_internal.h"

#include <float.h>
#include <math.h>

// The corner whose edges give the most accurate normal. The error of the cross product of two edges is about
// a unit in the last place over the sine of their angle: the first corner is used, unless another's edges are
// much shorter.
static uint32_t best_corner(const vec3 corners[3]) {
    double product[3];
    uint32_t best = 0;
    for (int k = 0; k < 3; k++) {
        const vec3 u = vec3_sub(corners[(k + 1) % 3], corners[k]);
        const vec3 v = vec3_sub(corners[(k + 2) % 3], corners[k]);
        product[k] = vec3_length(u) * vec3_length(v);
        if (product[k] < product[best])
            best = (uint32_t)k;
    }
    return product[0] > TRIANGLE_CORNER_FACTOR * product[best] ? best : 0;
}

// Whether the tracer can compute a normal: the cross product of the rounded vertices' edges in single
// precision, as it does it, with the edges first divided by a power of two.
static bool has_area(const vec3 corners[3], uint32_t corner) {
    float edge[2][3];
    float largest = 0;
    const vec3 p = corners[corner];
    for (uint32_t i = 0; i < 2; i++) {
        const vec3 q = corners[(corner + i + 1) % 3];
        const float from[3] = {(float)p.x, (float)p.y, (float)p.z};
        const float to[3] = {(float)q.x, (float)q.y, (float)q.z};
        for (int k = 0; k < 3; k++) {
            edge[i][k] = to[k] - from[k];
            largest = fmaxf(largest, fabsf(edge[i][k]));
        }
    }
    if (largest < FLT_MIN)
        return false;
    float scale = ldexpf(1, -ilogbf(largest));
    for (int k = 0; k < 3; k++) {
        int next = (k + 1) % 3;
        int last = (k + 2) % 3;
        float cross =
            edge[0][next] * scale * (edge[1][last] * scale) - edge[0][last] * scale * (edge[1][next] * scale);
        if (cross != 0)
            return true;
    }
    return false;
}

// The same in double precision.
static bool has_area64(const vec3 corners[3], uint32_t corner) {
    const vec3 p = corners[corner];
    vec3 u = vec3_sub(corners[(corner + 1) % 3], p), v = vec3_sub(corners[(corner + 2) % 3], p);
    double largest = fmax(vec3_max_abs(u), vec3_max_abs(v));
    if (largest < DBL_MIN)
        return false;
    double scale = ldexp(1, -ilogb(largest));
    return vec3_max_abs(vec3_cross(vec3_mul(u, scale), vec3_mul(v, scale))) != 0;
}

// 0 for numbers below all normal floats: they do not belong to the scene, whose size is 1, and its record
// could not hold them (shaders/records.h, TRIANGLE_REST).
static double without_trace(double value) {
    return fabs(value) < FLT_MIN ? 0 : value;
}

struct flat_corners flatten_corners(const struct flattening *f, const struct scene_body *body,
                                    const affine3 *map, uint32_t triangle) {
    vec3 found[3];
    struct flat_corners flat;
    scene_corners(body, map, triangle, found);
    for (int k = 0; k < 3; k++) {
        const int from = body->mirrored && k ? 3 - k : k;
        const vec3 v = flatten_rounded3(f, vec3_mul(found[from], f->factor));
        flat.at[k] = (vec3){without_trace(v.x), without_trace(v.y), without_trace(v.z)};
    }
    flat.best = best_corner(flat.at);
    flat.has_area = f->out->is_double ? has_area64(flat.at, flat.best) : has_area(flat.at, flat.best);
    return flat;
}
