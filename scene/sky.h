// The background as a light: where its samples look, so that bright parts are sampled in proportion to their
// light (inversion of a piecewise constant density; Pharr et al. 2016, section 13.6.5).
//
// Input: a background that lights and whose picture, if it has one, has its pixels. Output: whole numbers
// that device and reference share, so that both take the same texels. A cell lies between the middles of four
// texels, where the picture is bilinear: every part that is not black can be sampled. Above the first row of
// texels and below the last there is one more row of cells. A colour has one cell, the sphere. Ownership: the
// table is the caller's. Errors: false where memory ended. Thread safety: pure.
#ifndef GLINT_SCENE_SKY_H
#define GLINT_SCENE_SKY_H

#include "scene/scene.h"

enum {
    SKY_ROW_WORDS = 4, // of a row's record
};

// `numbers` begins with a record for each row of cells, from the top: where its share begins (of 2^32, up to
// that of the next row), and two floats by their bits, `gap` and `step`: the place at fraction f of the row,
// from 0 to 1, is where |y| = 1 - (gap + f step), above the horizon if the step is positive. Then follows for
// each row, `stride` apart, where the share of each of its cells begins. The share of the last row, and of a
// row's last cell, ends at 2^32. An empty share is never taken.
struct sky_size {
    uint32_t width, rows;
    uint32_t stride; // cells in a row, rounded up to a multiple of 4
};

// rows 0: it does not light, or its pixels are not there.
struct sky_size sky_size(const struct scene *scene);
static inline size_t sky_count(struct sky_size size) {
    return (size_t)size.rows * (SKY_ROW_WORDS + size.stride);
}
// Fills sky_count numbers. *is_black: there is no light in it, and nothing was filled.
bool sky_fill(const struct scene *scene, struct sky_size size, uint32_t *numbers, bool *is_black);

#endif
