// The contours of a glyph as paths.
//
// Input: an outline as fonts have it. Output: a path for each contour with an area, its pieces within the
// tolerance, in the font's units. Contours of fewer than three points are left out. Errors: false for control
// points in an order that is not allowed, or too many pieces. Thread safety: pure.
#ifndef GLINT_ASSETS_MADE_CONTOURS_H
#define GLINT_ASSETS_MADE_CONTOURS_H

#include "assets/made/font.h"
#include "assets/made/path.h"

// Adds to the list.
struct contours {
    struct path *items;
    uint32_t count, capacity;
};
bool contours_add(struct contours *contours, const struct font_outline *outline, double tolerance,
                  struct arena *arena);

#endif
