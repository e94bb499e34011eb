#include "tracer/bvh/binary.h"

#include "core/parallel.h"
#include "tracer/bvh/subtree.h"
#include "tracer/bvh/top.h"

#include "core/heap.h"

#include <stdlib.h>
#include <string.h>

struct build {
    const struct binary_tree *tree;
    enum bvh_method method;
    uint32_t leaf_items; // at most
    struct top *top;
    struct subtree *results; // of the small ranges of the top
};

static void build_range(const struct build *build, struct binary_range range, unsigned level,
                        const struct bvh_box *middles, struct subtree *out) {
    const struct binary_tree *tree = build->tree;
    struct bvh_item *items = tree->items + range.begin;
    if (range.count == 1) {
        subtree_of_item(items, out);
        return;
    }
    struct binary_node *node = &tree->nodes[range.node];
    struct bvh_box sides[2] = {*middles, *middles};
    node->left_count = top_is_halved(build->method, level) ? split_halves(items, range.count)
                                                           : split_items(items, range.count, middles, sides);
    struct subtree left, right;
    build_range(build, binary_left(tree, range), level + 1, &sides[0], &left);
    build_range(build, binary_right(tree, range), level + 1, &sides[1], &right);
    subtree_join(node, build->leaf_items, &left, &right, out);
}

static void build_small(void *context, size_t begin, size_t end) {
    const struct build *build = context;
    for (size_t i = begin; i < end; i++) {
        const struct top_node *node = &build->top->nodes[build->top->small[i]];
        build_range(build, node->range, node->level, &node->middles, &build->results[build->top->small[i]]);
    }
}

// The subtrees of the large ranges, from those of their children, which have higher numbers.
static void join_large(const struct build *build) {
    for (uint32_t i = build->top->count; i-- > 0;) {
        const struct top_node *node = &build->top->nodes[i];
        if (node->is_small)
            continue;
        struct binary_node *binary = &build->tree->nodes[node->range.node];
        binary->left_count = build->top->nodes[node->left].range.count;
        subtree_join(binary, build->leaf_items, &build->results[node->left], &build->results[node->left + 1],
                     &build->results[i]);
    }
}

bool binary_build(struct binary_tree *tree, enum bvh_method method) {
    struct top top;
    const uint32_t leaf_items = method == BVH_SAH_SINGLES ? 1 : method == BVH_SAH_PAIRS ? 2 : BVH_LEAF_ITEMS;
    if (!top_build(tree->items, tree->count, method, &top))
        return false;
    struct build build = {.tree = tree, .method = method, .leaf_items = leaf_items, .top = &top};
    tree->nodes = heap_array(tree->count, sizeof *tree->nodes);
    build.results = heap_array(top.count, sizeof *build.results);
    bool done = tree->nodes && build.results;
    if (done) {
        parallel_for(top.small_count, 1, build_small, &build);
        join_large(&build);
    }
    free(build.results);
    top_finish(&top);
    return done;
}
