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

#endif
