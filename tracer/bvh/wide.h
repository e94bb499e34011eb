// From the binary tree to the wide one. Private to tracer/bvh.
#ifndef GLINT_TRACER_BVH_WIDE_H
#define GLINT_TRACER_BVH_WIDE_H

#include "tracer/bvh/binary.h"

// Fills nodes, order, node_count and depth of `out`; its `order` has room for all items; tree.count is at
// least 1. false: no memory.
bool wide_build(const struct binary_tree *tree, struct bvh *out);

#endif
