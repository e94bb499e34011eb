// The binary tree between items and the wide tree. Private to tracer/bvh.
//
// Every subtree covers a range of the items, which the build sorts in place. A subtree of n items has
// n - 1 nodes, at [id, id + n - 1): its root, then its left child's, then its right child's; a subtree of
// one item is the item itself. So ids follow from counts, and threads build subtrees without sharing.
#ifndef GLINT_TRACER_BVH_BINARY_H
#define GLINT_TRACER_BVH_BINARY_H

#include "tracer/bvh/box.h"

struct binary_node {
    struct bvh_box box;
    uint32_t left_count; // items of the left child
    // How to make this subtree at least cost: [0] 1 a leaf, 0 a wide node of its own; [i] for 1 <= i < 8:
    // as up to i + 1 roots, of which the left child gives this many; 0: not more than i roots.
    uint8_t decision[BVH_WIDTH];
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

static inline struct binary_range binary_left(const struct binary_tree *tree, struct binary_range r) {
    return (struct binary_range){r.node + 1, r.begin, tree->nodes[r.node].left_count};
}
static inline struct binary_range binary_right(const struct binary_tree *tree, struct binary_range r) {
    uint32_t left = tree->nodes[r.node].left_count;
    return (struct binary_range){r.node + left, r.begin + left, r.count - left};
}

static inline struct bvh_box binary_box(const struct binary_tree *tree, struct binary_range r) {
    return r.count == 1 ? item_box(&tree->items[r.begin]) : tree->nodes[r.node].box;
}

#endif
