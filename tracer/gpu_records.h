// The records of shaders/records.h as C structs that flattening fills, and their packing into words as
// kernels read them.
//
// Numbers and colours are double here, whatever a kernel uses: packing rounds those that are float. A record
// begins as zeros, so that a field that nobody fills is 0 in both precisions. Thread safety: pure functions.
#ifndef GLINT_TRACER_GPU_RECORDS_H
#define GLINT_TRACER_GPU_RECORDS_H

#include "core/float_bits.h"
#include "core/vec3.h"
#include "shaders/gpu_scene.h"
#include "shaders/records.h"
#include "tracer/gpu_word.h"

#include <string.h>

#define GPU_MEMBER_REAL3(name, word, word64)                         vec3 name;
#define GPU_MEMBER_REAL(name, word, component, word64, half64)       double name;
#define GPU_MEMBER_FLOAT3(name, word, word64)                        vec3 name;
#define GPU_MEMBER_FLOAT(name, word, component, word64, component64) double name;
#define GPU_MEMBER_UINT(name, word, component, word64, component64)  uint32_t name;

// Where a part lies in a word: components, and halves, which are named by two.
enum {
    GPU_PART_x = 0,
    GPU_PART_y = 1,
    GPU_PART_z = 2,
    GPU_PART_w = 3,
    GPU_PART_xy = 0,
    GPU_PART_zw = 2,
};

static inline void gpu_pack_uint(struct gpu_word *words, uint32_t word, uint32_t part, uint32_t value) {
    memcpy((unsigned char *)(words + word) + part * sizeof value, &value, sizeof value);
}
static inline void gpu_pack_float(struct gpu_word *words, uint32_t word, uint32_t part, double value) {
    float rounded = (float)value;
    memcpy((unsigned char *)(words + word) + part * sizeof rounded, &rounded, sizeof rounded);
}
static inline void gpu_pack_float3(struct gpu_word *words, uint32_t word, vec3 value) {
    const float rounded[3] = {(float)value.x, (float)value.y, (float)value.z};
    memcpy(words + word, rounded, sizeof rounded);
}
static inline void gpu_pack_double(struct gpu_word *words, uint32_t word, uint32_t part, double value) {
    memcpy((unsigned char *)(words + word) + part * sizeof(uint32_t), &value, sizeof value);
}
// TRIANGLE_REST: the bits of a double after those of a float are cut off, and are the rest.
static inline void gpu_pack_split(struct gpu_word *words, uint32_t word, uint32_t part, double value) {
    const uint64_t bits = double_bits(value), rest = bits & ((UINT64_C(1) << SPLIT_BITS) - 1);
    gpu_pack_float(words, word, part, double_of_bits(bits - rest));
    gpu_pack_uint(words, word + TRIANGLE_REST, part, (uint32_t)rest);
}
static inline void gpu_pack_split3(struct gpu_word *words, uint32_t word, vec3 value) {
    gpu_pack_split(words, word, GPU_PART_x, value.x);
    gpu_pack_split(words, word, GPU_PART_y, value.y);
    gpu_pack_split(words, word, GPU_PART_z, value.z);
}
// Restores the number that gpu_pack_split packed.
static inline double gpu_split_value(float first, uint32_t rest) {
    return double_of_bits(double_bits(first) | rest);
}
static inline void gpu_pack_double3(struct gpu_word *words, uint32_t word, vec3 value) {
    const double numbers[3] = {value.x, value.y, value.z};
    memcpy(words + word, numbers, sizeof numbers);
}

