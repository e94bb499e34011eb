// Text as contours at their places: lines, kerning, alignment.
//
// Units: the font's. Errors: struct made_fault. Ownership: the arena's. Thread safety: as font.h.
#ifndef GLINT_ASSETS_MADE_LAYOUT_H
#define GLINT_ASSETS_MADE_LAYOUT_H

#include "assets/made/contours.h"

struct layout {
    struct contours contours;
    struct {
        struct ir_pair *items; // per contour
        uint32_t count, capacity;
    } offsets;
    double cap_height;
};

bool layout_make(struct layout *layout, struct font *font, const struct made_text *text, struct arena *arena,
                 struct made_fault *fault);

#endif
