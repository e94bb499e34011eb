#include "lint/body_pairs.h"

enum {
    PAIRS_LEAST = 1 << 16,
    PAIRS_PER_BODY = 64,
};

struct pairs {
    const struct lint_body *body; // the body whose partners the search finds
    uint64_t left;
    bool stopped;
    lint_take_pair *take;
    void *context;
};

static bool meet(void *context, const void *other) {
    struct pairs *p = context;
    p->stopped = p->left-- == 0 || !p->take(p->context, p->body, other);
    return !p->stopped;
}

void lint_body_pairs(struct arena *arena, struct lint_box_item *items, uint32_t count, lint_take_pair *take,
                     void *context) {
    struct pairs p = {.take = take, .context = context};
    struct lint_box_tree tree;
    if (count < 2)
        return;
    p.left = PAIRS_LEAST + (uint64_t)PAIRS_PER_BODY * count;
    lint_box_tree_build(&tree, arena, items, count);
    for (uint32_t i = 0; i < count && !p.stopped; i++) {
        p.body = items[i].of;
        // Only boxes after this one in the tree's order: each pair is met once.
        lint_box_tree_in_box(&tree, &items[i].box, i + 1, meet, &p);
    }
}
