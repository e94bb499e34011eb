#include "tracer/bvh/items.h"

#include <math.h>
#include <string.h>

enum {
    SINGLE_ULP = -23,
    DOUBLE_ULP = -52,
};

static float float_of(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static float float_below(double value) {
    float rounded = (float)value;
    return rounded > value ? nextafterf(rounded, -INFINITY) : rounded;
}

static double double_of(uint32_t low, uint32_t high) {
    uint64_t bits = (uint64_t)high << 32 | low;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

// `ulp`: of 1, as a power of two.
static struct bvh_item padded(const double lower[3], const double upper[3], int ulp, uint32_t index) {
    struct bvh_item item = {.index = index};
    double largest = 0;
    for (int axis = 0; axis < 3; axis++)
        largest = fmax(largest, fmax(fabs(lower[axis]), fabs(upper[axis])));
    double pad = ldexp(largest, ulp + 1);
    for (int axis = 0; axis < 3; axis++) {
        item.lower[axis] = float_below(lower[axis] - pad);
        item.upper[axis] = -float_below(-(upper[axis] + pad));
    }
    return item;
}

struct bvh_item bvh_triangle_item(const struct gpu_word *words, uint32_t index) {
    double lower[3], upper[3];
    for (int vertex = 0; vertex < 3; vertex++) {
        const uint32_t bits[3] = {words[vertex].x, words[vertex].y, words[vertex].z};
        for (int axis = 0; axis < 3; axis++) {
            double value = float_of(bits[axis]);
            lower[axis] = vertex ? fmin(lower[axis], value) : value;
            upper[axis] = vertex ? fmax(upper[axis], value) : value;
        }
    }
    return padded(lower, upper, SINGLE_ULP, index);
}

struct bvh_item bvh_sphere_item(const struct gpu_word *words, uint32_t index) {
    const uint32_t bits[3] = {words->x, words->y, words->z};
    double radius = float_of(words->w);
    double lower[3], upper[3];
    for (int axis = 0; axis < 3; axis++) {
        lower[axis] = float_of(bits[axis]) - radius;
        upper[axis] = float_of(bits[axis]) + radius;
    }
    return padded(lower, upper, SINGLE_ULP, index);
}

struct bvh_item bvh_triangle64_item(const struct gpu_word *words, uint32_t index) {
    double lower[3], upper[3];
    for (int vertex = 0; vertex < 3; vertex++) {
        const struct gpu_word *w = words + 2 * vertex;
        const double place[3] = {double_of(w[0].x, w[0].y), double_of(w[0].z, w[0].w),
                                 double_of(w[1].x, w[1].y)};
        for (int axis = 0; axis < 3; axis++) {
            lower[axis] = vertex ? fmin(lower[axis], place[axis]) : place[axis];
            upper[axis] = vertex ? fmax(upper[axis], place[axis]) : place[axis];
        }
    }
    return padded(lower, upper, DOUBLE_ULP, index);
}

struct bvh_item bvh_sphere64_item(const struct gpu_word *words, uint32_t index) {
    const double center[3] = {double_of(words[0].x, words[0].y), double_of(words[0].z, words[0].w),
                              double_of(words[1].x, words[1].y)};
    double radius = double_of(words[1].z, words[1].w);
    double lower[3], upper[3];
    for (int axis = 0; axis < 3; axis++) {
        lower[axis] = center[axis] - radius;
        upper[axis] = center[axis] + radius;
    }
    return padded(lower, upper, DOUBLE_ULP, index);
}
