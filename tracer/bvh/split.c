#include "tracer/bvh/split.h"

#include <float.h>
#include <math.h>
#include <string.h>

struct bvh_box split_middles(const struct bvh_item *items, size_t count) {
    struct bvh_box bounds = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
    for (size_t i = 0; i < count; i++) {
        float middle[3] = {item_middle(&items[i], 0), item_middle(&items[i], 1), item_middle(&items[i], 2)};
        box_grow(&bounds, middle, middle);
    }
    return bounds;
}

struct split_grid split_grid_make(const struct bvh_box *middles) {
    struct split_grid grid;
    for (int axis = 0; axis < 3; axis++) {
        float spread = middles->upper[axis] - middles->lower[axis];
        float scale = (float)SPLIT_BINS / spread;
        grid.origin[axis] = middles->lower[axis];
        // A spread among the smallest numbers has no finite scale; it is as good as none.
        grid.scale[axis] = spread > 0 && scale <= FLT_MAX ? scale : 0;
    }
    return grid;
}

void split_bins_clear(struct split_bins *bins) {
    for (int axis = 0; axis < 3; axis++)
        for (int bin = 0; bin < SPLIT_BINS; bin++)
            bins->box[axis][bin] = box_empty();
    memset(bins->count, 0, sizeof bins->count);
}

void split_bins_add(struct split_bins *bins, const struct split_grid *grid, const struct bvh_item *items,
                    size_t count) {
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++) {
            int bin = split_bin(grid, &items[i], axis);
            box_grow(&bins->box[axis][bin], items[i].lower, items[i].upper);
            bins->count[axis][bin]++;
        }
}

void split_bins_merge(struct split_bins *into, const struct split_bins *from) {
    for (int axis = 0; axis < 3; axis++)
        for (int bin = 0; bin < SPLIT_BINS; bin++) {
            if (!from->count[axis][bin])
                continue;
            box_grow(&into->box[axis][bin], from->box[axis][bin].lower, from->box[axis][bin].upper);
            into->count[axis][bin] += from->count[axis][bin];
        }
}

struct split_plane split_best(const struct split_bins *bins, const struct split_grid *grid) {
    struct split_plane best = {-1, 0};
    double best_cost = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        if (grid->scale[axis] == 0)
            continue;
        double right_cost[SPLIT_BINS];
        struct bvh_box box = box_empty();
        uint32_t count = 0;
        for (int bin = SPLIT_BINS - 1; bin > 0; bin--) {
            if (bins->count[axis][bin])
                box_grow(&box, bins->box[axis][bin].lower, bins->box[axis][bin].upper);
            count += bins->count[axis][bin];
            right_cost[bin] = count ? box_area(&box) * count : INFINITY;
        }
        box = box_empty();
        count = 0;
        for (int bin = 1; bin < SPLIT_BINS; bin++) {
            if (bins->count[axis][bin - 1])
                box_grow(&box, bins->box[axis][bin - 1].lower, bins->box[axis][bin - 1].upper);
            count += bins->count[axis][bin - 1];
            double cost = count ? box_area(&box) * count + right_cost[bin] : INFINITY;
            if (cost < best_cost) {
                best_cost = cost;
                best = (struct split_plane){axis, bin};
            }
        }
    }
    return best;
}

static uint32_t part_by_plane(struct bvh_item *items, uint32_t count, const struct split_grid *grid,
                              struct split_plane plane) {
    uint32_t left = 0;
    uint32_t right = count;
    for (;;) {
        while (left < right && split_bin(grid, &items[left], plane.axis) < plane.bin)
            left++;
        while (left < right && split_bin(grid, &items[right - 1], plane.axis) >= plane.bin)
            right--;
        if (left >= right)
            return left;
        struct bvh_item item = items[left];
        items[left++] = items[--right];
        items[right] = item;
    }
}

