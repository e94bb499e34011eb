// Crossing edges of the plane made to share points: every edge is cut where another one crosses it or ends on
// it.
//
// Crossings are rounded to a grid, which moves edges a little and can make new crossings; these are cut
// again, until there are none (a simple form of snap rounding, Hobby 1999). Rounds and pairs are counted, so
// that work is bounded. Ownership: the arena's. Thread safety: pure.
#ifndef GLINT_ASSETS_MADE_ARRANGE_H
#define GLINT_ASSETS_MADE_ARRANGE_H

#include "assets/made/prism.h"

struct arrange {
    struct arena *arena;
    double grid; // points are multiples of this, a power of two
    struct {
        struct ir_pair *items;
        uint32_t count, capacity;
    } points;
    struct {
        struct region_edge *items;
        uint32_t count, capacity;
    } edges;
    struct prism_look *looks; // per edge
};

// Returns in `region` what was made, found by the nonzero rule and cut. false: too tangled.
bool arrange_run(struct arrange *arrange, struct region *region);

#endif
