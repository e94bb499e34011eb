#include "tracer/bvh/split.h"

#include "core/float_bits.h"

#include <math.h>
#include <string.h>

struct bvh_box split_middles(const struct bvh_item *items, size_t count) {
    struct bvh_box bounds = box_empty();
    for (size_t i = 0; i < count; i++)
        box_add_point(&bounds, item_middles(&items[i]));
    return bounds;
}

struct split_grid split_grid_make(const struct bvh_box *middles) {
    struct split_grid grid = {{0}, {0}};
    float lower[4], upper[4];
    lanes_store(middles->lower, lower);
    lanes_store(middles->upper, upper);
    for (int axis = 0; axis < 3; axis++) {
        float spread = upper[axis] - lower[axis];
        float scale = (float)SPLIT_BINS / spread;
        grid.origin[axis] = lower[axis];
        // A spread of the smallest numbers has no finite scale; it counts as none.
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
    const lanes origin = lanes_load(grid->origin);
    const lanes scale = lanes_load(grid->scale);
    const lanes last = lanes_all((float)(SPLIT_BINS - 1));
    for (size_t i = 0; i < count; i++) {
        const struct bvh_box box = box_of_item(&items[i]);
        int32_t bin[4];
        lanes at = lanes_mul(lanes_sub(item_middles(&items[i]), origin), scale);
        lanes_whole(lanes_min(at, last), bin);
        for (int axis = 0; axis < 3; axis++) {
            box_join(&bins->box[axis][bin[axis]], &box);
            bins->count[axis][bin[axis]]++;
        }
    }
}

void split_bins_merge(struct split_bins *into, const struct split_bins *from) {
    for (int axis = 0; axis < 3; axis++)
        for (int bin = 0; bin < SPLIT_BINS; bin++) {
            box_join(&into->box[axis][bin], &from->box[axis][bin]);
            into->count[axis][bin] += from->count[axis][bin];
        }
}

// The least cost along one axis, for every bin at which the right side may begin.
static double best_along(const struct bvh_box box[SPLIT_BINS], const uint32_t count[SPLIT_BINS], int *best) {
    double right_cost[SPLIT_BINS];
    struct bvh_box side = box_empty();
    uint32_t items = 0;
    double cost = INFINITY;
    for (int bin = SPLIT_BINS - 1; bin > 0; bin--) {
        if (count[bin]) {
            box_join(&side, &box[bin]);
            items += count[bin];
            cost = box_area(&side) * items;
        }
        right_cost[bin] = cost;
    }
    side = box_empty();
    items = 0;
    double least = INFINITY;
    // An empty bin moves nothing to the left: the cut after it equals the one before it.
    for (int bin = 1; bin < SPLIT_BINS; bin++) {
        if (!count[bin - 1])
            continue;
        box_join(&side, &box[bin - 1]);
        items += count[bin - 1];
        cost = box_area(&side) * items + right_cost[bin];
        if (cost < least) {
            least = cost;
            *best = bin;
        }
    }
    return least;
}

struct split_plane split_best(const struct split_bins *bins, const struct split_grid *grid) {
    struct split_plane best = {-1, 0};
    double best_cost = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        if (grid->scale[axis] == 0)
            continue;
        int bin = 0;
        double cost = best_along(bins->box[axis], bins->count[axis], &bin);
        if (cost < best_cost) {
            best_cost = cost;
            best = (struct split_plane){axis, bin};
        }
    }
    return best;
}

static uint32_t part_by_plane(struct bvh_item *items, uint32_t count, const struct split_grid *grid,
                              struct split_plane plane, struct bvh_box sides[2]) {
    struct bvh_box lefts = box_empty();
    struct bvh_box rights = box_empty();
    uint32_t left = 0;
    uint32_t right = count;
    for (;;) {
        for (; left < right && split_is_left(grid, plane, &items[left]); left++)
            box_add_point(&lefts, item_middles(&items[left]));
        for (; left < right && !split_is_left(grid, plane, &items[right - 1]); right--)
            box_add_point(&rights, item_middles(&items[right - 1]));
        if (left >= right)
            break;
        struct bvh_item item = items[left];
        items[left] = items[right - 1];
        items[right - 1] = item;
    }
    sides[0] = lefts;
    sides[1] = rights;
    return left;
}

static uint32_t split_by_bins(struct bvh_item *items, uint32_t count, const struct bvh_box *middles,
                              struct bvh_box sides[2]) {
    struct split_grid grid = split_grid_make(middles);
    struct split_bins bins;
    split_bins_clear(&bins);
    split_bins_add(&bins, &grid, items, count);
    struct split_plane plane = split_best(&bins, &grid);
    if (plane.axis >= 0)
        return part_by_plane(items, count, &grid, plane, sides);
    sides[0] = sides[1] = *middles;
    return count / 2;
}

// Insertion sort of up to SPLIT_SWEEP items by their middles; equal ones keep their order.
static void sort_few(const struct bvh_item *items, uint32_t count, int axis, uint8_t order[SPLIT_SWEEP]) {
    float sorted[SPLIT_SWEEP];
    for (uint32_t i = 0; i < count; i++) {
        float middle = item_middle(&items[i], axis);
        uint32_t at = i;
        for (; at > 0 && sorted[at - 1] > middle; at--) {
            sorted[at] = sorted[at - 1];
            order[at] = order[at - 1];
        }
        sorted[at] = middle;
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
        struct bvh_box box = box_of_item(&items[order[count - 1]]);
        for (uint32_t i = count - 1;; i--) {
            right_cost[i] = box_area(&box) * (count - i);
            if (i == 1)
                break;
            const struct bvh_box one = box_of_item(&items[order[i - 1]]);
            box_join(&box, &one);
        }
        box = box_empty();
        for (uint32_t i = 1; i < count; i++) {
            const struct bvh_box one = box_of_item(&items[order[i - 1]]);
            box_join(&box, &one);
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

// The item whose removal leaves the cheapest pair goes first.
static void split_three(struct bvh_item items[3]) {
    uint32_t best = 0;
    double best_cost = INFINITY;
    for (uint32_t i = 0; i < 3; i++) {
        const struct bvh_box one = box_of_item(&items[i]);
        const struct bvh_box other = box_of_item(&items[(i + 2) % 3]);
        struct bvh_box pair = box_of_item(&items[(i + 1) % 3]);
        box_join(&pair, &other);
        double cost = box_area(&one) + 2 * box_area(&pair);
        if (cost < best_cost) {
            best_cost = cost;
            best = i;
        }
    }
    struct bvh_item item = items[0];
    items[0] = items[best];
    items[best] = item;
}

uint32_t split_items(struct bvh_item *items, uint32_t count, const struct bvh_box *middles,
                     struct bvh_box sides[2]) {
    if (count > SPLIT_SWEEP)
        return split_by_bins(items, count, middles, sides);
    if (count > 3)
        return split_by_sweep(items, count);
    if (count == 3)
        split_three(items);
    return 1;
}

// The bits of a float, ordered as the floats are.
static uint32_t middle_key(const struct bvh_item *item, int axis) {
    const uint32_t bits = float_bits(item_middle(item, axis) + 0.0f); // no negative zero
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
    float spread[4];
    lanes_store(lanes_sub(middles.upper, middles.lower), spread);
    int axis = spread[1] > spread[0] ? 1 : 0;
    if (spread[2] > spread[axis])
        axis = 2;
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