static uint32_t split_by_bins(struct bvh_item *items, uint32_t count) {
    struct bvh_box middles = split_middles(items, count);
    struct split_grid grid = split_grid_make(&middles);
    struct split_bins bins;
    split_bins_clear(&bins);
    split_bins_add(&bins, &grid, items, count);
    struct split_plane plane = split_best(&bins, &grid);
    return plane.axis < 0 ? count / 2 : part_by_plane(items, count, &grid, plane);
}

// Insertion sort of up to SPLIT_SWEEP items by their middles; equal ones keep their order.
static void sort_few(const struct bvh_item *items, uint32_t count, int axis, uint8_t order[SPLIT_SWEEP]) {
    for (uint32_t i = 0; i < count; i++) {
        float middle = item_middle(&items[i], axis);
        uint32_t at = i;
        for (; at > 0 && item_middle(&items[order[at - 1]], axis) > middle; at--)
            order[at] = order[at - 1];
        order[at] = (uint8_t)i;
    }
}

static uint32_t split_by_sweep(struct bvh_item *items, uint32_t count) {
    uint8_t best_order[SPLIT_SWEEP] = {0};
    uint32_t best_left = 0;
    double best_cost = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        uint8_t order[SPLIT_SWEEP] = {0};
        double right_cost[SPLIT_SWEEP];
        sort_few(items, count, axis, order);
        struct bvh_box box = box_empty();
        for (uint32_t i = count - 1; i > 0; i--) {
            box_grow(&box, items[order[i]].lower, items[order[i]].upper);
            right_cost[i] = box_area(&box) * (count - i);
        }
        box = box_empty();
        for (uint32_t i = 1; i < count; i++) {
            box_grow(&box, items[order[i - 1]].lower, items[order[i - 1]].upper);
            double cost = box_area(&box) * i + right_cost[i];
            if (cost < best_cost) {
                best_cost = cost;
                best_left = i;
                memcpy(best_order, order, sizeof order);
            }
        }
    }
    struct bvh_item copy[SPLIT_SWEEP];
    memcpy(copy, items, count * sizeof *items);
    for (uint32_t i = 0; i < count; i++)
        items[i] = copy[best_order[i]];
    return best_left;
}

uint32_t split_items(struct bvh_item *items, uint32_t count) {
    return count <= SPLIT_SWEEP ? split_by_sweep(items, count) : split_by_bins(items, count);
}

// The bits of a float, ordered as the floats are.
static uint32_t middle_key(const struct bvh_item *item, int axis) {
    float middle = item_middle(item, axis) + 0.0f; // no negative zero
    uint32_t bits;
    memcpy(&bits, &middle, sizeof bits);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

// The key at place `rank` of the sorted keys, found byte by byte.
static uint32_t key_at_rank(const struct bvh_item *items, uint32_t count, int axis, uint32_t rank) {
    uint32_t key = 0;
    uint32_t mask = 0;
    for (int shift = 24; shift >= 0; shift -= 8) {
        uint32_t histogram[256] = {0};
        for (uint32_t i = 0; i < count; i++) {
            uint32_t k = middle_key(&items[i], axis);
            if ((k & mask) == key)
                histogram[k >> shift & 255]++;
        }
        uint32_t byte = 0;
        while (rank >= histogram[byte])
            rank -= histogram[byte++];
        key |= byte << shift;
        mask |= 255u << shift;
    }
    return key;
}

uint32_t split_halves(struct bvh_item *items, uint32_t count) {
    struct bvh_box middles = split_middles(items, count);
    int axis = 0;
    for (int i = 1; i < 3; i++)
        if (middles.upper[i] - middles.lower[i] > middles.upper[axis] - middles.lower[axis])
            axis = i;
    uint32_t half = count / 2;
    uint32_t key = key_at_rank(items, count, axis, half);
    uint32_t less = 0;
    uint32_t greater = count;
    for (uint32_t i = 0; i < greater;) {
        uint32_t k = middle_key(&items[i], axis);
        if (k == key) {
            i++;
            continue;
        }
        uint32_t to = k < key ? less++ : --greater;
        struct bvh_item item = items[i];
        items[i] = items[to];
        items[to] = item;
        if (k < key)
            i++;
    }
    return half;
}
