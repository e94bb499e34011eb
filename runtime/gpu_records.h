// The records of shaders/records.h as C structs, word for word as kernels read them.
#ifndef GLINT_RUNTIME_GPU_RECORDS_H
#define GLINT_RUNTIME_GPU_RECORDS_H

#include "runtime/gpu_word.h"
#include "shaders/gpu_scene.h"
#include "shaders/records.h"

#include <assert.h>
#include <stddef.h>

#define GPU_MEMBER_VECTOR(name, word)           float name[3];
#define GPU_MEMBER_FLOAT(name, word, component) float name;
#define GPU_MEMBER_UINT(name, word, component)  uint32_t name;

struct gpu_node {
    NODE_FIELDS(GPU_MEMBER_VECTOR, GPU_MEMBER_FLOAT, GPU_MEMBER_UINT)
};
struct gpu_triangle {
    TRIANGLE_FIELDS(GPU_MEMBER_VECTOR, GPU_MEMBER_FLOAT, GPU_MEMBER_UINT)
};
struct gpu_sphere {
    SPHERE_FIELDS(GPU_MEMBER_VECTOR, GPU_MEMBER_FLOAT, GPU_MEMBER_UINT)
};
struct gpu_body {
    BODY_FIELDS(GPU_MEMBER_VECTOR, GPU_MEMBER_FLOAT, GPU_MEMBER_UINT)
};
struct gpu_material {
    MATERIAL_FIELDS(GPU_MEMBER_VECTOR, GPU_MEMBER_FLOAT, GPU_MEMBER_UINT)
};
struct gpu_light {
    LIGHT_FIELDS(GPU_MEMBER_VECTOR, GPU_MEMBER_FLOAT, GPU_MEMBER_UINT)
};

// Of scenes in double precision.
#define GPU_MEMBER_REAL3(name, word)      double name[3];
#define GPU_MEMBER_REAL(name, word, half) double name;
#define GPU_MEMBERS64(FIELDS)                                                                                \
    FIELDS(GPU_MEMBER_REAL3, GPU_MEMBER_REAL, GPU_MEMBER_VECTOR, GPU_MEMBER_FLOAT, GPU_MEMBER_UINT)
struct gpu_triangle64 {
    GPU_MEMBERS64(TRIANGLE64_FIELDS)
};
struct gpu_sphere64 {
    GPU_MEMBERS64(SPHERE64_FIELDS)
};
struct gpu_normal64 {
    GPU_MEMBERS64(NORMAL64_FIELDS)
};
struct gpu_body64 {
    GPU_MEMBERS64(BODY64_FIELDS)
};
struct gpu_material64 {
    GPU_MEMBERS64(MATERIAL64_FIELDS)
};
struct gpu_light64 {
    GPU_MEMBERS64(LIGHT64_FIELDS)
};

