#include "assets/made/order.h"

#include "core/splitmix.h"

void order_init(struct order *order, struct arena *arena, uint32_t count) {
    *order = (struct order){ARENA_ARRAY(arena, struct order_node, count), ORDER_NONE, ORDER_NONE};
}

static bool is_above(uint32_t a, uint32_t b) {
    return splitmix(a) < splitmix(b);
}

// The link to an item: in its parent, or the root.
static uint32_t *link_to(struct order *order, uint32_t item) {
    const uint32_t parent = order->nodes[item].parent;
    if (parent == ORDER_NONE)
        return &order->root;
    return &order->nodes[parent].child[order->nodes[parent].child[1] == item];
}

// Moves an item up, into the place of its parent.
static void rotate(struct order *order, uint32_t item) {
    struct order_node *nodes = order->nodes;
    const uint32_t parent = nodes[item].parent;
    const int side = nodes[parent].child[1] == item;
    const uint32_t inner = nodes[item].child[!side];
    *link_to(order, parent) = item;
    nodes[item].parent = nodes[parent].parent;
    nodes[item].child[!side] = parent;
    nodes[parent].parent = item;
    nodes[parent].child[side] = inner;
    if (inner != ORDER_NONE)
        nodes[inner].parent = parent;
}

static void set_beside(struct order *order, uint32_t before, uint32_t after) {
    if (before != ORDER_NONE)
        order->nodes[before].beside[1] = after;
    else
        order->first = after;
    if (after != ORDER_NONE)
        order->nodes[after].beside[0] = before;
}

void order_insert(struct order *order, uint32_t item, uint32_t after) {
    struct order_node *nodes = order->nodes;
    const uint32_t next = after == ORDER_NONE ? order->first : nodes[after].beside[1];
    nodes[item] = (struct order_node){ORDER_NONE, {ORDER_NONE, ORDER_NONE}, {after, next}};
    set_beside(order, after, item);
    set_beside(order, item, next);
    // Of two neighbours, one has no child on the side of the other.
    if (after != ORDER_NONE && nodes[after].child[1] == ORDER_NONE) {
        nodes[after].child[1] = item;
        nodes[item].parent = after;
    } else if (next != ORDER_NONE) {
        nodes[next].child[0] = item;
        nodes[item].parent = next;
    } else {
        order->root = item;
    }
    while (nodes[item].parent != ORDER_NONE && is_above(item, nodes[item].parent))
        rotate(order, item);
}

void order_remove(struct order *order, uint32_t item) {
    struct order_node *nodes = order->nodes;
    const uint32_t *child = nodes[item].child;
    while (child[0] != ORDER_NONE || child[1] != ORDER_NONE) {
        const bool second =
            child[0] == ORDER_NONE || (child[1] != ORDER_NONE && is_above(child[1], child[0]));
        rotate(order, child[second]);
    }
    *link_to(order, item) = ORDER_NONE;
    set_beside(order, nodes[item].beside[0], nodes[item].beside[1]);
}
