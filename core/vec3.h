// Small double-precision vectors, matrices and affine maps, by value.
#ifndef GLINT_CORE_VEC3_H
#define GLINT_CORE_VEC3_H

#include "core/turn.h"

#include <math.h>
#include <stdbool.h>

typedef struct {
    double x, y, z;
} vec3;

// Rows: m[row][column].
typedef struct {
    double m[3][3];
} mat3;

// point -> linear * point + offset
typedef struct {
    mat3 linear;
    vec3 offset;
} affine3;

static inline vec3 vec3_add(vec3 a, vec3 b) {
    return (vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline vec3 vec3_sub(vec3 a, vec3 b) {
    return (vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline vec3 vec3_mul(vec3 a, double s) {
    return (vec3){a.x * s, a.y * s, a.z * s};
}
// Component by component.
static inline vec3 vec3_times(vec3 a, vec3 b) {
    return (vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}
static inline vec3 vec3_abs(vec3 a) {
    return (vec3){fabs(a.x), fabs(a.y), fabs(a.z)};
}
static inline double vec3_along(vec3 a, int axis) {
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}
static inline vec3 vec3_neg(vec3 a) {
    return (vec3){-a.x, -a.y, -a.z};
}
static inline double vec3_dot(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline vec3 vec3_cross(vec3 a, vec3 b) {
    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline vec3 vec3_min(vec3 a, vec3 b) {
    return (vec3){fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z)};
}
static inline vec3 vec3_max(vec3 a, vec3 b) {
    return (vec3){fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z)};
}
// The same for coordinates that are never NaN, by plain comparisons: fmin and fmax are function calls.
static inline vec3 vec3_least(vec3 a, vec3 b) {
    return (vec3){a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z};
}
static inline vec3 vec3_greatest(vec3 a, vec3 b) {
    return (vec3){a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z};
}
// As fmax, which is a function call.
static inline double vec3_larger(double a, double b) {
    return b > a || a != a ? b : a;
}
static inline double vec3_max_abs(vec3 a) {
    return vec3_larger(fabs(a.x), vec3_larger(fabs(a.y), fabs(a.z)));
}
static inline bool vec3_is_zero(vec3 a) {
    return a.x == 0 && a.y == 0 && a.z == 0;
}

// Whether the squares of coordinates up to this size neither overflow nor underflow where it matters: then
// dividing by a power of two first would not change a bit, but would cost more than all the rest.
static inline bool vec3_squares_fit(double largest) {
    return largest > 0x1p-400 && largest < 0x1p400;
}

// Length without overflow or underflow in between: divided by a power of two first where that is needed, so
// that scaling by powers of two commutes with it.
static inline double vec3_length(vec3 a) {
    double largest = vec3_max_abs(a);
    if (vec3_squares_fit(largest))
        return sqrt(vec3_dot(a, a));
    if (!(largest > 0) || !isfinite(largest))
        return largest;
    int exponent = ilogb(largest);
    vec3 b = {scalbn(a.x, -exponent), scalbn(a.y, -exponent), scalbn(a.z, -exponent)};
    return scalbn(sqrt(vec3_dot(b, b)), exponent);
}

// The zero vector stays as it is.
static inline vec3 vec3_unit(vec3 a) {
    double largest = vec3_max_abs(a);
    if (vec3_squares_fit(largest)) {
        const double length = sqrt(vec3_dot(a, a));
        return (vec3){a.x / length, a.y / length, a.z / length};
    }
    if (!(largest > 0) || !isfinite(largest))
        return a;
    int exponent = ilogb(largest);
    vec3 b = {scalbn(a.x, -exponent), scalbn(a.y, -exponent), scalbn(a.z, -exponent)};
    double length = sqrt(vec3_dot(b, b));
    return (vec3){b.x / length, b.y / length, b.z / length};
}

static inline vec3 mat3_apply(mat3 a, vec3 v) {
    return (vec3){a.m[0][0] * v.x + a.m[0][1] * v.y + a.m[0][2] * v.z,
                  a.m[1][0] * v.x + a.m[1][1] * v.y + a.m[1][2] * v.z,
                  a.m[2][0] * v.x + a.m[2][1] * v.y + a.m[2][2] * v.z};
}

static inline vec3 mat3_row(mat3 a, int i) {
    return (vec3){a.m[i][0], a.m[i][1], a.m[i][2]};
}
static inline vec3 mat3_column(mat3 a, int i) {
    return (vec3){a.m[0][i], a.m[1][i], a.m[2][i]};
}

static inline mat3 mat3_mul(mat3 a, mat3 b) {
    mat3 c;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
    return c;
}

static inline double mat3_determinant(mat3 a) {
    vec3 rows[3];
    for (int i = 0; i < 3; i++)
        rows[i] = (vec3){a.m[i][0], a.m[i][1], a.m[i][2]};
    return vec3_dot(rows[0], vec3_cross(rows[1], rows[2]));
}

static inline vec3 affine3_apply(affine3 a, vec3 v) {
    return vec3_add(mat3_apply(a.linear, v), a.offset);
}

static inline affine3 affine3_mul(affine3 outer, affine3 inner) {
    return (affine3){mat3_mul(outer.linear, inner.linear), affine3_apply(outer, inner.offset)};
}

// ---- rotations

struct vec3_turn {
    double sine, cosine;
};

static inline struct vec3_turn vec3_turn_of(double degrees) {
    return (struct vec3_turn){turn_sine(degrees), turn_cosine(degrees)};
}

// Rz·Ry·Rx of angles in degrees; exact for multiples of 90.
static inline mat3 mat3_rotation(vec3 degrees) {
    struct vec3_turn x = vec3_turn_of(degrees.x);
    struct vec3_turn y = vec3_turn_of(degrees.y);
    struct vec3_turn z = vec3_turn_of(degrees.z);
    mat3 rx = {{{1, 0, 0}, {0, x.cosine, -x.sine}, {0, x.sine, x.cosine}}};
    mat3 ry = {{{y.cosine, 0, y.sine}, {0, 1, 0}, {-y.sine, 0, y.cosine}}};
    mat3 rz = {{{z.cosine, -z.sine, 0}, {z.sine, z.cosine, 0}, {0, 0, 1}}};
    mat3 all = mat3_mul(rz, mat3_mul(ry, rx));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            all.m[i][j] += 0.0; // no -0
    return all;
}

#endif
