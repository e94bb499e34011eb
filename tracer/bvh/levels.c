// Combines trees: moves their nodes, and turns the leaves of a tree into nodes.
#include "core/float_bits.h"
#include "tracer/bvh/bvh.h"

#include "core/heap.h"
#include "core/parallel.h"
#include "shaders/gpu_scene.h"
#include "shaders/records.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PIECE = 8192,
    EXPONENT_BIAS = 127,
    INNER = 1u << 5 | 24, // meta of an inner child, less its slot
    OFFSET_MASK = 0x1f,   // of a leaf's meta
};

// Byte `slot` of eight in two components.
static uint32_t byte_of(uint32_t a, uint32_t b, int slot) {
    return (slot < 4 ? a : b) >> (slot % 4 * 8) & 0xff;
}

static uint32_t meta_of(const struct gpu_word *node, int slot) {
    return byte_of(node[1].z, node[1].w, slot);
}
static bool is_inner(const struct gpu_word *node, int slot) {
    return node[0].w >> (24 + slot) & 1;
}

// ---- bounds

static struct bvh_bounds child_bounds(const struct gpu_word *node, int slot) {
    const uint32_t corner[3] = {node[0].x, node[0].y, node[0].z};
    const uint32_t low[3][2] = {{node[2].x, node[2].y}, {node[2].z, node[2].w}, {node[3].x, node[3].y}};
    const uint32_t high[3][2] = {{node[3].z, node[3].w}, {node[4].x, node[4].y}, {node[4].z, node[4].w}};
    struct bvh_bounds bounds;
    for (int axis = 0; axis < 3; axis++) {
        const double cell = ldexp(1, (int)(node[0].w >> (8 * axis) & 0xff) - EXPONENT_BIAS);
        bounds.lower[axis] =
            (double)float_of_bits(corner[axis]) + cell * byte_of(low[axis][0], low[axis][1], slot);
        bounds.upper[axis] =
            (double)float_of_bits(corner[axis]) + cell * byte_of(high[axis][0], high[axis][1], slot);
    }
    return bounds;
}

uint32_t bvh_first_bounds(const struct bvh *bvh, struct bvh_bounds out[BVH_BOUNDS_MOST]) {
    const struct gpu_word *root = bvh->nodes;
    uint32_t count = 0, next = root[1].x;
    for (int slot = 0; slot < BVH_WIDTH; slot++) {
        if (!meta_of(root, slot))
            continue;
        if (!is_inner(root, slot)) {
            out[count++] = child_bounds(root, slot);
            continue;
        }
        const struct gpu_word *node = bvh->nodes + (size_t)NODE_WORDS * next++;
        for (int k = 0; k < BVH_WIDTH; k++)
            if (meta_of(node, k))
                out[count++] = child_bounds(node, k);
    }
    return count;
}

// ---- nodes in place of leaves

struct opening {
    const struct bvh *from;
    const struct gpu_word *leaves;
    struct gpu_word *nodes; // by new number
    uint32_t *old;          // by new number: the old one, or LEAF and an item
    uint32_t count;
};

#define LEAF 0x80000000u

// A node's children follow each other, as the nodes of a level do: leaves are numbered among them.
static void open_node(struct opening *o, uint32_t number) {
    const struct gpu_word *old = o->from->nodes + (size_t)NODE_WORDS * o->old[number];
    struct gpu_word *node = o->nodes + (size_t)NODE_WORDS * number;
    uint32_t meta[2] = {0, 0}, inner = old[1].x;
    memcpy(node, old, NODE_WORDS * sizeof *node);
    node[1].x = o->count;
    node[1].y = 0;
    for (int slot = 0; slot < BVH_WIDTH; slot++) {
        const uint32_t before = meta_of(old, slot);
        if (!before)
            continue;
        assert(is_inner(old, slot) || before >> 5 == 1);
        o->old[o->count++] =
            is_inner(old, slot) ? inner++ : LEAF | o->from->order[old[1].y + (before & OFFSET_MASK)];
        if (!is_inner(old, slot))
            node[1].y |= 1u << slot;
        meta[slot / 4] |= (INNER + (uint32_t)slot) << (slot % 4 * 8);
        node[0].w |= 1u << (24 + slot);
    }
    node[1].z = meta[0];
    node[1].w = meta[1];
}

bool bvh_open_leaves(struct bvh *bvh, const struct gpu_word *leaves) {
    const size_t all = (size_t)bvh->node_count + bvh->item_count;
    struct opening o = {.from = bvh, .leaves = leaves, .count = 1};
    o.nodes = heap_array(heap_times(all, NODE_WORDS), sizeof *o.nodes);
    o.old = heap_array(all, sizeof *o.old);
    const bool done = o.nodes && o.old;
    if (done)
        o.old[0] = 0;
    for (uint32_t i = 0; done && i < o.count; i++) {
        if (o.old[i] & LEAF)
            memcpy(o.nodes + (size_t)NODE_WORDS * i, leaves + (size_t)NODE_WORDS * (o.old[i] & ~LEAF),
                   NODE_WORDS * sizeof *o.nodes);
        else
            open_node(&o, i);
    }
    free(o.old);
    if (!done) {
        free(o.nodes);
        return false;
    }
    free(bvh->nodes);
    bvh->nodes = o.nodes;
    bvh->node_count = o.count;
    bvh->depth++;
    return true;
}

// ---- moving

struct moving {
    struct gpu_word *nodes;
    uint32_t by_nodes, by_items;
};

static void move_nodes(void *context, size_t begin, size_t end) {
    const struct moving *m = context;
    for (size_t i = begin; i < end; i++) {
        m->nodes[NODE_WORDS * i + 1].x += m->by_nodes;
        m->nodes[NODE_WORDS * i + 1].y += m->by_items;
    }
}

void bvh_move(struct bvh *bvh, uint32_t nodes, uint32_t items) {
    struct moving moving = {bvh->nodes, nodes, items};
    parallel_for(bvh->node_count, PIECE, move_nodes, &moving);
}
