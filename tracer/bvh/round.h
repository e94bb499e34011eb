// Doubles rounded down to float. Private to tracer/bvh. Thread safety: pure.
#ifndef GLINT_TRACER_BVH_ROUND_H
#define GLINT_TRACER_BVH_ROUND_H

#include "core/float_bits.h"

// The largest float that is not above a finite `value`; the magnitudes of floats are in the order of their
// bits.
static inline float float_below(double value) {
    const float rounded = (float)value;
    if (!((double)rounded > value))
        return rounded;
    const uint32_t bits = float_bits(rounded);
    if (bits == 0)
        return -0x1p-149f;
    return float_of_bits(bits >> 31 ? bits + 1 : bits - 1);
}

#endif
