#include "tracer/bvh/bvh.h"

#include "shaders/gpu_scene.h"
#include "shaders/records.h"
#include "tracer/bvh/encode.h"
#include "tracer/bvh/wide.h"

#include <stdlib.h>

static bool build_empty(struct bvh *out) {
    static const struct wide_child none[BVH_WIDTH];
    out->nodes = malloc(NODE_WORDS * sizeof *out->nodes);
    if (!out->nodes)
        return false;
    encode_node(none, 0, 0, out->nodes);
    out->node_count = 1;
    out->depth = 1;
    return true;
}

bool bvh_build(struct bvh_item *items, uint32_t count, enum bvh_method method, struct bvh *out) {
    *out = (struct bvh){.item_count = count};
    if (count == 0)
        return build_empty(out);
    struct binary_tree tree = {.items = items, .count = count};
    out->order = malloc(count * sizeof *out->order);
    bool done = out->order && binary_build(&tree, method) && wide_build(&tree, out);
    free(tree.nodes);
    if (!done)
        bvh_finish(out);
    return done;
}

void bvh_finish(struct bvh *bvh) {
    if (!bvh)
        return;
    free(bvh->nodes);
    free(bvh->order);
    *bvh = (struct bvh){0};
}

static double decoded_area(const struct decoded_child *child) {
    double x = child->upper[0] - child->lower[0];
    double y = child->upper[1] - child->lower[1];
    double z = child->upper[2] - child->lower[2];
    return x * y + y * z + z * x;
}

struct bvh_quality bvh_measure(const struct bvh *bvh) {
    struct bvh_quality quality = {.nodes = bvh->node_count, .items = bvh->item_count};
    uint64_t children = 0;
    double lower[3], upper[3];
    for (uint32_t node = 0; node < bvh->node_count; node++)
        for (int slot = 0; slot < BVH_WIDTH; slot++) {
            struct decoded_child child;
            if (!decode_child(bvh->nodes + (size_t)NODE_WORDS * node, slot, &child))
                continue;
            for (int axis = 0; axis < 3 && node == 0; axis++) {
                if (children == 0 || child.lower[axis] < lower[axis])
                    lower[axis] = child.lower[axis];
                if (children == 0 || child.upper[axis] > upper[axis])
                    upper[axis] = child.upper[axis];
            }
            children++;
            quality.leaves += !child.is_node;
            quality.cost +=
                decoded_area(&child) * (child.is_node ? BVH_COST_NODE : child.count * BVH_COST_ITEM);
        }
    if (children) {
        struct decoded_child root = {.lower = {lower[0], lower[1], lower[2]},
                                     .upper = {upper[0], upper[1], upper[2]}};
        double area = decoded_area(&root);
        quality.cost = BVH_COST_NODE + (area > 0 ? quality.cost / area : 0);
        quality.children_per_node = (double)children / bvh->node_count;
    }
    if (quality.leaves)
        quality.items_per_leaf = (double)bvh->item_count / quality.leaves;
    return quality;
}
