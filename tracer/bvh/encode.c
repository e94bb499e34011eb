#include "tracer/bvh/encode.h"

#include "core/float_bits.h"
#include "shaders/gpu_scene.h"
#include "shaders/records.h"
#include "tracer/bvh/round.h"

#include <assert.h>
#include <math.h>

static_assert(NODE_WORDS == 5, "the words below");

enum {
    EXPONENT_BIAS = 127,
    EXPONENT_LEAST = -100, // smaller quanta would let 2^e / d leave the normal numbers
    QUANTUM_LEAST = 32,    // and below 2^-32 of a coordinate the widening would be lost in double
    DOUBLE_BIAS = 1023,    // as a double is stored
    DOUBLE_DIGITS = 52,
};

// One axis of a node: planes lie at origin + q * 2^exponent, q in 0..255.
struct axis_grid {
    float origin;
    int exponent;
};

static double larger(double a, double b) {
    return a > b ? a : b;
}

// 2^exponent, a normal number.
static double power_of_two(int exponent) {
    return double_of_bits((uint64_t)(exponent + DOUBLE_BIAS) << DOUBLE_DIGITS);
}

// The least exponent whose power of two is not below a positive normal number.
static int exponent_above(double value) {
    const uint64_t bits = double_bits(value);
    const bool is_power = !(bits << (64 - DOUBLE_DIGITS));
    return (int)(bits >> DOUBLE_DIGITS) - DOUBLE_BIAS + !is_power;
}

// Rounds up a number that is neither negative nor large.
static uint32_t whole_above(double value) {
    const int32_t below = (int32_t)value;
    return (uint32_t)(below + (below < value));
}

// The decoding (p - o)/d + q * (2^e/d) rounds p - o, the two products and the sum. The part of the error that
// does not scale with the whole term is below 3 * 255 * 2^-24 quanta; widening by 2^-12 of a quantum covers
// it, and the scaled far distance covers the rest.
static double widening(int exponent) {
    return power_of_two(exponent - 12);
}

static struct axis_grid axis_grid_make(double lower, double upper) {
    double quantum =
        larger((upper - lower) / 254, larger(fabs(lower), fabs(upper)) * power_of_two(-QUANTUM_LEAST));
    int exponent = EXPONENT_LEAST;
    if (quantum > power_of_two(EXPONENT_LEAST))
        exponent = exponent_above(quantum);
    for (;; exponent++) {
        float origin = float_below(lower - widening(exponent));
        if ((upper + widening(exponent) - origin) * power_of_two(-exponent) <= 255)
            return (struct axis_grid){origin, exponent};
    }
}

static void put_byte(uint32_t pair[2], int slot, uint32_t byte) {
    pair[slot / 4] |= byte << (slot % 4 * 8);
}

// Planes of an empty slot are inverted, so that no ray hits it.
static void encode_axis(const struct wide_child slots[BVH_WIDTH], float lower[BVH_WIDTH][4],
                        float upper[BVH_WIDTH][4], int axis, const struct axis_grid *grid, uint32_t low[2],
                        uint32_t high[2]) {
    double wide = widening(grid->exponent);
    double per_quantum = power_of_two(-grid->exponent);
    for (int slot = 0; slot < BVH_WIDTH; slot++) {
        uint32_t below = 255;
        uint32_t above = 0;
        if (slots[slot].count) {
            below = (uint32_t)((lower[slot][axis] - wide - grid->origin) * per_quantum);
            above = whole_above((upper[slot][axis] + wide - grid->origin) * per_quantum);
            assert(below <= above && above <= 255);
        }
        put_byte(low, slot, below);
        put_byte(high, slot, above);
    }
}

// Returns the mask of children that are nodes.
static uint32_t encode_meta(const struct wide_child slots[BVH_WIDTH], uint32_t meta[2]) {
    static const uint32_t unary[BVH_LEAF_ITEMS + 1] = {0, 1, 3, 7};
    uint32_t mask = 0;
    uint32_t offset = 0;
    for (int slot = 0; slot < BVH_WIDTH; slot++) {
        const struct wide_child *child = &slots[slot];
        if (child->is_node) {
            mask |= 1u << slot;
            put_byte(meta, slot, 1u << 5 | (24u + (uint32_t)slot));
        } else if (child->count) {
            put_byte(meta, slot, unary[child->count] << 5 | offset);
            offset += child->count;
        }
    }
    return mask;
}

void encode_node(const struct wide_child slots[BVH_WIDTH], uint32_t first_node, uint32_t first_item,
                 struct gpu_word words[NODE_WORDS]) {
    struct axis_grid grid[3];
    uint32_t low[3][2] = {{0}};
    uint32_t high[3][2] = {{0}};
    uint32_t meta[2] = {0};
    float lower[BVH_WIDTH][4], upper[BVH_WIDTH][4], all[2][4];
    struct bvh_box box = box_empty();
    bool is_empty = true;
    for (int slot = 0; slot < BVH_WIDTH; slot++)
        if (slots[slot].count) {
            box_join(&box, &slots[slot].box);
            lanes_store(slots[slot].box.lower, lower[slot]);
            lanes_store(slots[slot].box.upper, upper[slot]);
            is_empty = false;
        }
    lanes_store(box.lower, all[0]);
    lanes_store(box.upper, all[1]);
    for (int axis = 0; axis < 3; axis++) {
        grid[axis] = is_empty ? (struct axis_grid){0, 0} : axis_grid_make(all[0][axis], all[1][axis]);
        encode_axis(slots, lower, upper, axis, &grid[axis], low[axis], high[axis]);
    }
    uint32_t mask = encode_meta(slots, meta);
    uint32_t exponents = 0;
    for (int axis = 0; axis < 3; axis++)
        exponents |= (uint32_t)(grid[axis].exponent + EXPONENT_BIAS) << (8 * axis);
    words[0] = (struct gpu_word){float_bits(grid[0].origin), float_bits(grid[1].origin),
                                 float_bits(grid[2].origin), exponents | mask << 24};
    words[1] = (struct gpu_word){first_node, first_item, meta[0], meta[1]};
    words[2] = (struct gpu_word){low[0][0], low[0][1], low[1][0], low[1][1]};
    words[3] = (struct gpu_word){low[2][0], low[2][1], high[0][0], high[0][1]};
    words[4] = (struct gpu_word){high[1][0], high[1][1], high[2][0], high[2][1]};
}
