// What the files of regions share: places.c, region.c, loops.c. See region.h.
#ifndef GLINT_ASSETS_MADE_REGION_INTERNAL_H
#define GLINT_ASSETS_MADE_REGION_INTERNAL_H

#include "assets/made/region.h"

// Fills places, first_at and place_of. false: two points are at the same place and must not be
// (REGION_MEETS).
bool region_find_places(struct region *region);
// Sets the sweep up; given[e] is the region's edge that the sweep's edge `e` comes from.
void region_place_edges(const struct region *region, struct sweep *sweep, uint32_t *given);

// Directed edges that bound areas to their left: `next` of each is the one that follows at its end around the
// same area, the first one clockwise from where it came.
struct loops {
    const struct ir_pair *places;
    uint32_t place_count;
    const struct sweep_diagonal *edges;
    uint32_t edge_count;
    uint32_t *next;
};
void loops_link(struct loops *loops, struct arena *arena);
// Cuts the areas inside the loops into triangles: fills region->triangles.
void loops_cut(const struct loops *loops, struct region *region);

#endif
