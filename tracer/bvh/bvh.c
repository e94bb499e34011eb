#include "tracer/bvh/bvh.h"

#include "core/heap.h"
#include "shaders/gpu_scene.h"
#include "shaders/records.h"
#include "tracer/bvh/encode.h"
#include "tracer/bvh/wide.h"

#include <stdlib.h>

static bool build_empty(struct bvh *out) {
    static const struct wide_child none[BVH_WIDTH];
    out->nodes = heap_array(NODE_WORDS, sizeof *out->nodes);
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
    bool done = binary_build(&tree, method);
    out->order = done ? heap_array(count, sizeof *out->order) : NULL;
    done = out->order && wide_build(&tree, out);
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
