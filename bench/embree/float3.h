// Three floats, by value: what the peer on Embree computes with. Pure functions.
#ifndef GLINT_BENCH_EMBREE_FLOAT3_H
#define GLINT_BENCH_EMBREE_FLOAT3_H

#include "core/vec3.h"

typedef struct {
    float x, y, z;
} float3;

static inline float3 float3_of(vec3 v) {
    return (float3){(float)v.x, (float)v.y, (float)v.z};
}
static inline float3 float3_add(float3 a, float3 b) {
    return (float3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline float3 float3_sub(float3 a, float3 b) {
    return (float3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline float3 float3_mul(float3 a, float s) {
    return (float3){a.x * s, a.y * s, a.z * s};
}
static inline float3 float3_scale(float3 a, float3 b) {
    return (float3){a.x * b.x, a.y * b.y, a.z * b.z};
}
static inline float3 float3_neg(float3 a) {
    return (float3){-a.x, -a.y, -a.z};
}
static inline float3 float3_abs(float3 a) {
    return (float3){fabsf(a.x), fabsf(a.y), fabsf(a.z)};
}
static inline float float3_dot(float3 a, float3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline float3 float3_cross(float3 a, float3 b) {
    return (float3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline float3 float3_unit(float3 a) {
    return float3_mul(a, 1.0F / sqrtf(float3_dot(a, a)));
}
static inline float float3_largest(float3 a) {
    const float most = a.x > a.y ? a.x : a.y;
    return most > a.z ? most : a.z;
}
static inline bool float3_is_zero(float3 a) {
    return a.x == 0 && a.y == 0 && a.z == 0;
}

// Rows, and what is added.
typedef struct {
    float3 rows[3], offset;
} float34;

static inline float34 float34_of(affine3 a) {
    float34 out;
    for (int i = 0; i < 3; i++)
        out.rows[i] = (float3){(float)a.linear.m[i][0], (float)a.linear.m[i][1], (float)a.linear.m[i][2]};
    out.offset = float3_of(a.offset);
    return out;
}
static inline float3 float34_turn(const float34 *a, float3 v) {
    return (float3){float3_dot(a->rows[0], v), float3_dot(a->rows[1], v), float3_dot(a->rows[2], v)};
}
static inline float3 float34_apply(const float34 *a, float3 v) {
    return float3_add(float34_turn(a, v), a->offset);
}

#endif
