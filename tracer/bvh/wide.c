// From the binary tree to the wide one. Children are gathered depth first, as the binary nodes decided; a
// node is written after those below it, so boxes come from below and need not be kept.
//
// Ranges of few items are tasks of one thread each. The nodes above them are walked twice: to number the
// tasks, and to be written when these are done.
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
    TASK_ITEMS = 8192,  // ranges up to this are tasks
    TASKS_WANTED = 128, // ranges up to this fraction of all items, too
};

struct task {
    struct binary_range range;
    uint32_t number;                 // of its first node
    uint32_t level;                  // of that node
    uint32_t nodes;                  // below it
    uint32_t first_node, first_item; // of the nodes below it; of all its items
    struct bvh_box box;
    uint32_t depth;
};

struct widening {
    const struct binary_tree *tree;
    struct bvh *out;
    uint32_t task_items;
    struct task *tasks;
    uint32_t task_count, task_capacity;
    bool has_failed; // no memory
};

// Where the next nodes and items go.
struct writer {
    struct widening *wide;
    uint32_t next_node, next_item, depth;
    bool above_tasks; // stops at tasks
    bool plans;       // only numbers them
    uint32_t next_task;
};

// ---- children

struct children {
    uint32_t count, nodes, items; // of all children; those that are nodes; items of those that are leaves
    struct binary_range range[BVH_WIDTH];
    bool is_node[BVH_WIDTH];
};

// Adds the roots of a subtree that becomes at most `roots` roots, left to right.
static void gather(const struct binary_tree *tree, struct binary_range range, int roots,
                   struct children *found) {
    if (range.count > 1) {
        const struct binary_node *node = &tree->nodes[range.node];
        while (roots > 1 && !binary_choice(node, roots))
            roots--;
        if (roots > 1) {
            const int left = (int)binary_choice(node, roots);
            gather(tree, binary_left(tree, range), left, found);
            gather(tree, binary_right(tree, range), roots - left, found);
            return;
        }
    }
    const bool is_leaf = binary_is_leaf(tree, range);
    found->is_node[found->count] = !is_leaf;
    found->nodes += !is_leaf;
    found->items += is_leaf ? range.count : 0;
    found->range[found->count++] = range;
}

// The children of a wide node that covers `range`.
static void gather_children(const struct binary_tree *tree, struct binary_range range,
                            struct children *found) {
    found->count = found->nodes = found->items = 0;
    if (range.count == 1) {
        gather(tree, range, 1, found);
        return;
    }
    const int most = range.count < BVH_WIDTH ? (int)range.count : BVH_WIDTH;
    const int left = (int)binary_choice(&tree->nodes[range.node], BVH_WIDTH);
    gather(tree, binary_left(tree, range), left, found);
    gather(tree, binary_right(tree, range), most - left, found);
}

static struct bvh_box box_of_all(const struct bvh_box *boxes, uint32_t count) {
    struct bvh_box all = box_empty();
    for (uint32_t i = 0; i < count; i++)
        box_join(&all, &boxes[i]);
    return all;
}

static float gain_of(const float off[4], int slot) {
    return (slot & 4 ? off[0] : -off[0]) + (slot & 2 ? off[1] : -off[1]) + (slot & 1 ? off[2] : -off[2]);
}

// The free slot that suits a child best.
static int best_slot(const float off[4], uint32_t taken) {
    const int wanted = (off[0] > 0 ? 4 : 0) | (off[1] > 0 ? 2 : 0) | (off[2] > 0 ? 1 : 0);
    if (!(taken >> wanted & 1))
        return wanted;
    int best = 0;
    float gain = -INFINITY;
    for (int slot = 0; slot < BVH_WIDTH; slot++) {
        const float value = gain_of(off, slot);
        if (!(taken >> slot & 1) && value > gain) {
            gain = value;
            best = slot;
        }
    }
    return best;
}

