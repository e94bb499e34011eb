#include "tracer/bvh/binary.h"

#include "core/heap.h"
#include "core/parallel.h"
#include "tracer/bvh/split.h"

#include <stdlib.h>
#include <string.h>

enum {
    PIECE_ITEMS = 16384,   // of work on one large range
    SUBTREE_ITEMS = 8192,  // ranges below this are built by one thread
    SUBTREES_WANTED = 128, // ranges below this part of all items, too
    LEVELS_BY_COST = 48,   // deeper ranges are halved, so that no input makes a deep tree
};

// What a parent needs to know of a finished subtree: its least costs as up to i + 1 roots (Ylitie et al.
// 2017, eq. 2).
struct subtree {
    struct bvh_box box;
    double cost[BVH_WIDTH - 1];
};

// Where a large range was cut; its children follow when all small ranges are done.
struct top_node {
    struct binary_range range;
    uint32_t left, right; // indices of top_node
    unsigned level;
    bool is_small;
    struct subtree result;
};

struct build {
    struct binary_tree *tree;
    enum bvh_method method;
    uint32_t leaf_items; // at most
    struct top_node *top;
    uint32_t top_count, top_capacity;
    uint32_t *small; // indices of top_node
    uint32_t small_count;
};

static struct subtree subtree_of_item(const struct bvh_item *item) {
    struct subtree result = {.box = item_box(item)};
    double cost = box_area(&result.box) * BVH_COST_ITEM;
    for (int i = 0; i < BVH_WIDTH - 1; i++)
        result.cost[i] = cost;
    return result;
}

// Ylitie et al. 2017, eq. 2 to 5: the costs of a subtree from those of its children.
static struct subtree subtree_join(struct binary_node *node, uint32_t count, uint32_t leaf_items,
                                   const struct subtree *left, const struct subtree *right) {
    struct subtree result = {.box = left->box};
    box_grow(&result.box, right->box.lower, right->box.upper);
    node->box = result.box;
    double distributed[BVH_WIDTH]; // [i]: as i + 1 roots or fewer, at least 2
    for (int roots = 2; roots <= BVH_WIDTH; roots++) {
        double best = left->cost[0] + right->cost[roots - 2];
        uint8_t best_left = 1;
        for (int k = 2; k < roots; k++) {
            double cost = left->cost[k - 1] + right->cost[roots - k - 1];
            if (cost < best) {
                best = cost;
                best_left = (uint8_t)k;
            }
        }
        distributed[roots - 1] = best;
        node->decision[roots - 1] = best_left;
    }
    double area = box_area(&result.box);
    double as_leaf = area * count * BVH_COST_ITEM;
    double as_node = distributed[BVH_WIDTH - 1] + area * BVH_COST_NODE;
    node->decision[0] = count <= leaf_items && as_leaf <= as_node;
    result.cost[0] = node->decision[0] ? as_leaf : as_node;
    for (int i = 1; i < BVH_WIDTH - 1; i++) {
        if (result.cost[i - 1] <= distributed[i])
            node->decision[i] = 0;
        result.cost[i] = node->decision[i] ? distributed[i] : result.cost[i - 1];
    }
    return result;
}

static uint32_t cut(const struct build *build, struct binary_range range, unsigned level) {
    struct bvh_item *items = build->tree->items + range.begin;
    if (build->method == BVH_MEDIAN || level >= LEVELS_BY_COST)
        return split_halves(items, range.count);
    return split_items(items, range.count);
}

static struct subtree build_range(const struct build *build, struct binary_range range, unsigned level) {
    const struct binary_tree *tree = build->tree;
    if (range.count == 1)
        return subtree_of_item(&tree->items[range.begin]);
    struct binary_node *node = &tree->nodes[range.node];
    node->left_count = cut(build, range, level);
    struct subtree left = build_range(build, binary_left(tree, range), level + 1);
    struct subtree right = build_range(build, binary_right(tree, range), level + 1);
    return subtree_join(node, range.count, build->leaf_items, &left, &right);
}

// ---- ranges so large that threads share one

struct wide_cut {
    struct bvh_item *items;
    struct bvh_item *sorted; // as many, scratch
    struct bvh_box *middles; // one a piece, as those below
    struct split_bins *bins;
    uint32_t *lefts;
    struct split_grid grid;
    struct split_plane plane;
    uint32_t left_count;
};

static void piece_middles(void *context, size_t begin, size_t end) {
    struct wide_cut *cut = context;
    cut->middles[begin / PIECE_ITEMS] = split_middles(cut->items + begin, end - begin);
}

static void piece_bins(void *context, size_t begin, size_t end) {
    struct wide_cut *cut = context;
    struct split_bins *bins = &cut->bins[begin / PIECE_ITEMS];
    split_bins_clear(bins);
    split_bins_add(bins, &cut->grid, cut->items + begin, end - begin);
}

// Moves each item to its side; `lefts` holds how many items left of the plane come before the piece.
static void piece_part(void *context, size_t begin, size_t end) {
    struct wide_cut *cut = context;
    uint32_t left = cut->lefts[begin / PIECE_ITEMS];
    uint32_t right = cut->left_count + ((uint32_t)begin - left);
    for (size_t i = begin; i < end; i++) {
        bool is_left = split_bin(&cut->grid, &cut->items[i], cut->plane.axis) < cut->plane.bin;
        cut->sorted[is_left ? left++ : right++] = cut->items[i];
    }
}

