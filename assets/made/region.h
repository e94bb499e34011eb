// Areas of the plane bounded by straight edges: which edges bound them, in which direction, and their
// triangles.
//
// Input: points and directed edges between them, in any order and of any number of outlines; edges at which
// the winding number does not pass between filled and not filled are left out. Output: sides, with the filled
// area to the left, each with its successor around that area, and triangles, counter-clockwise, over the same
// points. Every triangle edge inside is used once in each direction, and every side once.
// Sides are found exactly, of points as plane_point makes them; triangles are assets/triangulate.h's.
// Errors: edges that cross or touch (`clash`). Ownership: the arena's. Thread safety: one region belongs to
// one thread.
#ifndef GLINT_ASSETS_MADE_REGION_H
#define GLINT_ASSETS_MADE_REGION_H

#include "assets/made/sweep.h"

// A directed edge, between points as the caller numbers them.
struct region_edge {
    uint32_t from, to;
};

struct region_side {
    uint32_t from, to; // points as the region numbers them: into places
    uint32_t edge;     // the edge as given
    bool is_reversed;  // against the direction of that edge
    uint32_t next;     // the side that follows at `to` around the same area
};

enum region_clash {
    REGION_FINE,
    REGION_CROSSES, // the edges clash[0] and clash[1] cross
    REGION_TOUCHES, // they touch
    REGION_MEETS,   // the points clash[0] and clash[1] are at the same place
};

struct region {
    struct arena *arena;
    const struct ir_pair *points;
    uint32_t point_count;
    const struct region_edge *edges;
    uint32_t edge_count;
    bool even_odd;  // the filling rule; else: nonzero
    bool may_touch; // points may be at the same place, and edges between the same places are added up
    // The result:
    uint32_t clash[2];
    struct ir_pair place; // of the clash
    struct ir_pair *places;
    uint32_t *first_at; // per place: the lowest point there
    uint32_t *place_of; // per point
    uint32_t place_count;
    struct region_side *sides;
    uint32_t side_count;
    uint32_t (*triangles)[3]; // into places
    uint32_t triangle_count;
};

// Sides only.
enum region_clash region_find(struct region *region);
// The same without sides: only whether edges cross or touch. Chains may be open.
enum region_clash region_check(struct region *region);
// Sides and triangles.
enum region_clash region_cut(struct region *region);

#endif
