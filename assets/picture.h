// Images that a scene reads: PNG, JPEG and Radiance HDR, decoded by stb_image.
//
// Ownership: pixels on the heap, freed by picture_finish; pictures in the store belong to the store.
#ifndef GLINT_ASSETS_PICTURE_H
#define GLINT_ASSETS_PICTURE_H

#include <stdbool.h>
#include <stdint.h>

enum picture_depth {
    PICTURE_8,     // 4 x uint8_t a pixel; value / 255
    PICTURE_16,    // 4 x uint16_t; value / 65535
    PICTURE_FLOAT, // 4 x float, linear always
};

struct picture {
    uint32_t width, height;
    enum picture_depth depth;
    void *pixels;         // RGBA, row 0 on top; alpha is to be ignored
    uint64_t size_bytes;
    bool ignored_parts;   // alpha or colour chunks that glint does not use
};

void picture_finish(struct picture *picture);

#endif
