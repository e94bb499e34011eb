#include "lint/body_pairs.h"

#include <stdlib.h>

enum {
    LEAF_MAX = 4,
    PAIRS_LEAST = 1 << 16,
    PAIRS_PER_BODY = 64,
};

struct node {
    struct lint_box box;
    uint32_t first, end; // items
    uint32_t second;     // of its two nodes; the first one follows it; 0: a leaf
};

struct pairs {
    struct lint_box_item *items;
    struct node *nodes;
    uint32_t node_count;
    uint64_t left;
    bool stopped;
    lint_take_pair *take;
    void *context;
};

// ---- the tree

static double middle(const struct lint_box_item *item, int axis) {
    vec3 sum = vec3_add(item->box.lower, item->box.upper);
    return axis == 0 ? sum.x : axis == 1 ? sum.y : sum.z;
}

// Of equal places the order of the scene decides, so that every run finds the same pairs.
static int compare(const struct lint_box_item *a, const struct lint_box_item *b, int axis) {
    double x = middle(a, axis), y = middle(b, axis);
    if (x != y)
        return x < y ? -1 : 1;
    return a->body < b->body ? -1 : a->body > b->body;
}

static int compare_x(const void *a, const void *b) {
    return compare(a, b, 0);
}
static int compare_y(const void *a, const void *b) {
    return compare(a, b, 1);
}
static int compare_z(const void *a, const void *b) {
    return compare(a, b, 2);
}

static int widest_axis(const struct pairs *p, uint32_t first, uint32_t end) {
    double widest = -1;
    int best = 0;
    for (int axis = 0; axis < 3; axis++) {
        double least = middle(&p->items[first], axis), most = least;
        for (uint32_t i = first; i < end; i++) {
            double at = middle(&p->items[i], axis);
            least = at < least ? at : least;
            most = at > most ? at : most;
        }
        if (most - least > widest) {
            widest = most - least;
            best = axis;
        }
    }
    return best;
}

static void build(struct pairs *p, uint32_t first, uint32_t end) {
    static int (*const compares[])(const void *, const void *) = {compare_x, compare_y, compare_z};
    struct node *node = &p->nodes[p->node_count++];
    *node = (struct node){.box = lint_box_empty(), .first = first, .end = end};
    for (uint32_t i = first; i < end; i++)
        node->box = lint_box_join(node->box, p->items[i].box);
    if (end - first <= LEAF_MAX)
        return;
    qsort(p->items + first, end - first, sizeof *p->items, compares[widest_axis(p, first, end)]);
    uint32_t half = first + (end - first) / 2;
    build(p, first, half);
    node->second = p->node_count;
    build(p, half, end);
}

// ---- the pairs

static void meet(struct pairs *p, uint32_t item, uint32_t from, uint32_t end) {
    for (uint32_t i = from > item ? from : item + 1; i < end && !p->stopped; i++)
        if (lint_boxes_overlap(&p->items[item].box, &p->items[i].box)) {
            p->stopped = p->left-- == 0 || !p->take(p->context, p->items[item].body, p->items[i].body);
        }
}

// Items after this one in the tree's order.
static void search(struct pairs *p, uint32_t item, uint32_t at) {
    const struct node *node = &p->nodes[at];
    if (p->stopped || node->end <= item + 1 || !lint_boxes_overlap(&p->items[item].box, &node->box))
        return;
    if (node->second == 0) {
        meet(p, item, node->first, node->end);
        return;
    }
    search(p, item, at + 1);
    search(p, item, node->second);
}

void lint_body_pairs(struct arena *arena, struct lint_box_item *items, uint32_t count, lint_take_pair *take,
                     void *context) {
    struct pairs p = {.items = items, .take = take, .context = context};
    if (count < 2)
        return;
    p.nodes = ARENA_ARRAY(arena, struct node, 2 * (size_t)count);
    p.left = PAIRS_LEAST + (uint64_t)PAIRS_PER_BODY * count;
    build(&p, 0, count);
    for (uint32_t i = 0; i < count; i++)
        search(&p, i, 0);
}
