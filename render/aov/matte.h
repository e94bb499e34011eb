// Cryptomatte 1.2 (Friedman and Jones 2015, "Fully automatic ID mattes with support for motion blur and
// transparency"; the specification of Psyop): for each pixel the names that its samples see, each with the
// share of the samples that see it.
//
// Input: a name for each number, and the hits of each sample. Output: ranks of float pairs (the hash of a
// name as a float; its coverage, 0..1), and the key of the metadata. A pixel holds MATTE_RANKS names, those
// with the largest coverage; where its samples see more than MATTE_KEPT, the coverage of rare ones is lost.
// Samples that see the background belong to no name. Errors: false if there is no memory. Ownership:
// matte_finish frees, and accepts a zeroed one. Thread safety: plain data.
#ifndef GLINT_RENDER_AOV_MATTE_H
#define GLINT_RENDER_AOV_MATTE_H

#include "core/str.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    MATTE_RANKS = 6, // in the file: two to each of its layers
    MATTE_KEPT = 8,  // while samples are counted
};

struct matte {
    uint32_t width, height;
    uint32_t samples; // that were added
    struct matte_pixel *pixels;
    float *ranks; // matte_end: 2 * MATTE_RANKS a pixel
};

// MurmurHash3_x86_32 (Appleby 2011) with seed 0, as the bits of a float that is not denormal, infinite or
// NaN: if the exponent is all zeros or ones, its lowest bit is flipped.
uint32_t matte_hash(str name);
uint32_t matte_bits(uint32_t hash);

bool matte_init(struct matte *matte, uint32_t width, uint32_t height);
void matte_finish(struct matte *matte);
// What one sample of a pixel sees; 0: the background.
void matte_add(struct matte *matte, size_t pixel, uint32_t bits);
// After the last of `samples` samples of each pixel: the ranks. false: no memory.
bool matte_end(struct matte *matte, uint32_t samples);
// The seven digits of the key of a layer's metadata.
void matte_key(str layer, char key[8]);

#endif