#define GPU_PLACE(record, name, word, component)                                                             \
    static_assert(offsetof(struct record, name) ==                                                           \
                      (word) * sizeof(struct gpu_word) + offsetof(struct gpu_word, component),               \
                  #record " and records.h disagree about " #name);
#define GPU_RECORD_IS(record, words)                                                                         \
    static_assert(sizeof(struct record) == (words) * sizeof(struct gpu_word), #record " has another size");

#define GPU_NODE_VECTOR(name, word)                GPU_PLACE(gpu_node, name, word, x)
#define GPU_NODE_SCALAR(name, word, component)     GPU_PLACE(gpu_node, name, word, component)
#define GPU_TRIANGLE_VECTOR(name, word)            GPU_PLACE(gpu_triangle, name, word, x)
#define GPU_TRIANGLE_SCALAR(name, word, component) GPU_PLACE(gpu_triangle, name, word, component)
#define GPU_SPHERE_VECTOR(name, word)              GPU_PLACE(gpu_sphere, name, word, x)
#define GPU_SPHERE_SCALAR(name, word, component)   GPU_PLACE(gpu_sphere, name, word, component)
#define GPU_BODY_VECTOR(name, word)                GPU_PLACE(gpu_body, name, word, x)
#define GPU_BODY_SCALAR(name, word, component)     GPU_PLACE(gpu_body, name, word, component)
#define GPU_MATERIAL_VECTOR(name, word)            GPU_PLACE(gpu_material, name, word, x)
#define GPU_MATERIAL_SCALAR(name, word, component) GPU_PLACE(gpu_material, name, word, component)
#define GPU_LIGHT_VECTOR(name, word)               GPU_PLACE(gpu_light, name, word, x)
#define GPU_LIGHT_SCALAR(name, word, component)    GPU_PLACE(gpu_light, name, word, component)

NODE_FIELDS(GPU_NODE_VECTOR, GPU_NODE_SCALAR, GPU_NODE_SCALAR)
TRIANGLE_FIELDS(GPU_TRIANGLE_VECTOR, GPU_TRIANGLE_SCALAR, GPU_TRIANGLE_SCALAR)
SPHERE_FIELDS(GPU_SPHERE_VECTOR, GPU_SPHERE_SCALAR, GPU_SPHERE_SCALAR)
BODY_FIELDS(GPU_BODY_VECTOR, GPU_BODY_SCALAR, GPU_BODY_SCALAR)
MATERIAL_FIELDS(GPU_MATERIAL_VECTOR, GPU_MATERIAL_SCALAR, GPU_MATERIAL_SCALAR)
LIGHT_FIELDS(GPU_LIGHT_VECTOR, GPU_LIGHT_SCALAR, GPU_LIGHT_SCALAR)
GPU_RECORD_IS(gpu_node, NODE_WORDS)
GPU_RECORD_IS(gpu_triangle, TRIANGLE_WORDS)
GPU_RECORD_IS(gpu_sphere, SPHERE_WORDS)
GPU_RECORD_IS(gpu_body, BODY_WORDS)
GPU_RECORD_IS(gpu_material, MATERIAL_WORDS)
GPU_RECORD_IS(gpu_light, LIGHT_WORDS)

// Half a word is named by its components.
#define GPU_HALF_xy                        x
#define GPU_HALF_zw                        z
#define GPU_TRIANGLE64_REAL3(name, word)   GPU_PLACE(gpu_triangle64, name, word, x)
#define GPU_TRIANGLE64_REAL(name, word, h) GPU_PLACE(gpu_triangle64, name, word, GPU_HALF_##h)
#define GPU_TRIANGLE64_UINT(name, word, c) GPU_PLACE(gpu_triangle64, name, word, c)
#define GPU_SPHERE64_REAL3(name, word)     GPU_PLACE(gpu_sphere64, name, word, x)
#define GPU_SPHERE64_REAL(name, word, h)   GPU_PLACE(gpu_sphere64, name, word, GPU_HALF_##h)
#define GPU_SPHERE64_UINT(name, word, c)   GPU_PLACE(gpu_sphere64, name, word, c)
#define GPU_NORMAL64_REAL3(name, word)     GPU_PLACE(gpu_normal64, name, word, x)
#define GPU_NORMAL64_REAL(name, word, h)   GPU_PLACE(gpu_normal64, name, word, GPU_HALF_##h)
#define GPU_NORMAL64_UINT(name, word, c)   GPU_PLACE(gpu_normal64, name, word, c)
#define GPU_BODY64_REAL3(name, word)       GPU_PLACE(gpu_body64, name, word, x)
#define GPU_BODY64_REAL(name, word, h)     GPU_PLACE(gpu_body64, name, word, GPU_HALF_##h)
#define GPU_BODY64_UINT(name, word, c)     GPU_PLACE(gpu_body64, name, word, c)
#define GPU_MATERIAL64_REAL3(name, word)   GPU_PLACE(gpu_material64, name, word, x)
#define GPU_MATERIAL64_REAL(name, word, h) GPU_PLACE(gpu_material64, name, word, GPU_HALF_##h)
#define GPU_MATERIAL64_UINT(name, word, c) GPU_PLACE(gpu_material64, name, word, c)
#define GPU_LIGHT64_REAL3(name, word)      GPU_PLACE(gpu_light64, name, word, x)
#define GPU_LIGHT64_REAL(name, word, h)    GPU_PLACE(gpu_light64, name, word, GPU_HALF_##h)
#define GPU_LIGHT64_UINT(name, word, c)    GPU_PLACE(gpu_light64, name, word, c)
#define GPU_CHECK64(RECORD)                                                                                  \
    RECORD##64_FIELDS(GPU_##RECORD##64_REAL3, GPU_##RECORD##64_REAL, GPU_##RECORD##64_REAL3,                 \
                      GPU_##RECORD##64_UINT, GPU_##RECORD##64_UINT)

GPU_CHECK64(TRIANGLE)
GPU_CHECK64(SPHERE)
GPU_CHECK64(NORMAL)
GPU_CHECK64(BODY)
GPU_CHECK64(MATERIAL)
GPU_CHECK64(LIGHT)
GPU_RECORD_IS(gpu_triangle64, TRIANGLE64_WORDS)
GPU_RECORD_IS(gpu_sphere64, SPHERE64_WORDS)
GPU_RECORD_IS(gpu_normal64, NORMAL64_WORDS)
GPU_RECORD_IS(gpu_body64, BODY64_WORDS)
GPU_RECORD_IS(gpu_material64, MATERIAL64_WORDS)
GPU_RECORD_IS(gpu_light64, LIGHT64_WORDS)

#endif
