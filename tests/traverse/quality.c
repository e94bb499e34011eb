#include "tests/traverse/quality.h"

#include "shaders/gpu_scene.h"
#include "shaders/records.h"

#include <math.h>
#include <string.h>

enum {
    EXPONENT_BIAS = 127,
};

static uint32_t get_byte(uint32_t first, uint32_t second, int slot) {
    return (slot < 4 ? first : second) >> (slot % 4 * 8) & 255;
}

static double float_of(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

bool decode_child(const struct gpu_word words[NODE_WORDS], int slot, struct decoded_child *child) {
    uint32_t meta = get_byte(words[1].z, words[1].w, slot);
    if (!meta)
        return false;
    uint32_t mask = words[0].w >> 24;
    child->is_node = mask >> slot & 1;
    if (child->is_node) {
        child->first = words[1].x;
        for (int before = 0; before < slot; before++)
            child->first += mask >> before & 1;
        child->count = 0;
    } else {
        child->first = words[1].y + (meta & 31);
        child->count = (meta >> 5 & 1) + (meta >> 6 & 1) + (meta >> 7 & 1);
    }
    const uint32_t origin[3] = {words[0].x, words[0].y, words[0].z};
    const uint32_t low[3][2] = {{words[2].x, words[2].y}, {words[2].z, words[2].w}, {words[3].x, words[3].y}};
    const uint32_t high[3][2] = {
        {words[3].z, words[3].w}, {words[4].x, words[4].y}, {words[4].z, words[4].w}};
    for (int axis = 0; axis < 3; axis++) {
        int exponent = (int)(words[0].w >> (8 * axis) & 255) - EXPONENT_BIAS;
        child->lower[axis] =
            float_of(origin[axis]) + ldexp(get_byte(low[axis][0], low[axis][1], slot), exponent);
        child->upper[axis] =
            float_of(origin[axis]) + ldexp(get_byte(high[axis][0], high[axis][1], slot), exponent);
    }
    return true;
}

static double decoded_area(const struct decoded_child *child) {
    double x = child->upper[0] - child->lower[0];
    double y = child->upper[1] - child->lower[1];
    double z = child->upper[2] - child->lower[2];
    return x * y + y * z + z * x;
}

struct bvh_quality bvh_measure(const struct bvh *bvh) {
    struct bvh_quality quality = {.nodes = bvh->node_count, .items = bvh->item_count};
    uint64_t children = 0;
    double lower[3], upper[3];
    for (uint32_t node = 0; node < bvh->node_count; node++)
        for (int slot = 0; slot < BVH_WIDTH; slot++) {
            struct decoded_child child;
            if (!decode_child(bvh->nodes + (size_t)NODE_WORDS * node, slot, &child))
                continue;
            for (int axis = 0; axis < 3 && node == 0; axis++) {
                if (children == 0 || child.lower[axis] < lower[axis])
                    lower[axis] = child.lower[axis];
                if (children == 0 || child.upper[axis] > upper[axis])
                    upper[axis] = child.upper[axis];
            }
            children++;
            quality.leaves += !child.is_node;
            quality.cost +=
                decoded_area(&child) * (child.is_node ? BVH_COST_NODE : child.count * BVH_COST_ITEM);
        }
    if (children) {
        struct decoded_child root = {.lower = {lower[0], lower[1], lower[2]},
                                     .upper = {upper[0], upper[1], upper[2]}};
        double area = decoded_area(&root);
        quality.cost = BVH_COST_NODE + (area > 0 ? quality.cost / area : 0);
        quality.children_per_node = (double)children / bvh->node_count;
    }
    if (quality.leaves)
        quality.items_per_leaf = (double)bvh->item_count / quality.leaves;
    return quality;
}