// Sets children into slots so that slot order, turned by the ray's octant, is about front to back: the
// best-matching child and slot first (Ylitie et al. 2017, section 3.2, greedy instead of by auction).
static void assign_slots(const struct bvh_box *boxes, uint32_t count, int slot_of[BVH_WIDTH]) {
    const struct bvh_box all = box_of_all(boxes, count);
    float off[BVH_WIDTH][4];
    float gain[BVH_WIDTH];
    for (uint32_t i = 0; i < count; i++) {
        lanes_store(lanes_three(lanes_add(lanes_sub(lanes_three(boxes[i].lower), lanes_three(all.lower)),
                                          lanes_sub(lanes_three(boxes[i].upper), lanes_three(all.upper)))),
                    off[i]);
        slot_of[i] = best_slot(off[i], 0);
        gain[i] = gain_of(off[i], slot_of[i]);
    }
    uint32_t placed = 0;
    uint32_t taken = 0;
    for (uint32_t round = 0; round < count; round++) {
        uint32_t best = BVH_WIDTH;
        for (uint32_t i = 0; i < count; i++) {
            if (placed >> i & 1)
                continue;
            if (taken >> slot_of[i] & 1) {
                slot_of[i] = best_slot(off[i], taken);
                gain[i] = gain_of(off[i], slot_of[i]);
            }
            if (best == BVH_WIDTH || gain[i] > gain[best])
                best = i;
        }
        placed |= 1u << best;
        taken |= 1u << slot_of[best];
    }
}

// ---- writing

// Sorts the nodes of children, from `first` on, from the order in which they were gathered to the order of
// slots.
static void sort_nodes(struct gpu_word *first, const struct children *found, const int child_at[BVH_WIDTH]) {
    struct gpu_word copy[BVH_WIDTH * NODE_WORDS];
    uint32_t place[BVH_WIDTH];
    uint32_t count = 0;
    for (uint32_t i = 0; i < found->count; i++)
        place[i] = found->is_node[i] ? count++ : 0;
    memcpy(copy, first, (size_t)count * NODE_WORDS * sizeof *copy);
    for (int slot = 0; slot < BVH_WIDTH; slot++) {
        const int child = child_at[slot];
        if (child < 0 || !found->is_node[child])
            continue;
        memcpy(first, copy + (size_t)NODE_WORDS * place[child], NODE_WORDS * sizeof *first);
        first += NODE_WORDS;
    }
}

static void write_node(struct writer *w, uint32_t number, const struct children *found,
                       const struct bvh_box *boxes, uint32_t first_node, uint32_t first_item) {
    struct bvh *out = w->wide->out;
    const struct binary_tree *tree = w->wide->tree;
    int slot_of[BVH_WIDTH];
    int child_at[BVH_WIDTH] = {-1, -1, -1, -1, -1, -1, -1, -1};
    struct wide_child slots[BVH_WIDTH];
    assign_slots(boxes, found->count, slot_of);
    for (uint32_t i = 0; i < found->count; i++)
        child_at[slot_of[i]] = (int)i;
    uint32_t item = first_item;
    for (int slot = 0; slot < BVH_WIDTH; slot++) {
        const int child = child_at[slot];
        slots[slot].count = child < 0 ? 0 : found->range[child].count;
        slots[slot].is_node = child >= 0 && found->is_node[child];
        if (child < 0)
            continue;
        slots[slot].box = boxes[child];
        for (uint32_t k = 0; !slots[slot].is_node && k < slots[slot].count; k++)
            out->order[item++] = tree->items[found->range[child].begin + k].index;
    }
    if (found->nodes > 1)
        sort_nodes(out->nodes + (size_t)NODE_WORDS * first_node, found, child_at);
    encode_node(slots, first_node, first_item, out->nodes + (size_t)NODE_WORDS * number);
}

static struct bvh_box box_of_items(const struct bvh_item *items, uint32_t count) {
    struct bvh_box box = box_of_item(items);
    for (uint32_t i = 1; i < count; i++) {
        const struct bvh_box one = box_of_item(&items[i]);
        box_join(&box, &one);
    }
    return box;
}

