// Doubles rounded down to float. Private to tracer/bvh. Thread safety: pure.
#ifndef GLINT_TRACER_BVH_ROUND_H
#define GLINT_TRACER_BVH_ROUND_H

#include <stdint.h>
#include <string.h>

// The largest float that is not above a finite `value`; the magnitudes of floats are in the order of their
// bits.
static inline float float_below(double value) {
    const float rounded = (float)value;
    if (!((double)rounded > value))
        return rounded;
    int32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    if (bits == 0)
        return -0x1p-149f;
    bits += bits < 0 ? 1 : -1;
    float below;
    memcpy(&below, &bits, sizeof below);
    return below;
}

#endif
