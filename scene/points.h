// Where a pixel's sample takes its points on anything with extent: the same for GPU and reference
// (shaders/light/points.h says which, and names the keys).
//
// Units: pixels; points in the unit square. Errors: none. Thread safety: pure.
#ifndef GLINT_SCENE_POINTS_H
#define GLINT_SCENE_POINTS_H

#include "shaders/light/points.h"

// A sample of a pixel.
struct points {
    uint32_t x, y, sample;
    uint32_t bits; // points_bits
};

// Bits of the sample numbers of `samples` samples, the first of which is number `first`, at most POINT_MOST.
// 0: the only sample of a picture, which takes the middle of everything.
uint32_t points_bits(uint32_t first, uint32_t samples);

// All bits of the sample's point, also in a picture of one sample.
void points_words(const struct points *points, uint32_t key, uint32_t *a, uint32_t *b);

// The sample's point for the key: both coordinates in [0, 1), multiples of 2^-24.
void points_at(const struct points *points, uint32_t key, double *a, double *b);

#endif
