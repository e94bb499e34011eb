// Numbers of twice the digits of double, as unevaluated sums of two: for the few decisions that double leaves
// open. Private to reference/.
//
// Dekker 1971, "A Floating-Point Technique for Extending the Available Precision", and Knuth 1997,
// section 4.2.2; products by fma, which is exact. Relative error of an operation: a few times 2^-104. No
// overflow is caught: |values| below 1e100.
#ifndef GLINT_REFERENCE_WIDE_H
#define GLINT_REFERENCE_WIDE_H

#include "core/vec3.h"

#include <math.h>

struct wide {
    double high, low; // |low| is at most half a unit in the last place of high
};

struct wide3 {
    struct wide x, y, z;
};

// Requires |a| >= |b|, or a = 0.
static inline struct wide wide_ordered(double a, double b) {
    const double sum = a + b;
    return (struct wide){sum, b - (sum - a)};
}

static inline struct wide wide_of(double x) {
    return (struct wide){x, 0};
}

static inline struct wide wide_neg(struct wide x) {
    return (struct wide){-x.high, -x.low};
}

static inline struct wide wide_add(struct wide a, struct wide b) {
    const double sum = a.high + b.high, part = sum - a.high;
    const double rest = (a.high - (sum - part)) + (b.high - part);
    return wide_ordered(sum, rest + (a.low + b.low));
}

static inline struct wide wide_sub(struct wide a, struct wide b) {
    return wide_add(a, wide_neg(b));
}

static inline struct wide wide_mul(struct wide a, struct wide b) {
    const double product = a.high * b.high;
    return wide_ordered(product, fma(a.high, b.high, -product) + (a.high * b.low + a.low * b.high));
}

static inline struct wide wide_div(struct wide a, struct wide b) {
    const double quotient = a.high / b.high;
    const struct wide rest = wide_sub(a, wide_mul(wide_of(quotient), b));
    return wide_ordered(quotient, rest.high / b.high);
}

static inline struct wide3 wide3_of(vec3 v) {
    return (struct wide3){wide_of(v.x), wide_of(v.y), wide_of(v.z)};
}

static inline struct wide3 wide3_add(struct wide3 a, struct wide3 b) {
    return (struct wide3){wide_add(a.x, b.x), wide_add(a.y, b.y), wide_add(a.z, b.z)};
}

static inline struct wide3 wide3_sub(struct wide3 a, struct wide3 b) {
    return (struct wide3){wide_sub(a.x, b.x), wide_sub(a.y, b.y), wide_sub(a.z, b.z)};
}

static inline struct wide3 wide3_mul(struct wide3 v, struct wide factor) {
    return (struct wide3){wide_mul(v.x, factor), wide_mul(v.y, factor), wide_mul(v.z, factor)};
}

static inline struct wide wide3_dot(struct wide3 a, struct wide3 b) {
    return wide_add(wide_add(wide_mul(a.x, b.x), wide_mul(a.y, b.y)), wide_mul(a.z, b.z));
}

// a b - c d
static inline struct wide wide_difference(struct wide a, struct wide b, struct wide c, struct wide d) {
    return wide_sub(wide_mul(a, b), wide_mul(c, d));
}

static inline struct wide3 wide3_cross(struct wide3 a, struct wide3 b) {
    return (struct wide3){wide_difference(a.y, b.z, a.z, b.y), wide_difference(a.z, b.x, a.x, b.z),
                          wide_difference(a.x, b.y, a.y, b.x)};
}

#endif
