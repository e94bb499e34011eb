// A tree over boxes: which of them overlap another one. Boxes that lie apart are found in the logarithm of
// their number, however they are arranged.
//
// Input: boxes, which are put into another order; what they are of are items of one array, whose order
// decides between equal places, so that every run makes the same tree. Ownership: the arena's, which must be
// guarded; the items stay the caller's and must outlive the tree. Thread safety: immutable once built.
#ifndef GLINT_LINT_BOX_TREE_H
#define GLINT_LINT_BOX_TREE_H

#include "core/arena.h"
#include "lint/shape.h"

struct lint_box_item {
    struct lint_box box;
    const void *of;
};

struct lint_box_node {
    struct lint_box box;
    uint32_t first, end; // items
    uint32_t second;     // of its two nodes; the first one follows it; 0: a leaf
};

struct lint_box_tree {
    struct lint_box_item *items; // in the tree's order
    struct lint_box_node *nodes;
    uint32_t node_count; // 0: no items
};

void lint_box_tree_build(struct lint_box_tree *tree, struct arena *arena, struct lint_box_item *items,
                         uint32_t count);

// Called with what each box is of that overlaps `box`, from item `from` of the tree's order on; false ends
// the walk. Returns how many nodes were looked at, which is what the walk cost.
typedef bool lint_box_tree_visit(void *context, const void *of);
uint64_t lint_box_tree_in_box(const struct lint_box_tree *tree, const struct lint_box *box, uint32_t from,
                              lint_box_tree_visit *visit, void *context);

#endif
