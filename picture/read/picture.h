// Images that a scene reads: PNG and JPEG (decoded by libpng and libjpeg-turbo), OpenEXR (by
// OpenEXRCore), Radiance HDR.
//
// Pixels are kept as their file has them, without alpha: three or six bytes per pixel, four of an HDR image,
// three floats of an OpenEXR image.
// Ownership: pixels on the heap, freed by picture_finish; pictures in the store belong to the store.
// Thread safety: a picture is immutable once decoded.
#ifndef GLINT_PICTURE_READ_PICTURE_H
#define GLINT_PICTURE_READ_PICTURE_H

#include "core/float_bits.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum picture_depth {
    PICTURE_8,     // 3 x uint8_t per pixel; value / 255
    PICTURE_16,    // 3 x uint16_t; value / 65535
    PICTURE_RGBE,  // 3 x uint8_t and the exponent that they share (picture_rgbe_scale), linear always
    PICTURE_FLOAT, // 3 x float, finite and not negative, linear always
};

struct picture {
    uint32_t width, height;
    enum picture_depth depth;
    void *pixels;          // row 0 on top; NULL: its size is known, and the pixels were not kept
    uint64_t size_bytes;   // memory of the pixels if they are kept
    const char *ignored;   // parts that glint does not use, as in "alpha is"; NULL: none
    uint64_t clear_pixels; // in a decoded PNG: how many have alpha that is not full
};

// Accepts a zeroed picture.
void picture_finish(struct picture *picture);

static inline size_t picture_pixel_bytes(enum picture_depth depth) {
    return depth == PICTURE_8 ? 3 : depth == PICTURE_16 ? 6 : depth == PICTURE_RGBE ? 4 : 12;
}

// Whether the values are linear, whatever the scene says: read by picture_linear. Else they are whole
// numbers.
static inline bool picture_is_linear(const struct picture *picture) {
    return picture->depth >= PICTURE_RGBE;
}

// The greatest value of a channel that is a whole number.
static inline uint32_t picture_greatest(enum picture_depth depth) {
    return depth == PICTURE_8 ? UINT8_MAX : UINT16_MAX;
}

// The value of a channel (0 to 2) of pixel `at`, as it is stored, where it is a whole number.
static inline uint32_t picture_stored(const struct picture *picture, size_t at, size_t channel) {
    return picture->depth == PICTURE_8 ? ((const uint8_t *)picture->pixels)[3 * at + channel]
                                       : ((const uint16_t *)picture->pixels)[3 * at + channel];
}

// 2^(exponent - 136), by which the three mantissas are multiplied: exactly, since they have 8 bits; 0 for
// exponent 0, which is black. 255 * 2^119 is a float: every pixel is finite.
static inline float picture_rgbe_scale(uint8_t exponent) {
    enum {
        LEAST_NORMAL = 10, // 2^-126: below, a float has a 1 in its fraction instead of an exponent
        BIAS = 136 - 127,
    };
    return float_of_bits(exponent == 0              ? 0
                         : exponent >= LEAST_NORMAL ? (uint32_t)(exponent - BIAS) << 23
                                                    : UINT32_C(1) << (exponent + 149 - 136));
}

// The value of a channel (0 to 2) of pixel `at`, where picture_is_linear.
static inline float picture_linear(const struct picture *picture, size_t at, size_t channel) {
    if (picture->depth == PICTURE_FLOAT)
        return ((const float *)picture->pixels)[3 * at + channel];
    const uint8_t *pixel = (const uint8_t *)picture->pixels + 4 * at;
    return (float)pixel[channel] * picture_rgbe_scale(pixel[3]);
}

#endif
