// The 8-wide compressed tree of shaders/gpu_scene.h over boxes: triangles, or spheres.
//
// A binary tree is built by binned surface area heuristic (Wald 2007) down to single items, collapsed at the
// least expected cost to eight children and leaves of at most three items (Ylitie, Karras, Laine 2017,
// section 3), its children are put into slots by octant for front-to-back order (section 3.2), and its boxes
// are quantised so that the decoding t = (p - o)/d + q * (2^e/d) in single precision never loses a hit. The
// result depends only on the items and their order, never on threads.
//
// Input: finite coordinates of magnitude up to BVH_COORDINATE_MAX. Item boxes must already be padded for
// the error of the primitive's own test. Errors: false when memory ends; nothing else can fail.
// Ownership: bvh_finish frees. Thread safety: a finished tree is immutable.
#ifndef GLINT_TRACER_BVH_BVH_H
#define GLINT_TRACER_BVH_BVH_H

#include "tracer/gpu_word.h"

#include <stdbool.h>
#include <stdint.h>

#define BVH_COORDINATE_MAX 0x1p120f

enum {
    BVH_WIDTH = 8,
    BVH_LEAF_ITEMS = 3,
    BVH_DEPTH_MAX = 80, // levels that no input exceeds
};

struct bvh_item {
    float lower[3];
    uint32_t index; // the caller's; never looked at
    float upper[3];
    uint32_t spare;
};

enum bvh_method {
    BVH_SAH,
    BVH_MEDIAN, // halves along the longest axis: the baseline of bench/
    // As BVH_SAH with leaves of at most two items, and of one: pictures do not depend on the tree, and tests
    // prove it.
    BVH_SAH_PAIRS,
    BVH_SAH_SINGLES,
};

struct bvh {
    struct gpu_word *nodes; // NODE_WORDS each; at least one node, which may be without children
    uint32_t node_count;
    uint32_t *order; // the items' `index` in the order of the leaves: leaf item i of the nodes is order[i]
    uint32_t item_count;
    uint32_t depth; // levels of nodes, at least 1: a traversal stack of this many entries suffices
};

// Builds the tree; `items` is used as working memory and modified. count 0 makes a node without children.
bool bvh_build(struct bvh_item *items, uint32_t count, enum bvh_method method, struct bvh *out);
void bvh_finish(struct bvh *bvh);

// A box, in the items' space.
struct bvh_bounds {
    double lower[3], upper[3];
};
enum {
    BVH_BOUNDS_MOST = BVH_WIDTH * BVH_WIDTH
};
// Boxes that together hold all items: those of the second level of nodes, or of the first if it has leaves.
// Returns how many.
uint32_t bvh_first_bounds(const struct bvh *bvh, struct bvh_bounds out[BVH_BOUNDS_MOST]);
// Replaces each leaf of a tree with one item per leaf (BVH_SAH_SINGLES) by a node. Item i becomes leaves[i],
// of NODE_WORDS. A node's first item is then the mask of its slots that had leaves. false: no memory.
bool bvh_open_leaves(struct bvh *bvh, const struct gpu_word *leaves);
// Adds these to the first child and the first item of each node.
void bvh_move(struct bvh *bvh, uint32_t nodes, uint32_t items);

// What the builder minimises: the expected number of nodes opened and items tested by a random ray that hits
// the root's box, with these weights.
#define BVH_COST_NODE 1.0
#define BVH_COST_ITEM 0.3

#endif