static void piece_copy(void *context, size_t begin, size_t end) {
    struct wide_cut *cut = context;
    memcpy(cut->items + begin, cut->sorted + begin, (end - begin) * sizeof *cut->items);
}

static uint32_t cut_wide(struct wide_cut *cut, uint32_t count) {
    uint32_t pieces = (count + PIECE_ITEMS - 1) / PIECE_ITEMS;
    parallel_for(count, PIECE_ITEMS, piece_middles, cut);
    struct bvh_box middles = cut->middles[0];
    for (uint32_t i = 1; i < pieces; i++)
        box_grow(&middles, cut->middles[i].lower, cut->middles[i].upper);
    cut->grid = split_grid_make(&middles);
    parallel_for(count, PIECE_ITEMS, piece_bins, cut);
    struct split_bins bins;
    split_bins_clear(&bins);
    for (uint32_t i = 0; i < pieces; i++)
        split_bins_merge(&bins, &cut->bins[i]);
    cut->plane = split_best(&bins, &cut->grid);
    if (cut->plane.axis < 0)
        return count / 2;
    cut->left_count = 0;
    for (uint32_t i = 0; i < pieces; i++) {
        cut->lefts[i] = cut->left_count;
        for (int bin = 0; bin < cut->plane.bin; bin++)
            cut->left_count += cut->bins[i].count[cut->plane.axis][bin];
    }
    parallel_for(count, PIECE_ITEMS, piece_part, cut);
    parallel_for(count, PIECE_ITEMS, piece_copy, cut);
    return cut->left_count;
}

static bool push_top(struct build *build, struct binary_range range, unsigned level, uint32_t *index) {
    struct top_node *top = heap_grow(build->top, build->top_count, &build->top_capacity, sizeof *top);
    if (!top)
        return false;
    build->top = top;
    *index = build->top_count++;
    build->top[*index] = (struct top_node){.range = range, .level = level};
    return true;
}

// Cuts large ranges, breadth first, until only small ones are left.
static bool build_top(struct build *build, struct wide_cut *cut_memory) {
    uint32_t count = build->tree->count;
    uint32_t small = count / SUBTREES_WANTED > SUBTREE_ITEMS ? count / SUBTREES_WANTED : SUBTREE_ITEMS;
    uint32_t root;
    if (!push_top(build, (struct binary_range){0, 0, count}, 0, &root))
        return false;
    for (uint32_t i = 0; i < build->top_count; i++) {
        struct top_node node = build->top[i];
        node.is_small = node.range.count <= small;
        if (!node.is_small) {
            struct wide_cut *wide = cut_memory;
            wide->items = build->tree->items + node.range.begin;
            build->tree->nodes[node.range.node].left_count =
                build->method != BVH_MEDIAN && node.level < LEVELS_BY_COST
                    ? cut_wide(wide, node.range.count)
                    : cut(build, node.range, node.level);
            if (!push_top(build, binary_left(build->tree, node.range), node.level + 1, &node.left) ||
                !push_top(build, binary_right(build->tree, node.range), node.level + 1, &node.right))
                return false;
        }
        build->top[i] = node;
    }
    build->small = heap_alloc(build->top_count * sizeof *build->small);
    if (!build->small)
        return false;
    for (uint32_t i = 0; i < build->top_count; i++)
        if (build->top[i].is_small)
            build->small[build->small_count++] = i;
    return true;
}

static void build_small(void *context, size_t begin, size_t end) {
    struct build *build = context;
    for (size_t i = begin; i < end; i++) {
        struct top_node *node = &build->top[build->small[i]];
        node->result = build_range(build, node->range, node->level);
    }
}

bool binary_build(struct binary_tree *tree, enum bvh_method method) {
    size_t count = tree->count;
    size_t pieces = (count + PIECE_ITEMS - 1) / PIECE_ITEMS;
    const uint32_t leaf_items = method == BVH_SAH_SINGLES ? 1 : method == BVH_SAH_PAIRS ? 2 : BVH_LEAF_ITEMS;
    struct build build = {.tree = tree, .method = method, .leaf_items = leaf_items};
    struct wide_cut wide = {0};
    bool done = false;
    tree->nodes = heap_alloc(count * sizeof *tree->nodes);
    wide.middles = heap_alloc(pieces * sizeof *wide.middles);
    wide.bins = heap_alloc(pieces * sizeof *wide.bins);
    wide.lefts = heap_alloc(pieces * sizeof *wide.lefts);
    wide.sorted = count > SUBTREE_ITEMS ? heap_alloc(count * sizeof *wide.sorted) : NULL;
    if (!tree->nodes || !wide.middles || !wide.bins || !wide.lefts || (count > SUBTREE_ITEMS && !wide.sorted))
        goto out;
    if (!build_top(&build, &wide))
        goto out;
    parallel_for(build.small_count, 1, build_small, &build);
    for (uint32_t i = build.top_count; i-- > 0;) {
        struct top_node *node = &build.top[i];
        if (!node->is_small)
            node->result = subtree_join(&tree->nodes[node->range.node], node->range.count, leaf_items,
                                        &build.top[node->left].result, &build.top[node->right].result);
    }
    done = true;
out:
    free(wide.sorted);
    free(wide.lefts);
    free(wide.bins);
    free(wide.middles);
    free(build.small);
    free(build.top);
    if (!done) {
        free(tree->nodes);
        tree->nodes = NULL;
    }
    return done;
}
