// From the binary tree to the wide one, level by level: children first gathered as the binary nodes
// decided, then numbered, then written, so that threads share each level and the order is fixed.
#include "tracer/bvh/wide.h"
#include "core/heap.h"
#include "core/parallel.h"
#include "shaders/gpu_scene.h"
#include "shaders/records.h"
#include "tracer/bvh/encode.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PIECE_NODES = 512
};

struct pending {
    struct binary_range range;            // in: what this node covers
    struct binary_range child[BVH_WIDTH]; // by slot; count 0: none
    uint8_t is_node;                      // bit by slot
    uint32_t first_node, first_item;
};

struct level {
    const struct binary_tree *tree;
    struct bvh *out;
    struct pending *nodes, *next;
    uint32_t first; // number of nodes[0]
    uint32_t next_first;
};

static bool is_leaf(const struct binary_tree *tree, struct binary_range range) {
    return range.count == 1 || tree->nodes[range.node].decision[0];
}

// The roots of a subtree that becomes at most `roots` of them, left to right.
static uint32_t gather(const struct binary_tree *tree, struct binary_range range, int roots, bool must_open,
                       struct binary_range found[BVH_WIDTH], uint32_t count) {
    if (range.count > 1) {
        const struct binary_node *node = &tree->nodes[range.node];
        while (roots > 1 && !node->decision[roots - 1])
            roots--;
        if (roots > 1 || must_open) {
            int left = node->decision[roots - 1];
            count = gather(tree, binary_left(tree, range), left, false, found, count);
            return gather(tree, binary_right(tree, range), roots - left, false, found, count);
        }
    }
    found[count] = range;
    return count + 1;
}

// Sets children into slots so that slot order, turned by the ray's octant, is about front to back: the
// child and slot that agree best first (Ylitie et al. 2017, section 3.2, greedy instead of by auction).
static void assign_slots(const struct binary_tree *tree, const struct binary_range *found, uint32_t count,
                         struct binary_range slots[BVH_WIDTH]) {
    struct bvh_box boxes[BVH_WIDTH];
    struct bvh_box all = box_empty();
    for (uint32_t i = 0; i < count; i++) {
        boxes[i] = binary_box(tree, found[i]);
        box_grow(&all, boxes[i].lower, boxes[i].upper);
    }
    float gain[BVH_WIDTH][BVH_WIDTH];
    for (uint32_t i = 0; i < count; i++) {
        float off[3];
        for (int axis = 0; axis < 3; axis++)
            off[axis] = (boxes[i].lower[axis] - all.lower[axis]) + (boxes[i].upper[axis] - all.upper[axis]);
        for (int slot = 0; slot < BVH_WIDTH; slot++)
            gain[i][slot] =
                (slot & 4 ? off[0] : -off[0]) + (slot & 2 ? off[1] : -off[1]) + (slot & 1 ? off[2] : -off[2]);
    }
    uint32_t placed = 0;
    uint32_t taken = 0;
    for (uint32_t round = 0; round < count; round++) {
        float best = -INFINITY;
        uint32_t best_child = 0;
        int best_slot = 0;
        for (uint32_t i = 0; i < count; i++)
            for (int slot = 0; slot < BVH_WIDTH; slot++)
                if (!(placed >> i & 1) && !(taken >> slot & 1) && gain[i][slot] > best) {
                    best = gain[i][slot];
                    best_child = i;
                    best_slot = slot;
                }
        placed |= 1u << best_child;
        taken |= 1u << best_slot;
        slots[best_slot] = found[best_child];
    }
}

static void open_nodes(void *context, size_t begin, size_t end) {
    struct level *level = context;
    for (size_t i = begin; i < end; i++) {
        struct pending *node = &level->nodes[i];
        struct binary_range found[BVH_WIDTH];
        uint32_t count = gather(level->tree, node->range, BVH_WIDTH, true, found, 0);
        memset(node->child, 0, sizeof node->child);
        assign_slots(level->tree, found, count, node->child);
        node->is_node = 0;
        for (int slot = 0; slot < BVH_WIDTH; slot++)
            if (node->child[slot].count && !is_leaf(level->tree, node->child[slot]))
                node->is_node |= (uint8_t)(1u << slot);
    }
}

static void write_nodes(void *context, size_t begin, size_t end) {
    struct level *level = context;
    const struct binary_tree *tree = level->tree;
    for (size_t i = begin; i < end; i++) {
        const struct pending *node = &level->nodes[i];
        struct wide_child slots[BVH_WIDTH] = {{.count = 0}};
        uint32_t next = node->first_node;
        uint32_t item = node->first_item;
        for (int slot = 0; slot < BVH_WIDTH; slot++) {
            struct binary_range child = node->child[slot];
            if (!child.count)
                continue;
            slots[slot] =
                (struct wide_child){binary_box(tree, child), child.count, node->is_node >> slot & 1};
            if (slots[slot].is_node)
                level->next[next++ - level->next_first].range = child;
            else
                for (uint32_t k = 0; k < child.count; k++)
                    level->out->order[item++] = tree->items[child.begin + k].index;
        }
        encode_node(slots, node->first_node, node->first_item,
                    level->out->nodes + (size_t)NODE_WORDS * (level->first + i));
    }
}

// Numbers the children of a level; returns the number of nodes of the next.
static uint32_t number_children(struct pending *nodes, uint32_t count, uint32_t next_first, uint32_t *items) {
    uint32_t next = next_first;
    for (uint32_t i = 0; i < count; i++) {
        nodes[i].first_node = next;
        nodes[i].first_item = *items;
        for (int slot = 0; slot < BVH_WIDTH; slot++) {
            if (nodes[i].is_node >> slot & 1)
                next++;
            else
                *items += nodes[i].child[slot].count;
        }
    }
    return next - next_first;
}

static bool reserve_nodes(struct bvh *out, uint64_t count) {
    struct gpu_word *moved = heap_resize(out->nodes, count * NODE_WORDS * sizeof *moved);
    if (!moved)
        return false;
    out->nodes = moved;
    return true;
}

bool wide_build(const struct binary_tree *tree, struct bvh *out) {
    struct level level = {.tree = tree, .out = out};
    uint32_t count = 1;
    uint32_t items = 0;
    level.nodes = heap_alloc(sizeof *level.nodes);
    if (!level.nodes)
        return false;
    level.nodes[0].range = (struct binary_range){0, 0, tree->count};
    while (count) {
        parallel_for(count, PIECE_NODES, open_nodes, &level);
        level.next_first = level.first + count;
        uint32_t next_count = number_children(level.nodes, count, level.next_first, &items);
        level.next = heap_alloc((next_count ? next_count : 1) * sizeof *level.next);
        if (!level.next || !reserve_nodes(out, level.next_first)) {
            free(level.next);
            free(level.nodes);
            return false;
        }
        parallel_for(count, PIECE_NODES, write_nodes, &level);
        free(level.nodes);
        level.nodes = level.next;
        level.first = level.next_first;
        count = next_count;
        out->depth++;
    }
    free(level.nodes);
    out->node_count = level.first;
    return true;
}
