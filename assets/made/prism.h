// Areas of the plane extruded along z, with bevels: what outlines and text have in common.
//
// Input: the edges of the areas, in the plane's own unit, with the directions of the true outline at their
// ends. Output: a shell from z = 0 to `height`. A bevel moves each side of the area inward by its size, so
// that corners are mitred; it fits as long as no side vanishes and no two cross. Errors: MADE_EMPTY,
// MADE_BEVEL, MADE_TRIANGLES. Thread safety: as made.h.
#ifndef GLINT_ASSETS_MADE_PRISM_H
#define GLINT_ASSETS_MADE_PRISM_H

#include "assets/made/made.h"
#include "assets/made/region.h"

// How an edge looks at its `from` [0] and at its `to` [1].
struct prism_look {
    struct ir_pair along[2]; // directions, of length 1
    double u[2];             // texture coordinates
};

struct prism {
    const struct region *region;    // after region_find or region_cut
    const struct prism_look *looks; // per edge of the region
    double scale;                   // from the plane's unit to the mesh's
    double height, bevel;           // in the mesh's unit
};

bool prism_build(const struct prism *prism, const struct made_to *to, struct made *out);

#endif
