// All ranges of a level are cut at once: their items, in pieces of a fixed size, are put into bins, the
// planes are chosen, and the pieces are sorted into a second array, from which the next level starts. So each
// level reads the items twice and writes them once, and pieces do not depend on threads.
#include "tracer/bvh/top.h"

#include "core/heap.h"
#include "core/parallel.h"

#include <stdlib.h>
#include <string.h>

enum {
    PIECE_ITEMS = 16384,   // of work on one large range
    SMALL_ITEMS = 8192,    // ranges up to this are built by one thread
    SUBTREES_WANTED = 128, // ranges up to this fraction of all items, too
};

struct piece {
    struct split_bins bins;
    struct bvh_box sides[2]; // bounds of the middles on each side
    uint32_t node;           // of the top
    uint32_t begin, end;     // items
    uint32_t left, right;    // where its first item for each side goes
};

struct cut {
    struct split_grid grid;
    struct split_plane plane;
    uint32_t first_piece, end_piece;
};

struct cutting {
    struct top *top;
    enum bvh_method method;
    uint32_t small_items;
    struct bvh_item *items, *moved;
    uint32_t level_begin, level_end; // nodes
    struct cut *cuts;                // by node of the level
    struct piece *pieces;
    uint32_t piece_count;
};

static const struct bvh_item *items_of(const struct cutting *c, const struct top_node *node) {
    return node->is_moved ? c->moved : c->items;
}

static void piece_bins(void *context, size_t begin, size_t end) {
    const struct cutting *c = context;
    for (size_t i = begin; i < end; i++) {
        struct piece *piece = &c->pieces[i];
        const struct cut *cut = &c->cuts[piece->node - c->level_begin];
        const struct bvh_item *items = items_of(c, &c->top->nodes[piece->node]);
        split_bins_clear(&piece->bins);
        split_bins_add(&piece->bins, &cut->grid, items + piece->begin, piece->end - piece->begin);
    }
}

// Moves each item of a piece to its side.
static void piece_part(void *context, size_t begin, size_t end) {
    const struct cutting *c = context;
    for (size_t i = begin; i < end; i++) {
        struct piece *piece = &c->pieces[i];
        const struct cut *cut = &c->cuts[piece->node - c->level_begin];
        const struct top_node *node = &c->top->nodes[piece->node];
        if (cut->plane.axis < 0)
            continue;
        const struct bvh_item *from = items_of(c, node);
        struct bvh_item *to = node->is_moved ? c->items : c->moved;
        struct bvh_box lefts = box_empty();
        struct bvh_box rights = box_empty();
        uint32_t left = piece->left;
        uint32_t right = piece->right;
        for (uint32_t k = piece->begin; k < piece->end; k++) {
            const lanes middles = item_middles(&from[k]);
            if (split_is_left(&cut->grid, cut->plane, &from[k])) {
                box_add_point(&lefts, middles);
                to[left++] = from[k];
            } else {
                box_add_point(&rights, middles);
                to[right++] = from[k];
            }
        }
        piece->sides[0] = lefts;
        piece->sides[1] = rights;
    }
}

static bool push(struct top *top, struct top_node node) {
    struct top_node *nodes = heap_grow(top->nodes, top->count, &top->capacity, sizeof *nodes);
    if (!nodes)
        return false;
    top->nodes = nodes;
    top->nodes[top->count++] = node;
    return true;
}

// `left_count` items of node `number` go left.
static bool push_sides(struct cutting *c, uint32_t number, uint32_t left_count, bool is_moved,
                       const struct bvh_box sides[2]) {
    const struct top_node node = c->top->nodes[number];
    const struct binary_range range = node.range;
    struct top_node left = {.range = {range.node + 1, range.begin, left_count},
                            .middles = sides[0],
                            .level = node.level + 1,
                            .is_moved = is_moved};
    struct top_node right = left;
    right.range =
        (struct binary_range){range.node + left_count, range.begin + left_count, range.count - left_count};
    right.middles = sides[1];
    c->top->nodes[number].left = c->top->count;
    return push(c->top, left) && push(c->top, right);
}

