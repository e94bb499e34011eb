// An ordered list in a tree, for sweeps: items are numbers from 0, placed by their neighbours.
//
// A treap (Seidel and Aragon 1996, "Randomized search trees"), whose priorities follow from the numbers. The
// depth is some 2 log n. Ownership: the arena's. Thread safety: one order belongs to one thread.
#ifndef GLINT_ASSETS_MADE_ORDER_H
#define GLINT_ASSETS_MADE_ORDER_H

#include "core/arena.h"

#define ORDER_NONE UINT32_MAX

struct order_node {
    uint32_t parent, child[2]; // child[0] is before it
    uint32_t beside[2];        // the item before it and the one after it
};

struct order {
    struct order_node *nodes;
    uint32_t root, first;
};

void order_init(struct order *order, struct arena *arena, uint32_t count);
// Puts an item after another one, or before all (ORDER_NONE).
void order_insert(struct order *order, uint32_t item, uint32_t after);
void order_remove(struct order *order, uint32_t item);

#endif
