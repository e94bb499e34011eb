// Inside of tracer/gpu: what its files share. Thread safety: as gpu.h.
#ifndef GLINT_TRACER_GPU_GPU_PRIVATE_H
#define GLINT_TRACER_GPU_GPU_PRIVATE_H

#include "tracer/gpu/gpu.h"

#include <volk.h>

// A Vulkan instance with its resources: to open a device, or only to list devices.
struct gpu_instance {
    VkInstance handle;
    VkDebugUtilsMessengerEXT messenger;
    PFN_vkDestroyDebugUtilsMessengerEXT destroy_messenger; // volk's may be that of another instance
    uint32_t *messages;                                    // not owned, may be NULL
};

struct gpu {
    struct gpu_instance instance;
    struct gpu_device_info info;
    VkPhysicalDevice physical;
    VkPhysicalDeviceProperties properties;
    VkPhysicalDeviceMemoryProperties memory;
    bool texels;          // GPU_WORDS are uniform texel buffers
    bool preserves_nan;   // SignedZeroInfNanPreserve for 32-bit floats
    bool preserves_nan64; // and for 64-bit ones
    bool tells;           // compiled kernels can be asked about
    bool shows;           // it can have screens
    uint32_t queue_family;
    VkDevice device;
    struct VolkDeviceTable vk;
    VkQueue queue;
    VkCommandPool pool;
    VkCommandBuffer commands;
    VkFence fence;
    VkQueryPool queries;            // 0: first start, 1: last end
    VkPipelineCache cache;          // of this run
    struct gpu_keep keep;           // from run to run; zeroed: nowhere
    struct gpu_pipeline *pipelines; // all of them, the one used last first
    uint32_t pipelines_made;
    bool recording, submitted, timed;
    bool compiling;             // the submitted work touches no buffer
    bool stuck;                 // the submitted work may run for ever: all that it uses is kept
    uint32_t recorded;          // dispatches since the recording began
    struct gpu_buffer *staging; // grown as needed; NULL at first
    enum gpu_status status;
    char error[GPU_ERROR_BYTES];
};

struct gpu_buffer {
    VkBuffer buffer;
    VkDeviceMemory memory;
    VkBufferView view; // texels only
    VkDescriptorType type;
    uint64_t bytes; // as asked for
    uint64_t size;  // rounded up
    void *mapped;   // NULL: reached through the staging buffer
};

enum {
    GPU_CONSTANTS = 32,     // of a kernel, at most
    GPU_PIPELINES_IDLE = 64 // kept although no program uses them
};

// A compiled kernel: shared by programs with the same kernel, constants and kinds of buffers.
struct gpu_pipeline {
    struct gpu_pipeline *next; // in the order in which they were used last
    const struct kernel *kernel;
    uint32_t constants[GPU_CONSTANTS];
    uint32_t constant_count, push_bytes;
    uint32_t types[GPU_BINDINGS]; // 1 + VkDescriptorType; 0: no such binding
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkPipeline pipeline;
    uint32_t users; // programs
};

struct gpu_program {
    struct gpu_pipeline *compiled;
    VkDescriptorPool pool;
    VkDescriptorSet set;
};

// `options` NULL: without validation and screen.
enum gpu_status gpu_instance_create(const struct gpu_options *options, struct gpu_instance *out, char *error);
void gpu_instance_finish(struct gpu_instance *instance);
// Devices that can compute, in the loader's order, and their descriptions; the caller frees both in any case.
// GPU_OK: *count is at least one. Else `error` gets text.
enum gpu_status gpu_instance_devices(const struct gpu_instance *instance, VkPhysicalDevice **handles,
                                     struct gpu_device_info **infos, uint32_t *count, char *error);
// Family of a queue that computes; UINT32_MAX where there is none.
uint32_t gpu_compute_family(VkPhysicalDevice physical);

// ---- gpu_memory.c

// For objects created with the instance; destroyed with the same callbacks.
extern const VkAllocationCallbacks gpu_memory;

// ---- gpu_fault.c

// Notes a failed call; returns true if `result` is a success.
bool gpu_check(struct gpu *gpu, VkResult result, const char *call);
void gpu_fail(struct gpu *gpu, enum gpu_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
// After a failure with work in flight: waits until the device is idle. If that fails too, nothing that the
// work may use is destroyed from then on; the end of the process frees it.
void gpu_settle(struct gpu *gpu);

// ---- gpu_prune.c

// Removes from a module of `*words` words what the source's constants switch off, and gives it one form with
// the constants' values in it: what a module lacks and what is taken out of it leave the same words. The
// kernel computes the same. A module that it does not understand stays as it is, so the constants must still
// be given. false: no memory.
bool gpu_prune(const struct gpu_program_source *source, uint32_t *spirv, size_t *words);

// ---- gpu_pipeline.c

// The kernel compiled for the source, now or before; NULL on failure. Return it with gpu_pipeline_leave.
struct gpu_pipeline *gpu_pipeline_use(struct gpu *gpu, const struct gpu_program_source *source);
void gpu_pipeline_leave(struct gpu *gpu, struct gpu_pipeline *pipeline); // NULL does nothing
void gpu_pipelines_destroy(struct gpu *gpu);                             // no program may be left

// ---- gpu_tell.c

bool gpu_has_extension(VkPhysicalDevice physical, const char *name);
// Whether the device can be asked about its kernels.
bool gpu_can_tell(VkPhysicalDevice physical);

// ---- gpu_keep.c

// A cache for one kernel, with what an earlier run kept; the gpu's own cache if nothing is kept. `spirv` is
// the code to compile.
struct gpu_kept {
    VkPipelineCache cache;
    uint64_t key[2];
    bool owned, found;
};
struct gpu_kept gpu_keep_begin(struct gpu *gpu, const struct gpu_pipeline *wanted, const uint32_t *spirv,
                               size_t words);
// After compiling, whether it succeeded or not.
void gpu_keep_end(struct gpu *gpu, const struct gpu_kept *kept, bool compiled);

// ---- gpu_run.c

// Begins a recording unless one is in progress.
bool gpu_record(struct gpu *gpu);
// Records a copy and the barrier for what comes after it. A recording is in progress.
void gpu_record_copy(struct gpu *gpu, VkBuffer from, VkBuffer to, VkBufferCopy region);

#endif
