// The first cuts of a large range of items, shared by threads, until the ranges are small enough for one
// thread each. Private to tracer/bvh.
#ifndef GLINT_TRACER_BVH_TOP_H
#define GLINT_TRACER_BVH_TOP_H

#include "tracer/bvh/binary.h"
#include "tracer/bvh/split.h"

struct top_node {
    struct binary_range range;
    struct bvh_box middles; // bounds of its items' middles
    unsigned level;
    uint32_t left; // of a large one: the number of its left side; the right side comes next
    bool is_small;
    bool is_moved; // while cutting: the items are in the second array
};

struct top {
    struct top_node *nodes; // breadth first
    uint32_t count, capacity;
    uint32_t *small; // numbers of the small ones
    uint32_t small_count;
};

// Sorts items[0, count) into the ranges. false: no memory. top_finish frees in any case.
bool top_build(struct bvh_item *items, uint32_t count, enum bvh_method method, struct top *top);
void top_finish(struct top *top);

// Whether a range is halved by number instead of cut by cost, so that no input makes a deep tree.
enum {
    TOP_LEVELS_BY_COST = 48
};
static inline bool top_is_halved(enum bvh_method method, unsigned level) {
    return method == BVH_MEDIAN || level >= TOP_LEVELS_BY_COST;
}

#endif