#define GPU_PACK_REAL3(name, word, word64) gpu_pack_float3(words, word, record->name);
#define GPU_PACK_REAL(name, word, component, word64, half64)                                                 \
    gpu_pack_float(words, word, GPU_PART_##component, record->name);
#define GPU_PACK_FLOAT3(name, word, word64) gpu_pack_float3(words, word, record->name);
#define GPU_PACK_FLOAT(name, word, component, word64, component64)                                           \
    gpu_pack_float(words, word, GPU_PART_##component, record->name);
#define GPU_PACK_UINT(name, word, component, word64, component64)                                            \
    gpu_pack_uint(words, word, GPU_PART_##component, record->name);

#define GPU_PACK64_REAL3(name, word, word64)  gpu_pack_double3(words, word64, record->name);
#define GPU_PACK64_SPLIT3(name, word, word64) gpu_pack_split3(words, word64, record->name);
#define GPU_PACK64_REAL(name, word, component, word64, half64)                                               \
    gpu_pack_double(words, word64, GPU_PART_##half64, record->name);
#define GPU_PACK64_FLOAT3(name, word, word64) gpu_pack_float3(words, word64, record->name);
#define GPU_PACK64_FLOAT(name, word, component, word64, component64)                                         \
    gpu_pack_float(words, word64, GPU_PART_##component64, record->name);
#define GPU_PACK64_UINT(name, word, component, word64, component64)                                          \
    gpu_pack_uint(words, word64, GPU_PART_##component64, record->name);

// `struct gpu_x`, and gpu_pack_x, which writes a record's words: X_WORDS, in double precision X64_WORDS.
#define GPU_RECORD_OF(name, NAME, GPU_PACK64_PLACE)                                                          \
    struct gpu_##name {                                                                                      \
        NAME##_FIELDS(GPU_MEMBER_REAL3, GPU_MEMBER_REAL, GPU_MEMBER_FLOAT3, GPU_MEMBER_FLOAT,                \
                      GPU_MEMBER_UINT)                                                                       \
    };                                                                                                       \
    static inline void gpu_pack_##name(const struct gpu_##name *record, bool is_double,                      \
                                       struct gpu_word *words) {                                             \
        memset(words, 0, (is_double ? NAME##64_WORDS : NAME##_WORDS) * sizeof *words);                       \
        if (is_double) {                                                                                     \
            NAME##_FIELDS(GPU_PACK64_PLACE, GPU_PACK64_REAL, GPU_PACK64_FLOAT3, GPU_PACK64_FLOAT,            \
                          GPU_PACK64_UINT)                                                                   \
        } else {                                                                                             \
            NAME##_FIELDS(GPU_PACK_REAL3, GPU_PACK_REAL, GPU_PACK_FLOAT3, GPU_PACK_FLOAT, GPU_PACK_UINT)     \
        }                                                                                                    \
    }

#define GPU_RECORD(name, NAME) GPU_RECORD_OF(name, NAME, GPU_PACK64_REAL3)

GPU_RECORD(node, NODE)
GPU_RECORD_OF(triangle, TRIANGLE, GPU_PACK64_SPLIT3)
GPU_RECORD(sphere, SPHERE)
GPU_RECORD(frustum, FRUSTUM)
GPU_RECORD(normal, NORMAL)
GPU_RECORD(body, BODY)
GPU_RECORD(material, MATERIAL)
GPU_RECORD(light, LIGHT)
GPU_RECORD(paint, PAINT)
GPU_RECORD(extent, EXTENT)
GPU_RECORD(seen, SEEN)

// The same of records that hold doubles in both precisions.
#define GPU_MEMBER_DOUBLE(name, word, half)     double name;
#define GPU_MEMBER_WHOLE(name, word, component) uint32_t name;
#define GPU_PACK_DOUBLE(name, word, half)       gpu_pack_double(words, word, GPU_PART_##half, record->name);
#define GPU_PACK_WHOLE(name, word, component)   gpu_pack_uint(words, word, GPU_PART_##component, record->name);
#define GPU_EXACT_RECORD(name, NAME)                                                                         \
    struct gpu_##name {                                                                                      \
        NAME##_FIELDS(GPU_MEMBER_DOUBLE, GPU_MEMBER_WHOLE)                                                   \
    };                                                                                                       \
    static inline void gpu_pack_##name(const struct gpu_##name *record, struct gpu_word *words) {            \
        memset(words, 0, NAME##_WORDS * sizeof *words);                                                      \
        NAME##_FIELDS(GPU_PACK_DOUBLE, GPU_PACK_WHOLE)                                                       \
    }

GPU_RECORD(entry, ENTRY)
GPU_EXACT_RECORD(placed, PLACED)
GPU_EXACT_RECORD(instance, INSTANCE)

#endif
