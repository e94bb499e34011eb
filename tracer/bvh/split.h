// Where to cut a range of items in two. Private to tracer/bvh.
#ifndef GLINT_TRACER_BVH_SPLIT_H
#define GLINT_TRACER_BVH_SPLIT_H

#include "tracer/bvh/box.h"

enum {
    SPLIT_BINS = 16,
    SPLIT_SWEEP = 8, // ranges up to this size try every cut instead of bins
};

struct split_bins {
    struct bvh_box box[3][SPLIT_BINS];
    uint32_t count[3][SPLIT_BINS];
};

// Maps twice the centre of an item to its bin, along each axis.
struct split_grid {
    float origin[4], scale[4]; // scale 0: all middles coincide here
};

struct split_plane {
    int axis; // -1: no plane separates the items
    int bin;  // the first bin of the right side
};

// Bounds of the items' middles.
struct bvh_box split_middles(const struct bvh_item *items, size_t count);
struct split_grid split_grid_make(const struct bvh_box *middles);
static inline bool split_is_left(const struct split_grid *grid, struct split_plane plane,
                                 const struct bvh_item *item) {
    float at = (item_middle(item, plane.axis) - grid->origin[plane.axis]) * grid->scale[plane.axis];
    return at < (float)plane.bin;
}
void split_bins_clear(struct split_bins *bins);
void split_bins_add(struct split_bins *bins, const struct split_grid *grid, const struct bvh_item *items,
                    size_t count);
void split_bins_merge(struct split_bins *into, const struct split_bins *from);
// The plane with the least Σ area * items.
struct split_plane split_best(const struct split_bins *bins, const struct split_grid *grid);

// Cuts items[0, count) in place and returns the number of those on the left, 0 < result < count. count is at
// least 2. `middles` bounds the items' middles; the two sides' bounds go to `sides`, which is not written for
// a side of at most SPLIT_SWEEP items, as that needs none.
uint32_t split_items(struct bvh_item *items, uint32_t count, const struct bvh_box *middles,
                     struct bvh_box sides[2]);
// Halves by number along the axis where the middles spread most; by order if they do not spread.
uint32_t split_halves(struct bvh_item *items, uint32_t count);

#endif
