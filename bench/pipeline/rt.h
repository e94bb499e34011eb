// The vendor's ray-tracing pipeline (VK_KHR_ray_tracing_pipeline) over triangles: a device of its own, apart
// from glint's.
//
// Errors: functions give false, and rt->error has one line. Ownership: rt_close frees all; it takes a zeroed
// rt, and one that failed half-way. Sizes in bytes, times in seconds. Thread safety: one thread.
#ifndef GLINT_BENCH_PIPELINE_RT_H
#define GLINT_BENCH_PIPELINE_RT_H

#include "bench/pipeline/layout.h"

#include <stdbool.h>
#include <stdint.h>
#include <volk.h>

enum {
    RT_ERROR_BYTES = 512,
};

struct rt_buffer {
    VkBuffer buffer;
    VkDeviceMemory memory;
    VkDeviceAddress address;
    VkDeviceSize bytes;
    void *mapped; // NULL: on the device alone
};

// Triangles and what they look like.
struct rt_scene {
    const float *vertices;        // three each
    const uint32_t *indices;      // three a triangle
    const uint32_t *materials;    // one a triangle
    const float *colors, *lights; // words of four: layout.h
    uint32_t vertex_count, triangle_count, color_count, light_count;
    float frame[FRAME_WORDS][4];
};

enum rt_region {
    RT_RAYGEN,
    RT_MISS, // two: nothing is hit, and nothing is between
    RT_HIT,
    RT_REGIONS,
};

struct rt {
    char error[RT_ERROR_BYTES], name[VK_MAX_PHYSICAL_DEVICE_NAME_SIZE];
    bool cannot; // the error is that the device cannot, not that something failed
    VkInstance instance;
    VkPhysicalDevice physical;
    VkPhysicalDeviceRayTracingPipelinePropertiesKHR limits;
    VkPhysicalDeviceAccelerationStructurePropertiesKHR tree_limits;
    VkPhysicalDeviceMemoryProperties memory;
    double tick_seconds;
    uint32_t family;
    VkDevice device;
    struct VolkDeviceTable vk;
    VkQueue queue;
    VkCommandPool pool;
    VkCommandBuffer commands;
    VkFence fence;
    VkQueryPool queries; // before the rays, after them

    struct rt_buffer vertices, indices, materials, colors, lights, frame, output, read_back;
    struct rt_buffer low, top, instances; // trees
    VkAccelerationStructureKHR low_tree, top_tree;
    double build_seconds;

    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkDescriptorPool sets;
    VkDescriptorSet set;
    VkPipeline pipeline;
    struct rt_buffer table;
    VkStridedDeviceAddressRegionKHR regions[RT_REGIONS];
};

// `device`: as gpu_options.device; NULL or empty: the first that can.
bool rt_open(struct rt *rt, const char *device);
bool rt_load(struct rt *rt, const struct rt_scene *scene, uint32_t width, uint32_t height);
// width * height * 3 floats; seconds by the device's own clock.
bool rt_frame(struct rt *rt, uint32_t width, uint32_t height, float *rgb, double *seconds);
void rt_close(struct rt *rt);

// ---- what its files share

bool rt_fail(struct rt *rt, const char *format, ...) __attribute__((format(printf, 2, 3)));
// true: a success; else the error says which call failed.
bool rt_check(struct rt *rt, VkResult result, const char *call);
bool rt_begin(struct rt *rt);
// Submits what was recorded and waits for it.
bool rt_finish(struct rt *rt);
// `host`: the program can write and read it.
bool rt_buffer_make(struct rt *rt, struct rt_buffer *buffer, VkDeviceSize bytes, VkBufferUsageFlags usage,
                    bool host);
// The same on the device, filled.
bool rt_buffer_fill(struct rt *rt, struct rt_buffer *buffer, const void *data, VkDeviceSize bytes,
                    VkBufferUsageFlags usage);
void rt_buffer_free(struct rt *rt, struct rt_buffer *buffer);
bool rt_build(struct rt *rt, const struct rt_scene *scene);
bool rt_compile(struct rt *rt);

static inline VkDeviceSize rt_aligned(VkDeviceSize value, VkDeviceSize to) {
    return to > 1 ? (value + to - 1) / to * to : value;
}

#endif
