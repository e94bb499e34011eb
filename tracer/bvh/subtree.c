#include "tracer/bvh/subtree.h"

void subtree_of_item(const struct bvh_item *item, struct subtree *out) {
    out->box = box_of_item(item);
    out->count = 1;
    out->cost[0] = box_area(&out->box) * BVH_COST_ITEM;
}

// The number of costs that a subtree with this many items has.
static int costs_of(uint32_t count) {
    return count < BVH_WIDTH - 1 ? (int)count : BVH_WIDTH - 1;
}

struct distribution {
    double cost;
    uint32_t left; // roots of the left child
};

// The cheapest way to split `roots` roots between two children (eq. 4).
static struct distribution distribute(int roots, const double *left, int lefts, const double *right,
                                      int rights) {
    int k = roots > rights ? roots - rights : 1;
    struct distribution best = {left[k - 1] + right[roots - k - 1], (uint32_t)k};
    for (k++; k < roots && k <= lefts; k++) {
        double cost = left[k - 1] + right[roots - k - 1];
        if (cost < best.cost)
            best = (struct distribution){cost, (uint32_t)k};
    }
    return best;
}

void subtree_join(struct binary_node *node, uint32_t leaf_items, const struct subtree *left,
                  const struct subtree *right, struct subtree *out) {
    const int lefts = costs_of(left->count);
    const int rights = costs_of(right->count);
    const int most = lefts + rights < BVH_WIDTH ? lefts + rights : BVH_WIDTH;
    out->box = left->box;
    box_join(&out->box, &right->box);
    out->count = left->count + right->count;
    const double area = box_area(&out->box);
    const struct distribution opened = distribute(most, left->cost, lefts, right->cost, rights);
    const double as_leaf = area * out->count * BVH_COST_ITEM;
    const double as_node = opened.cost + area * BVH_COST_NODE;
    const bool is_leaf = out->count <= leaf_items && as_leaf <= as_node;
    uint32_t choices = is_leaf | opened.left << CHOICE_BITS * (BVH_WIDTH - 1);
    out->cost[0] = is_leaf ? as_leaf : as_node;
    for (int roots = 2; roots <= most && roots < BVH_WIDTH; roots++) {
        const struct distribution parted =
            roots == most ? opened : distribute(roots, left->cost, lefts, right->cost, rights);
        const bool pays = parted.cost < out->cost[roots - 2];
        out->cost[roots - 1] = pays ? parted.cost : out->cost[roots - 2];
        choices |= pays ? parted.left << CHOICE_BITS * (roots - 1) : 0;
    }
    node->choices = choices;
}