// Halves nodes, one thread per node.
static void halve_nodes(void *context, size_t begin, size_t end) {
    const struct cutting *c = context;
    for (size_t i = begin; i < end; i++) {
        struct top_node *node = &c->top->nodes[c->level_begin + i];
        struct bvh_item *items = node->is_moved ? c->moved : c->items;
        if (!node->is_small && top_is_halved(c->method, node->level))
            split_halves(items + node->range.begin, node->range.count);
    }
}

static size_t pieces_of(const struct top_node *node) {
    return ((size_t)node->range.count + PIECE_ITEMS - 1) / PIECE_ITEMS;
}

// Lists the pieces of the level's large nodes. false: no memory.
static bool list_pieces(struct cutting *c) {
    size_t total = 0;
    for (uint32_t i = c->level_begin; i < c->level_end; i++) {
        struct top_node *node = &c->top->nodes[i];
        node->is_small = node->range.count <= c->small_items;
        total += node->is_small ? 0 : pieces_of(node);
    }
    c->piece_count = 0;
    c->pieces = heap_array(total + 1, sizeof *c->pieces);
    c->cuts = heap_array(c->level_end - c->level_begin + 1, sizeof *c->cuts);
    if (!c->pieces || !c->cuts)
        return false;
    for (uint32_t i = c->level_begin; i < c->level_end; i++) {
        const struct top_node *node = &c->top->nodes[i];
        struct cut *cut = &c->cuts[i - c->level_begin];
        *cut = (struct cut){.grid = split_grid_make(&node->middles), .first_piece = c->piece_count};
        const uint32_t end = node->range.begin + node->range.count;
        for (uint32_t at = node->range.begin;
             !node->is_small && !top_is_halved(c->method, node->level) && at < end;) {
            struct piece *piece = &c->pieces[c->piece_count++];
            piece->node = i;
            piece->begin = at;
            at = piece->end = end - at > PIECE_ITEMS ? at + PIECE_ITEMS : end;
        }
        cut->end_piece = c->piece_count;
    }
    return true;
}

// Chooses a node's plane, and where its pieces put their items. Returns the number of items on the left.
static uint32_t choose(struct cutting *c, const struct top_node *node, struct cut *cut) {
    struct split_bins all;
    split_bins_clear(&all);
    for (uint32_t i = cut->first_piece; i < cut->end_piece; i++)
        split_bins_merge(&all, &c->pieces[i].bins);
    cut->plane = split_best(&all, &cut->grid);
    if (cut->plane.axis < 0)
        return node->range.count / 2;
    uint32_t lefts = 0;
    for (uint32_t i = cut->first_piece; i < cut->end_piece; i++) {
        struct piece *piece = &c->pieces[i];
        piece->left = node->range.begin + lefts;
        for (int bin = 0; bin < cut->plane.bin; bin++)
            lefts += piece->bins.count[cut->plane.axis][bin];
    }
    // Items before a piece that are not on the left are on the right.
    for (uint32_t i = cut->first_piece; i < cut->end_piece; i++) {
        struct piece *piece = &c->pieces[i];
        piece->right = lefts + piece->begin - (piece->left - node->range.begin);
    }
    return lefts;
}

static bool finish_node(struct cutting *c, uint32_t number, uint32_t left_count) {
    const struct cut *cut = &c->cuts[number - c->level_begin];
    const struct top_node *node = &c->top->nodes[number];
    struct bvh_box sides[2] = {node->middles, node->middles};
    const bool is_parted = cut->first_piece < cut->end_piece && cut->plane.axis >= 0;
    if (is_parted)
        sides[0] = sides[1] = box_empty();
    for (uint32_t i = cut->first_piece; is_parted && i < cut->end_piece; i++)
        for (int side = 0; side < 2; side++)
            box_join(&sides[side], &c->pieces[i].sides[side]);
    return push_sides(c, number, left_count, node->is_moved != is_parted, sides);
}

