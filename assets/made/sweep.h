// Straight edges of the plane, swept from left to right: whether two of them cross, and what lies between
// them.
//
// The order of the edges along the sweep line is kept in a tree (Shamos and Hoey 1976, "Geometric
// intersection problems"), and tests are exact, so that the first two edges that cross or touch are found for
// certain. Without any, each edge learns the winding number above it (to its left, if it goes to the right),
// and each point where filled area begins to the right of it, and also is to the left of it, gets a diagonal
// to a point before it. The diagonals (those of "split vertices" in Garey, Johnson, Preparata and Tarjan
// 1978, "Triangulating a simple polygon") cross nothing and join holes to the outlines around them.
//
// Input: points sorted by plane_before, no two the same; edges between different points, sorted by `low`, no
// two between the same points. Edges may share end points. Time: n log n. Ownership: results are in the
// arena. Thread safety: one sweep belongs to one thread.
#ifndef GLINT_ASSETS_MADE_SWEEP_H
#define GLINT_ASSETS_MADE_SWEEP_H

#include "assets/made/plane.h"
#include "core/arena.h"

struct sweep_edge {
    uint32_t low, high; // points; low < high
    int32_t turn;       // what the winding number grows by from below the edge to above it
    int32_t above;      // the result
};

struct sweep_diagonal {
    uint32_t from, to; // points
};

struct sweep {
    struct arena *arena;
    const struct ir_pair *points;
    uint32_t point_count;
    struct sweep_edge *edges;
    uint32_t edge_count;
    bool even_odd;     // filled: an odd winding number; else: any but 0
    uint32_t clash[2]; // edges that cross or touch
    struct {
        struct sweep_diagonal *items;
        uint32_t count, capacity;
    } diagonals;
};

// false: edges cross or touch, see `clash`.
bool sweep_run(struct sweep *sweep);

static inline bool sweep_fills(const struct sweep *sweep, int32_t winding) {
    return sweep->even_odd ? winding & 1 : winding != 0;
}
// Whether two edges have a point in common that is not an end of both.
bool sweep_edges_clash(const struct ir_pair *points, const struct sweep_edge *a, const struct sweep_edge *b);

#endif
