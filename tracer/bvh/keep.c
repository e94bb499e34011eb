#include "tracer/bvh/keep.h"

#include "core/hash128.h"
#include "core/heap.h"
#include "shaders/records.h"

#include <stdlib.h>
#include <string.h>

struct kept_tree {
    struct kept_tree *next;
    uint64_t key[2]; // of items and method
    bool is_used;    // since the last sweep
    struct bvh bvh;
};

struct bvh_keep {
    struct kept_tree *trees;
    uint32_t built, found;
};

struct bvh_keep *bvh_keep_create(void) {
    return heap_zeroed(1, sizeof(struct bvh_keep));
}

static void free_tree(struct kept_tree *tree) {
    bvh_finish(&tree->bvh);
    free(tree);
}

void bvh_keep_destroy(struct bvh_keep *keep) {
    if (!keep)
        return;
    for (struct kept_tree *tree = keep->trees, *next; tree; tree = next) {
        next = tree->next;
        free_tree(tree);
    }
    free(keep);
}

// Items have no padding, and makers of items set all of them.
static void key_of(const struct bvh_item *items, uint32_t count, enum bvh_method method, uint64_t key[2]) {
    struct hash128 hash;
    hash128_begin(&hash);
    hash128_whole(&hash, (uint64_t)method);
    hash128_array(&hash, items, count, sizeof *items);
    hash128_end(&hash, key);
}

static bool copy(const struct bvh *from, struct bvh *to) {
    const size_t node_bytes = heap_times(heap_times(from->node_count, NODE_WORDS), sizeof *from->nodes);
    const size_t order_bytes = heap_times(from->item_count, sizeof *from->order);
    *to = *from;
    to->nodes = heap_alloc(node_bytes);
    to->order = heap_alloc(order_bytes);
    if (!to->nodes || !to->order) {
        bvh_finish(to);
        return false;
    }
    memcpy(to->nodes, from->nodes, node_bytes);
    memcpy(to->order, from->order, order_bytes);
    return true;
}

static void add(struct bvh_keep *keep, const uint64_t key[2], const struct bvh *bvh) {
    struct kept_tree *tree = heap_zeroed(1, sizeof *tree);
    if (!tree || !copy(bvh, &tree->bvh)) {
        free(tree);
        return;
    }
    memcpy(tree->key, key, sizeof tree->key);
    tree->is_used = true;
    tree->next = keep->trees;
    keep->trees = tree;
}

static struct kept_tree *find(const struct bvh_keep *keep, const uint64_t key[2], uint32_t count) {
    for (struct kept_tree *tree = keep->trees; tree; tree = tree->next)
        if (tree->key[0] == key[0] && tree->key[1] == key[1] && tree->bvh.item_count == count)
            return tree;
    return NULL;
}

bool bvh_build_kept(struct bvh_keep *keep, struct bvh_item *items, uint32_t count, enum bvh_method method,
                    struct bvh *out) {
    uint64_t key[2];
    if (!keep || count == 0)
        return bvh_build(items, count, method, out);
    key_of(items, count, method, key);
    struct kept_tree *known = find(keep, key, count);
    if (known) {
        known->is_used = true;
        keep->found++;
        return copy(&known->bvh, out);
    }
    if (!bvh_build(items, count, method, out))
        return false;
    keep->built++;
    add(keep, key, out);
    return true;
}

void bvh_keep_all(struct bvh_keep *keep) {
    for (struct kept_tree *tree = keep ? keep->trees : NULL; tree; tree = tree->next) {
        tree->is_used = true;
        keep->found++;
    }
}

void bvh_keep_sweep(struct bvh_keep *keep) {
    struct kept_tree **at = &keep->trees;
    while (*at) {
        struct kept_tree *tree = *at;
        if (tree->is_used) {
            tree->is_used = false;
            at = &tree->next;
            continue;
        }
        *at = tree->next;
        free_tree(tree);
    }
}

uint32_t bvh_keep_built(const struct bvh_keep *keep) {
    return keep->built;
}

uint32_t bvh_keep_found(const struct bvh_keep *keep) {
    return keep->found;
}
