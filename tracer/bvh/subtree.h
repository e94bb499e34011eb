// What a parent needs to know about a finished subtree, and how the wide tree will use it: the dynamic
// programme of Ylitie, Karras, Laine 2017, section 3.1. Private to tracer/bvh. Thread safety: pure.
#ifndef GLINT_TRACER_BVH_SUBTREE_H
#define GLINT_TRACER_BVH_SUBTREE_H

#include "tracer/bvh/binary.h"

struct subtree {
    struct bvh_box box;
    uint32_t count;
    // The least cost of the subtree as up to i + 1 roots (eq. 2), for i below both BVH_WIDTH - 1 and count:
    // more roots than items cost the same.
    double cost[BVH_WIDTH - 1];
};

void subtree_of_item(const struct bvh_item *item, struct subtree *out);
// Joins two subtrees in a node, and decides its choices. A leaf holds up to `leaf_items` items.
void subtree_join(struct binary_node *node, uint32_t leaf_items, const struct subtree *left,
                  const struct subtree *right, struct subtree *out);

#endif
