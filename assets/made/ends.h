// The flat faces at both ends of a body of revolution of less than a turn: the profile, closed along the
// axis.
//
// Input: a path that is a ring, or whose ends are on the axis u = 0. Output: triangles, counter-clockwise in
// the plane of u and v, over the path's nodes: node i is where piece i begins. Ownership: the arena's. Thread
// safety: pure.
#ifndef GLINT_ASSETS_MADE_ENDS_H
#define GLINT_ASSETS_MADE_ENDS_H

#include "assets/made/path.h"

struct ends {
    uint32_t (*triangles)[3]; // into nodes
    uint32_t triangle_count;
    struct ir_pair *nodes;
    struct plane_box box; // of the nodes
};

void ends_cut(struct ends *ends, const struct path *path, bool is_ring, struct arena *arena);

#endif
