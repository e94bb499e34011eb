// Boxes around items, in float. Private to tracer/bvh. Thread safety: pure.
#ifndef GLINT_TRACER_BVH_BOX_H
#define GLINT_TRACER_BVH_BOX_H

#include "tracer/bvh/bvh.h"

struct bvh_box {
    float lower[3], upper[3];
};

static inline struct bvh_box item_box(const struct bvh_item *item) {
    return (struct bvh_box){{item->lower[0], item->lower[1], item->lower[2]},
                            {item->upper[0], item->upper[1], item->upper[2]}};
}
static inline float float_min(float a, float b) {
    return a < b ? a : b;
}
static inline float float_max(float a, float b) {
    return a > b ? a : b;
}

static inline struct bvh_box box_empty(void) {
    return (struct bvh_box){{BVH_COORDINATE_MAX, BVH_COORDINATE_MAX, BVH_COORDINATE_MAX},
                            {-BVH_COORDINATE_MAX, -BVH_COORDINATE_MAX, -BVH_COORDINATE_MAX}};
}
static inline void box_grow(struct bvh_box *box, const float lower[3], const float upper[3]) {
    for (int axis = 0; axis < 3; axis++) {
        box->lower[axis] = float_min(box->lower[axis], lower[axis]);
        box->upper[axis] = float_max(box->upper[axis], upper[axis]);
    }
}
// Half of the surface; in double, so that no box overflows or vanishes.
static inline double box_area(const struct bvh_box *box) {
    double x = (double)box->upper[0] - box->lower[0];
    double y = (double)box->upper[1] - box->lower[1];
    double z = (double)box->upper[2] - box->lower[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
}
// Twice the centre.
static inline float item_middle(const struct bvh_item *item, int axis) {
    return item->lower[axis] + item->upper[axis];
}

#endif
