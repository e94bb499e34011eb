#include "lint/box_tree.h"

#include "core/heap.h"

#include <stdlib.h>

enum {
    LEAF_MAX = 4,
};

// ---- building

static double middle(const struct lint_box_item *item, int axis) {
    return vec3_along(vec3_add(item->box.lower, item->box.upper), axis);
}

// Ties are broken by the order in the scene, so that every run finds the same pairs.
static int compare(const struct lint_box_item *a, const struct lint_box_item *b, int axis) {
    double x = middle(a, axis), y = middle(b, axis);
    if (x != y)
        return x < y ? -1 : 1;
    return a->of < b->of ? -1 : a->of > b->of;
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

static int widest_axis(const struct lint_box_tree *tree, uint32_t first, uint32_t end) {
    double widest = -1;
    int best = 0;
    for (int axis = 0; axis < 3; axis++) {
        double least = middle(&tree->items[first], axis), most = least;
        for (uint32_t i = first; i < end; i++) {
            double at = middle(&tree->items[i], axis);
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

static void build(struct lint_box_tree *tree, uint32_t first, uint32_t end) {
    static int (*const compares[])(const void *, const void *) = {compare_x, compare_y, compare_z};
    struct lint_box_node *node = &tree->nodes[tree->node_count++];
    *node = (struct lint_box_node){.box = lint_box_empty(), .first = first, .end = end};
    for (uint32_t i = first; i < end; i++)
        node->box = lint_box_join(node->box, tree->items[i].box);
    if (end - first <= LEAF_MAX)
        return;
    qsort(tree->items + first, end - first, sizeof *tree->items, compares[widest_axis(tree, first, end)]);
    uint32_t half = first + (end - first) / 2;
    build(tree, first, half);
    node->second = tree->node_count;
    build(tree, half, end);
}

void lint_box_tree_build(struct lint_box_tree *tree, struct arena *arena, struct lint_box_item *items,
                         uint32_t count) {
    *tree = (struct lint_box_tree){.items = items};
    if (count == 0)
        return;
    tree->nodes = ARENA_ARRAY(arena, struct lint_box_node, heap_times(2, count));
    build(tree, 0, count);
}

// ---- walking

struct walk {
    const struct lint_box_tree *tree;
    const struct lint_box *box;
    uint32_t from;
    lint_box_tree_visit *visit;
    void *context;
    uint64_t looked; // nodes
    bool stopped;
};

static void walk_leaf(struct walk *w, const struct lint_box_node *node) {
    const struct lint_box_item *items = w->tree->items;
    for (uint32_t i = node->first > w->from ? node->first : w->from; i < node->end && !w->stopped; i++)
        if (lint_boxes_overlap(w->box, &items[i].box))
            w->stopped = !w->visit(w->context, items[i].of);
}

static void walk(struct walk *w, uint32_t at) {
    const struct lint_box_node *node = &w->tree->nodes[at];
    if (w->stopped)
        return;
    w->looked++;
    if (node->end <= w->from || !lint_boxes_overlap(w->box, &node->box))
        return;
    if (node->second == 0) {
        walk_leaf(w, node);
        return;
    }
    walk(w, at + 1);
    walk(w, node->second);
}

uint64_t lint_box_tree_in_box(const struct lint_box_tree *tree, const struct lint_box *box, uint32_t from,
                              lint_box_tree_visit *visit, void *context) {
    struct walk w = {.tree = tree, .box = box, .from = from, .visit = visit, .context = context};
    if (tree->node_count)
        walk(&w, 0);
    return w.looked;
}
