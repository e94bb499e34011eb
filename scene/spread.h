// Pixels spread over a picture: one in each cell of a grid, at a place in it that depends on the grid alone.
//
// Units: pixels. Errors: none. Thread safety: pure.
#ifndef GLINT_SCENE_SPREAD_H
#define GLINT_SCENE_SPREAD_H

#include <stdint.h>

struct spread {
    uint32_t width, height;  // of the picture
    uint32_t columns, lines; // of cells
};

// `cells` or a few more, about square; the whole picture, one pixel per cell, if that is less than twice as
// many.
struct spread spread_make(uint32_t width, uint32_t height, uint32_t cells);
// The pixel of a cell below columns * lines.
void spread_pixel(const struct spread *spread, uint32_t cell, uint32_t *x, uint32_t *y);

#endif
