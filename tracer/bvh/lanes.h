// Four floats at a time: x, y, z, and a fourth that is unused. Private to tracer/bvh.
//
// One instruction each if the processor has SSE2 (every x86-64 has), else plain loops; both give the same
// bits: minima and maxima are `a < b ? a : b` and `a > b ? a : b`. Thread safety: pure.
#ifndef GLINT_TRACER_BVH_LANES_H
#define GLINT_TRACER_BVH_LANES_H

#include <stdint.h>
#include <string.h>

#if defined(__SSE2__) && !defined(GLINT_PLAIN_LANES)
#include <emmintrin.h>

typedef __m128 lanes;

static inline lanes lanes_load(const void *four) {
    return _mm_loadu_ps((const float *)four);
}
static inline void lanes_store(lanes a, float four[4]) {
    _mm_storeu_ps(four, a);
}
static inline lanes lanes_all(float a) {
    return _mm_set1_ps(a);
}
static inline lanes lanes_add(lanes a, lanes b) {
    return _mm_add_ps(a, b);
}
static inline lanes lanes_sub(lanes a, lanes b) {
    return _mm_sub_ps(a, b);
}
static inline lanes lanes_mul(lanes a, lanes b) {
    return _mm_mul_ps(a, b);
}
static inline lanes lanes_min(lanes a, lanes b) {
    return _mm_min_ps(a, b);
}
static inline lanes lanes_max(lanes a, lanes b) {
    return _mm_max_ps(a, b);
}
// Sets the fourth to 0: sums of meaningless numbers may be slow.
static inline lanes lanes_three(lanes a) {
    return _mm_and_ps(a, _mm_castsi128_ps(_mm_setr_epi32(-1, -1, -1, 0)));
}
// Rounded towards 0; each must fit.
static inline void lanes_whole(lanes a, int32_t four[4]) {
    _mm_storeu_si128((__m128i *)(void *)four, _mm_cvttps_epi32(a));
}

#else

typedef struct {
    float at[4];
} lanes;

static inline lanes lanes_load(const void *four) {
    lanes a;
    memcpy(&a, four, sizeof a);
    return a;
}
static inline void lanes_store(lanes a, float four[4]) {
    memcpy(four, &a, sizeof a);
}
static inline lanes lanes_all(float a) {
    return (lanes){{a, a, a, a}};
}
#define LANES_OPERATION(name, result)                                                                        \
    static inline lanes name(lanes a, lanes b) {                                                             \
        for (int i = 0; i < 4; i++)                                                                          \
            a.at[i] = result;                                                                                \
        return a;                                                                                            \
    }
LANES_OPERATION(lanes_add, a.at[i] + b.at[i])
LANES_OPERATION(lanes_sub, a.at[i] - b.at[i])
LANES_OPERATION(lanes_mul, a.at[i] * b.at[i])
LANES_OPERATION(lanes_min, a.at[i] < b.at[i] ? a.at[i] : b.at[i])
LANES_OPERATION(lanes_max, a.at[i] > b.at[i] ? a.at[i] : b.at[i])
#undef LANES_OPERATION
static inline lanes lanes_three(lanes a) {
    a.at[3] = 0;
    return a;
}
static inline void lanes_whole(lanes a, int32_t four[4]) {
    for (int i = 0; i < 4; i++)
        four[i] = (int32_t)a.at[i];
}

#endif

#endif
