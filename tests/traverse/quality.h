// What a tree of tracer/bvh/bvh.h holds and is worth, read back from its words.
//
// Thread safety: pure.
#ifndef GLINT_TESTS_TRAVERSE_QUALITY_H
#define GLINT_TESTS_TRAVERSE_QUALITY_H

#include "tracer/bvh/bvh.h"

// What the traversal sees of a slot. Exact in double.
struct decoded_child {
    double lower[3], upper[3];
    bool is_node;
    uint32_t first, count; // the node's index, or the leaf's items
};
// false: the slot is empty.
bool decode_child(const struct gpu_word words[5], int slot, struct decoded_child *child);

// The cost is the expected number of nodes opened and items tested by a random ray that hits the root's box,
// weighted BVH_COST_NODE and BVH_COST_ITEM, over the boxes as quantised.
struct bvh_quality {
    double cost;
    uint32_t nodes, leaves, items;
    double children_per_node, items_per_leaf;
};
struct bvh_quality bvh_measure(const struct bvh *bvh);

#endif
