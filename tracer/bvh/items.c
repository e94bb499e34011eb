#include "tracer/bvh/items.h"
#include "tracer/bvh/round.h"

// How much wider boxes are than their contents, as fractions of the farthest coordinate: more than the error
// of a ray's start (shaders/ray_offset.glsl, `leave`), 45 units of 2^-24 or 2^-53, so that a ray still meets
// the box of the triangle that it starts on.
#define SINGLE_PAD 0x1p-18
#define DOUBLE_PAD 0x1p-47

static struct bvh_item wider(vec3 lower, vec3 upper, double pad, uint32_t index) {
    struct bvh_item item = {.index = index};
    const double low[3] = {lower.x, lower.y, lower.z}, high[3] = {upper.x, upper.y, upper.z};
    for (int axis = 0; axis < 3; axis++) {
        item.lower[axis] = float_below(low[axis] - pad);
        item.upper[axis] = -float_below(-(high[axis] + pad));
    }
    return item;
}

double bvh_pad(bool is_double) {
    return is_double ? DOUBLE_PAD : SINGLE_PAD;
}

struct bvh_item bvh_box_item(vec3 lower, vec3 upper, bool is_double, uint32_t index) {
    const double largest = vec3_larger(vec3_max_abs(lower), vec3_max_abs(upper));
    return wider(lower, upper, largest * bvh_pad(is_double), index);
}

struct bvh_item bvh_wide_item(vec3 lower, vec3 upper, uint32_t index) {
    return wider(lower, upper, 0, index);
}

struct bvh_item bvh_triangle_item(const vec3 corners[3], bool is_double, uint32_t index) {
    vec3 lower = vec3_least(vec3_least(corners[0], corners[1]), corners[2]);
    vec3 upper = vec3_greatest(vec3_greatest(corners[0], corners[1]), corners[2]);
    return bvh_box_item(lower, upper, is_double, index);
}

struct bvh_item bvh_sphere_item(vec3 center, double radius, bool is_double, uint32_t index) {
    vec3 arm = {radius, radius, radius};
    return bvh_box_item(vec3_sub(center, arm), vec3_add(center, arm), is_double, index);
}
