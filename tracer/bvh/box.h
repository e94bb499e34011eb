// Boxes around items, in float. Private to tracer/bvh. Thread safety: pure.
#ifndef GLINT_TRACER_BVH_BOX_H
#define GLINT_TRACER_BVH_BOX_H

#include "tracer/bvh/bvh.h"
#include "tracer/bvh/lanes.h"

#include <assert.h>
#include <float.h>
#include <stddef.h>

static_assert(sizeof(struct bvh_item) == 32 && offsetof(struct bvh_item, upper) == 16, "read by fours");

struct bvh_box {
    lanes lower, upper;
};

static inline struct bvh_box box_empty(void) {
    return (struct bvh_box){lanes_all(FLT_MAX), lanes_all(-FLT_MAX)};
}
static inline struct bvh_box box_of_item(const struct bvh_item *item) {
    const char *bytes = (const char *)item;
    return (struct bvh_box){lanes_load(bytes), lanes_load(bytes + offsetof(struct bvh_item, upper))};
}
static inline void box_join(struct bvh_box *box, const struct bvh_box *other) {
    box->lower = lanes_min(box->lower, other->lower);
    box->upper = lanes_max(box->upper, other->upper);
}
static inline void box_add_point(struct bvh_box *box, lanes point) {
    box->lower = lanes_min(box->lower, point);
    box->upper = lanes_max(box->upper, point);
}
// Half the surface area of a non-empty box; in double, so that it neither overflows nor vanishes.
static inline double box_area(const struct bvh_box *box) {
    float size[4];
    lanes_store(lanes_sub(lanes_three(box->upper), lanes_three(box->lower)), size);
    double x = (double)size[0], y = (double)size[1], z = (double)size[2];
    return x * y + y * z + z * x;
}

// Twice the centre.
static inline lanes item_middles(const struct bvh_item *item) {
    struct bvh_box box = box_of_item(item);
    return lanes_add(lanes_three(box.lower), lanes_three(box.upper));
}
static inline float item_middle(const struct bvh_item *item, int axis) {
    return item->lower[axis] + item->upper[axis];
}

#endif
