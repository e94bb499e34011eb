// The binary tree between items and the wide tree. Private to runtime/bvh.
//
// Every subtree covers a range of the items, which the build sorts in place. A subtree of n items has
// n - 1 nodes, at [id, id + n - 1): its root, then its left child's, then its right child's; a subtree of
// one item is the item itself. So ids follow from counts, and threads build subtrees without sharing.
#ifndef GLINT_TRACER_BVH_BINARY_H
#define GLINT_TRACER_BVH_BINARY_H

#include "tracer/bvh/bvh.h"

#include <stddef.h>

struct bvh_box {
    float lower[3], upper[3];
};

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

static inline struct bvh_box item_box(const struct bvh_item *item) {
    return (struct bvh_box){{item->lower[0], item->lower[1], item->lower[2]},
                            {item->upper[0], item->upper[1], item->upper[2]}};
}
static inline struct bvh_box binary_box(const struct binary_tree *tree, struct binary_range r) {
    return r.count == 1 ? item_box(&tree->items[r.begin]) : tree->nodes[r.node].box;
}

static inline float float_min(float a, float b) {
    return a < b ? a : b;
}
static inline float float_max(float a, float b) {
    return a > b ? a : b;
}

static inline struct bvh_box box_empty(void) {
    return (struct bvh_box){{BVH_COORDINATE_MAX, BVH_COORDINATE_MAX, BVH_COORDINATE_MAX},
                            {-BVH_COORDINATE_MAX, -BVH_COORDINATE_MAX, -BVH_COORDINATE_MAX}};
}
static inline void box_grow(struct bvh_box *box, const float lower[3], const float upper[3]) {
    for (int axis = 0; axis < 3; axis++) {
        box->lower[axis] = float_min(box->lower[axis], lower[axis]);
        box->upper[axis] = float_max(box->upper[axis], upper[axis]);
    }
}
// Half of the surface; in double, so that no box overflows or vanishes.
static inline double box_area(const struct bvh_box *box) {
    double x = (double)box->upper[0] - box->lower[0];
    double y = (double)box->upper[1] - box->lower[1];
    double z = (double)box->upper[2] - box->lower[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
}
// Twice the centre.
static inline float item_middle(const struct bvh_item *item, int axis) {
    return item->lower[axis] + item->upper[axis];
}

#endif
