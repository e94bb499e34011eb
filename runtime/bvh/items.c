#include "runtime/bvh/items.h"

#include <math.h>
#include <string.h>

static float float_of(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static float float_below(double value) {
    float rounded = (float)value;
    return rounded > value ? nextafterf(rounded, -INFINITY) : rounded;
}

static struct bvh_item padded(const double lower[3], const double upper[3], uint32_t index) {
    struct bvh_item item = {.index = index};
    double largest = 0;
    for (int axis = 0; axis < 3; axis++)
        largest = fmax(largest, fmax(fabs(lower[axis]), fabs(upper[axis])));
    double pad = ldexp(largest, -22);
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
    return padded(lower, upper, index);
}

struct bvh_item bvh_sphere_item(const struct gpu_word *words, uint32_t index) {
    const uint32_t bits[3] = {words->x, words->y, words->z};
    double radius = float_of(words->w);
    double lower[3], upper[3];
    for (int axis = 0; axis < 3; axis++) {
        lower[axis] = float_of(bits[axis]) - radius;
        upper[axis] = float_of(bits[axis]) + radius;
    }
    return padded(lower, upper, index);
}
