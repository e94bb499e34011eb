// A tree over boxes: finds the boxes that overlap a given one. With boxes that lie apart a search takes time
// logarithmic in their number, however they are arranged.
//
// Input: boxes, which are reordered, and the items of one array that they belong to; the array's order breaks
// ties, so that every run makes the same tree. Ownership: the arena's, which must be guarded; the items stay
// the caller's and must outlive the tree. Thread safety: immutable once built.
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
    uint32_t second;     // the second child; the first one follows the node; 0: a leaf
};

struct lint_box_tree {
    struct lint_box_item *items; // in the tree's order
    struct lint_box_node *nodes;
    uint32_t node_count; // 0: no items
};

void lint_box_tree_build(struct lint_box_tree *tree, struct arena *arena, struct lint_box_item *items,
                         uint32_t count);

// Called for each box that overlaps `box`, with the item that it belongs to, from item `from` of the tree's
// order on; false ends the walk. Returns how many nodes were looked at: the cost of the walk.
typedef bool lint_box_tree_visit(void *context, const void *of);
uint64_t lint_box_tree_in_box(const struct lint_box_tree *tree, const struct lint_box *box, uint32_t from,
                              lint_box_tree_visit *visit, void *context);

#endif