// Cuts the large nodes of a level; the next level begins where this one ends. false: no memory.
static bool cut_level(struct cutting *c) {
    bool done = list_pieces(c);
    if (done) {
        parallel_for(c->piece_count, 1, piece_bins, c);
        for (uint32_t i = c->level_begin; i < c->level_end; i++) {
            struct top_node *node = &c->top->nodes[i];
            struct cut *cut = &c->cuts[i - c->level_begin];
            node->left = cut->first_piece < cut->end_piece ? choose(c, node, cut) : node->range.count / 2;
        }
        parallel_for(c->piece_count, 1, piece_part, c);
        parallel_for(c->level_end - c->level_begin, 1, halve_nodes, c);
    }
    for (uint32_t i = c->level_begin; done && i < c->level_end; i++)
        if (!c->top->nodes[i].is_small)
            done = finish_node(c, i, c->top->nodes[i].left);
    free(c->pieces);
    free(c->cuts);
    c->level_begin = c->level_end;
    c->level_end = c->top->count;
    return done;
}

// Brings items in the second array back.
static void settle_nodes(void *context, size_t begin, size_t end) {
    const struct cutting *c = context;
    for (size_t i = begin; i < end; i++) {
        const struct top_node *node = &c->top->nodes[c->top->small[i]];
        const struct binary_range range = node->range;
        if (node->is_moved)
            memcpy(c->items + range.begin, c->moved + range.begin, range.count * sizeof *c->items);
    }
}

static bool list_small(struct top *top) {
    top->small = heap_array(top->count, sizeof *top->small);
    for (uint32_t i = 0; top->small && i < top->count; i++)
        if (top->nodes[i].is_small)
            top->small[top->small_count++] = i;
    return top->small != NULL;
}

struct bounding {
    const struct bvh_item *items;
    struct bvh_box *bounds; // by piece
};

static void piece_middles(void *context, size_t begin, size_t end) {
    const struct bounding *b = context;
    b->bounds[begin / PIECE_ITEMS] = split_middles(b->items + begin, end - begin);
}

static bool bound_all(const struct bvh_item *items, uint32_t count, struct bvh_box *middles) {
    const size_t pieces = ((size_t)count + PIECE_ITEMS - 1) / PIECE_ITEMS;
    struct bounding b = {items, heap_array(pieces, sizeof *b.bounds)};
    if (!b.bounds)
        return false;
    parallel_for(count, PIECE_ITEMS, piece_middles, &b);
    *middles = b.bounds[0];
    for (size_t i = 1; i < pieces; i++)
        box_join(middles, &b.bounds[i]);
    free(b.bounds);
    return true;
}

bool top_build(struct bvh_item *items, uint32_t count, enum bvh_method method, struct top *top) {
    *top = (struct top){0};
    struct cutting c = {.top = top, .method = method, .items = items, .level_end = 1};
    c.small_items = count / SUBTREES_WANTED > SMALL_ITEMS ? count / SUBTREES_WANTED : SMALL_ITEMS;
    c.moved = count > c.small_items ? heap_array(count, sizeof *c.moved) : NULL;
    struct top_node root = {.range = {0, 0, count}};
    bool done = (c.moved || count <= c.small_items) && bound_all(items, count, &root.middles);
    done = done && push(top, root);
    while (done && c.level_begin < c.level_end)
        done = cut_level(&c);
    done = done && list_small(top);
    if (done && c.moved)
        parallel_for(top->small_count, 1, settle_nodes, &c);
    free(c.moved);
    if (!done)
        top_finish(top);
    return done;
}

void top_finish(struct top *top) {
    free(top->nodes);
    free(top->small);
    *top = (struct top){0};
}
