// Points of the plane: exact tests, and a little arithmetic.
//
// Thread safety: pure.
#ifndef GLINT_ASSETS_MADE_PLANE_H
#define GLINT_ASSETS_MADE_PLANE_H

#include "grammar/ir_value.h"

#include <math.h>

static inline struct ir_pair plane_add(struct ir_pair a, struct ir_pair b) {
    return (struct ir_pair){a.u + b.u, a.v + b.v};
}
static inline struct ir_pair plane_sub(struct ir_pair a, struct ir_pair b) {
    return (struct ir_pair){a.u - b.u, a.v - b.v};
}
static inline struct ir_pair plane_mul(struct ir_pair a, double s) {
    return (struct ir_pair){a.u * s, a.v * s};
}
static inline struct ir_pair plane_mix(struct ir_pair a, struct ir_pair b, double share) {
    return (struct ir_pair){a.u + (b.u - a.u) * share, a.v + (b.v - a.v) * share};
}
static inline double plane_dot(struct ir_pair a, struct ir_pair b) {
    return a.u * b.u + a.v * b.v;
}
static inline double plane_cross(struct ir_pair a, struct ir_pair b) {
    return a.u * b.v - a.v * b.u;
}
static inline bool plane_same(struct ir_pair a, struct ir_pair b) {
    return a.u == b.u && a.v == b.v;
}
// A number nearer to 0 than this counts as 0, so that no product of two coordinates underflows.
#define PLANE_LEAST 1e-100
// Makes 0 of what counts as 0, and of -0.
static inline double plane_number(double a) {
    return fabs(a) < PLANE_LEAST ? 0 : a;
}
static inline struct ir_pair plane_point(struct ir_pair a) {
    return (struct ir_pair){plane_number(a.u), plane_number(a.v)};
}
// From left to right, and upwards where that is the same.
static inline bool plane_before(struct ir_pair a, struct ir_pair b) {
    return a.u < b.u || (a.u == b.u && a.v < b.v);
}

struct plane_box {
    struct ir_pair lower, upper;
};
// Contains nothing.
#define PLANE_BOX_EMPTY ((struct plane_box){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}})
static inline void plane_include(struct plane_box *box, struct ir_pair at) {
    box->lower = (struct ir_pair){fmin(box->lower.u, at.u), fmin(box->lower.v, at.v)};
    box->upper = (struct ir_pair){fmax(box->upper.u, at.u), fmax(box->upper.v, at.v)};
}

double plane_distance(struct ir_pair a, struct ir_pair b);
// From `a` towards `b`, of length 1; (0, 0) if they are the same point.
struct ir_pair plane_direction(struct ir_pair a, struct ir_pair b);

// On which side of the line from `a` to `b` the point `c` is: 1 left, -1 right, 0 on it. Exact for points
// that plane_point made (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust
// geometric predicates"; here with one filter, and then in full).
int plane_side(struct ir_pair a, struct ir_pair b, struct ir_pair c);
// Where the lines through two pieces cross, which are not parallel; rounded.
struct ir_pair plane_crossing(struct ir_pair a, struct ir_pair b, struct ir_pair c, struct ir_pair d);

#endif
