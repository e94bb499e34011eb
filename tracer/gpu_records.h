// The records of shaders/records.h as C structs, word for word as kernels read them.
#ifndef GLINT_TRACER_GPU_RECORDS_H
#define GLINT_TRACER_GPU_RECORDS_H

#include "shaders/gpu_scene.h"
#include "shaders/records.h"
#include "tracer/gpu_word.h"

#include <assert.h>
#include <stddef.h>

#define GPU_MEMBER_REAL3(name, word)            double name[3];
#define GPU_MEMBER_REAL(name, word, half)       double name;
#define GPU_MEMBER_VECTOR(name, word)           float name[3];
#define GPU_MEMBER_FLOAT(name, word, component) float name;
#define GPU_MEMBER_UINT(name, word, component)  uint32_t name;
#define GPU_MEMBERS(RECORD)                                                                                  \
    RECORD##_FIELDS(GPU_MEMBER_REAL3, GPU_MEMBER_REAL, GPU_MEMBER_VECTOR, GPU_MEMBER_FLOAT, GPU_MEMBER_UINT)

struct gpu_node {
    GPU_MEMBERS(NODE)
};
struct gpu_triangle {
    GPU_MEMBERS(TRIANGLE)
};
struct gpu_sphere {
    GPU_MEMBERS(SPHERE)
};
struct gpu_body {
    GPU_MEMBERS(BODY)
};
struct gpu_material {
    GPU_MEMBERS(MATERIAL)
};
struct gpu_light {
    GPU_MEMBERS(LIGHT)
};

// Of scenes in double precision.
struct gpu_triangle64 {
    GPU_MEMBERS(TRIANGLE64)
};
struct gpu_sphere64 {
    GPU_MEMBERS(SPHERE64)
};
struct gpu_normal64 {
    GPU_MEMBERS(NORMAL64)
};
struct gpu_body64 {
    GPU_MEMBERS(BODY64)
};
struct gpu_material64 {
    GPU_MEMBERS(MATERIAL64)
};
struct gpu_light64 {
    GPU_MEMBERS(LIGHT64)
};

// Half a word is named by its components.
#define GPU_HALF_xy x
#define GPU_HALF_zw z
#define GPU_PLACE(name, word, component)                                                                     \
    static_assert(offsetof(record, name) ==                                                                  \
                      (word) * sizeof(struct gpu_word) + offsetof(struct gpu_word, component),               \
                  "the C struct and records.h disagree about " #name);
#define GPU_PLACE_HALF(name, word, half) GPU_PLACE(name, word, GPU_HALF_##half)
#define GPU_PLACE_START(name, word)      GPU_PLACE(name, word, x)
#define GPU_CHECK(type, RECORD)                                                                              \
    {                                                                                                        \
        typedef struct type record;                                                                          \
        static_assert(sizeof(record) == RECORD##_WORDS * sizeof(struct gpu_word), "another size");           \
        RECORD##_FIELDS(GPU_PLACE_START, GPU_PLACE_HALF, GPU_PLACE_START, GPU_PLACE, GPU_PLACE)              \
    }

// Asserts alone.
static inline void gpu_check_records(void) {
    GPU_CHECK(gpu_node, NODE)
    GPU_CHECK(gpu_triangle, TRIANGLE)
    GPU_CHECK(gpu_sphere, SPHERE)
    GPU_CHECK(gpu_body, BODY)
    GPU_CHECK(gpu_material, MATERIAL)
    GPU_CHECK(gpu_light, LIGHT)
    GPU_CHECK(gpu_triangle64, TRIANGLE64)
    GPU_CHECK(gpu_sphere64, SPHERE64)
    GPU_CHECK(gpu_normal64, NORMAL64)
    GPU_CHECK(gpu_body64, BODY64)
    GPU_CHECK(gpu_material64, MATERIAL64)
    GPU_CHECK(gpu_light64, LIGHT64)
}

#endif
