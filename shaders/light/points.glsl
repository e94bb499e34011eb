// The points of a sample (points.h). The kernel says once which sample this invocation traces.
#include "light/points.h"

const bool HAS_POINTS = (FEATURES & FEATURE_POINTS) != 0u;

#ifndef POINT_BITS
#define POINT_BITS frame.point_bits
#endif

uvec2 point_pixel = uvec2(0u);
uint point_sample = 0u;

// Where the thing with this key is sampled: all bits, even in a picture of one sample, which then looks
// grainy.
uvec2 point_bits_at(uint key) {
    uint bits = POINT_BITS;
    uint seed = point_seed(key, point_sample, bits);
    uint order = point_order(point_place(point_pixel.x, point_pixel.y, point_sample, bits), seed);
    return uvec2(point_first(order, seed), point_second(order, seed));
}

// Where the thing with this key is sampled. Both in 0..1; the middle if the picture has one sample per pixel.
vec2 point_at(uint key) {
    uint bits = POINT_BITS;
    uint seed = point_seed(key, point_sample, bits);
    uint order = point_order(point_place(point_pixel.x, point_pixel.y, point_sample, bits), seed);
    uvec2 both = uvec2(point_first(order, seed), point_second(order, seed)) >> 8u;
    return bits > OPAQUE_ZERO ? vec2(both) * (1.0 / POINT_DIVISOR) : vec2(0.5);
}
