// Images that a scene reads: PNG and JPEG (decoded by libpng and libjpeg-turbo), Radiance HDR.
//
// Ownership: pixels on the heap, freed by picture_finish; pictures in the store belong to the store.
#ifndef GLINT_PICTURE_READ_PICTURE_H
#define GLINT_PICTURE_READ_PICTURE_H

#include <stdint.h>

enum picture_depth {
    PICTURE_8,     // 4 x uint8_t per pixel; value / 255
    PICTURE_16,    // 4 x uint16_t; value / 65535
    PICTURE_FLOAT, // 4 x float, linear always
};

struct picture {
    uint32_t width, height;
    enum picture_depth depth;
    void *pixels;        // RGBA, row 0 on top; alpha must be ignored
    uint64_t size_bytes; // of the pixels
    const char *ignored; // parts that glint does not use, as in "alpha is"; NULL: none
};

// Accepts a zeroed picture.
void picture_finish(struct picture *picture);

#endif
