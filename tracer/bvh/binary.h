// The binary tree between items and the wide tree. Private to tracer/bvh.
//
// Every subtree covers a range of the items, which the build sorts in place. A subtree of n items has n - 1
// nodes, at [id, id + n - 1): its root, then its left child's, then its right child's; a subtree of one item
// is the item itself. So ids follow from counts, and threads build subtrees without sharing data. Boxes are
// not kept: the boxes of wide nodes follow from the items below them.
#ifndef GLINT_TRACER_BVH_BINARY_H
#define GLINT_TRACER_BVH_BINARY_H

#include "tracer/bvh/box.h"

struct binary_node {
    uint32_t left_count; // items of the left child
    uint32_t choices;    // the cheapest way to make this subtree: see binary_choice
};

// A subtree: `node` means nothing where count is 1.
struct binary_range {
    uint32_t node, begin, count;
};

struct binary_tree {
    struct bvh_item *items;
    struct binary_node *nodes; // count - 1
    uint32_t count;
};

// false: no memory. `nodes` is allocated here and freed by the caller.
bool binary_build(struct binary_tree *tree, enum bvh_method method);

enum {
    CHOICE_BITS = 3,
    CHOICE_MASK = 7
};

// roots 1: whether the subtree is a leaf. 2 to 7: as up to that many roots, this is how many the left child
// gives; 0: one root fewer costs no more. 8: how many roots the left child gives to a wide node made from the
// subtree.
static inline uint32_t binary_choice(const struct binary_node *node, int roots) {
    return node->choices >> (CHOICE_BITS * (roots - 1)) & CHOICE_MASK;
}

static inline struct binary_range binary_left(const struct binary_tree *tree, struct binary_range r) {
    return (struct binary_range){r.node + 1, r.begin, tree->nodes[r.node].left_count};
}
static inline struct binary_range binary_right(const struct binary_tree *tree, struct binary_range r) {
    uint32_t left = tree->nodes[r.node].left_count;
    return (struct binary_range){r.node + left, r.begin + left, r.count - left};
}
static inline bool binary_is_leaf(const struct binary_tree *tree, struct binary_range r) {
    return r.count == 1 || binary_choice(&tree->nodes[r.node], 1);
}

#endif
