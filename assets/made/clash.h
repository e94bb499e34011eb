// Whether the paths of a body cross or touch themselves or each other, and where.
//
// Errors: MADE_CROSSES and MADE_TOUCHES, with the points that the pieces begin at. Thread safety: pure.
#ifndef GLINT_ASSETS_MADE_CLASH_H
#define GLINT_ASSETS_MADE_CLASH_H

#include "assets/made/path.h"
#include "assets/made/region.h"

struct clash_chain {
    const struct path *path;
    bool is_open;
};

struct clash_chains {
    const struct clash_chain *chains;
    uint32_t count;
    bool names_outlines; // in sentences
};

// The paths' nodes and pieces as a region's points and edges: node i of a path is where its piece i begins.
void clash_take(const struct clash_chains *chains, struct arena *arena, struct region *region);
// Says what region_find found. Always false.
bool clash_fail(const struct clash_chains *chains, const struct region *region, enum region_clash clash,
                struct made_fault *fault);
bool clash_check(const struct clash_chains *chains, struct arena *arena, struct made_fault *fault);

#endif