static void add_task(struct widening *wide, struct task task) {
    struct task *tasks = heap_grow(wide->tasks, wide->task_count, &wide->task_capacity, sizeof *tasks);
    wide->has_failed |= !tasks;
    if (!tasks)
        return;
    wide->tasks = tasks;
    wide->tasks[wide->task_count++] = task;
}

// Writes the node `number` that covers `range`, after all below it; returns its box.
static struct bvh_box write_range(struct writer *w, struct binary_range range, uint32_t number,
                                  uint32_t level) {
    struct widening *wide = w->wide;
    struct bvh_box boxes[BVH_WIDTH];
    if (w->above_tasks && range.count <= wide->task_items) {
        if (!w->plans)
            return wide->tasks[w->next_task++].box;
        add_task(wide, (struct task){.range = range, .number = number, .level = level});
        return box_empty();
    }
    struct children found;
    gather_children(wide->tree, range, &found);
    const uint32_t first_node = w->next_node;
    const uint32_t first_item = w->next_item;
    w->next_node += found.nodes;
    w->next_item += found.items;
    w->depth = level > w->depth ? level : w->depth;
    uint32_t node = first_node;
    for (uint32_t i = 0; i < found.count; i++)
        boxes[i] = found.is_node[i]
                       ? write_range(w, found.range[i], node++, level + 1)
                       : box_of_items(wide->tree->items + found.range[i].begin, found.range[i].count);
    if (!w->plans)
        write_node(w, number, &found, boxes, first_node, first_item);
    return box_of_all(boxes, found.count);
}

// ---- tasks

static uint32_t nodes_below(const struct binary_tree *tree, struct binary_range range) {
    struct children found;
    gather_children(tree, range, &found);
    uint32_t nodes = found.nodes;
    for (uint32_t i = 0; i < found.count; i++)
        if (found.is_node[i])
            nodes += nodes_below(tree, found.range[i]);
    return nodes;
}

static void count_tasks(void *context, size_t begin, size_t end) {
    const struct widening *wide = context;
    for (size_t i = begin; i < end; i++)
        wide->tasks[i].nodes = nodes_below(wide->tree, wide->tasks[i].range);
}

static void write_tasks(void *context, size_t begin, size_t end) {
    struct widening *wide = context;
    for (size_t i = begin; i < end; i++) {
        struct task *task = &wide->tasks[i];
        struct writer w = {.wide = wide, .next_node = task->first_node, .next_item = task->first_item};
        task->box = write_range(&w, task->range, task->number, task->level);
        task->depth = w.depth;
    }
}

// Walks the nodes above the tasks.
static void walk_above(struct widening *wide, bool plans, struct writer *w) {
    *w = (struct writer){.wide = wide, .next_node = 1, .above_tasks = true, .plans = plans};
    write_range(w, (struct binary_range){0, 0, wide->tree->count}, 0, 1);
}

bool wide_build(const struct binary_tree *tree, struct bvh *out) {
    struct widening wide = {.tree = tree, .out = out};
    const uint32_t part = tree->count / TASKS_WANTED;
    wide.task_items = part > TASK_ITEMS ? part : TASK_ITEMS;
    struct writer w;
    walk_above(&wide, true, &w);
    if (!wide.has_failed)
        parallel_for(wide.task_count, 1, count_tasks, &wide);
    uint32_t nodes = w.next_node;
    uint32_t items = w.next_item;
    for (uint32_t i = 0; i < wide.task_count; i++) {
        wide.tasks[i].first_node = nodes;
        wide.tasks[i].first_item = items;
        nodes += wide.tasks[i].nodes;
        items += wide.tasks[i].range.count;
    }
    out->nodes = wide.has_failed ? NULL : heap_array(heap_times(nodes, NODE_WORDS), sizeof *out->nodes);
    if (out->nodes) {
        parallel_for(wide.task_count, 1, write_tasks, &wide);
        walk_above(&wide, false, &w);
        out->node_count = nodes;
        out->depth = w.depth;
        for (uint32_t i = 0; i < wide.task_count; i++)
            out->depth = wide.tasks[i].depth > out->depth ? wide.tasks[i].depth : out->depth;
    }
    free(wide.tasks);
    return out->nodes != NULL;
}
