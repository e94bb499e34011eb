// Keeps compiled kernels between runs, through Vulkan's pipeline caches: one for each kernel and its
// constants, so entries never grow, and two programs that write at once write the same.
//
// A CPU device is left out: lavapipe's cache holds nothing but its header, and Mesa keeps compiled code
// itself.
#include "core/hash128.h"
#include "core/heap.h"
#include "tracer/gpu/gpu_private.h"

#include <stdlib.h>

// Everything by which a driver may distinguish kernels or devices.
static void key_of(const struct gpu *gpu, const struct gpu_pipeline *wanted, const uint32_t *spirv,
                   size_t words, uint64_t key[2]) {
    const VkPhysicalDeviceProperties *p = &gpu->properties;
    struct hash128 h;
    hash128_begin(&h);
    hash128_whole(&h, p->vendorID);
    hash128_whole(&h, p->deviceID);
    hash128_whole(&h, p->driverVersion);
    hash128_array(&h, p->pipelineCacheUUID, sizeof p->pipelineCacheUUID, 1);
    hash128_whole(&h, sizeof(void *));
    hash128_array(&h, spirv, words, sizeof *spirv);
    hash128_array(&h, wanted->constants, wanted->constant_count, sizeof *wanted->constants);
    hash128_whole(&h, wanted->push_bytes);
    hash128_array(&h, wanted->types, GPU_BINDINGS, sizeof *wanted->types);
    hash128_end(&h, key);
}

static VkPipelineCache make_cache(struct gpu *gpu, const void *bytes, size_t count) {
    const VkPipelineCacheCreateInfo create = {.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                              .initialDataSize = count,
                                              .pInitialData = bytes};
    VkPipelineCache cache;
    return gpu->vk.vkCreatePipelineCache(gpu->device, &create, NULL, &cache) == VK_SUCCESS ? cache
                                                                                           : VK_NULL_HANDLE;
}

struct gpu_kept gpu_keep_begin(struct gpu *gpu, const struct gpu_pipeline *wanted, const uint32_t *spirv,
                               size_t words) {
    struct gpu_kept kept = {.cache = gpu->cache};
    if (!gpu->keep.read)
        return kept;
    size_t count = 0;
    key_of(gpu, wanted, spirv, words, kept.key);
    void *bytes = gpu->keep.read(gpu->keep.context, kept.key, &count);
    const VkPipelineCache cache = make_cache(gpu, bytes, bytes ? count : 0);
    free(bytes);
    if (!cache)
        return kept;
    kept.cache = cache;
    kept.owned = true;
    kept.found = count > 0;
    return kept;
}

static void write_cache(struct gpu *gpu, const struct gpu_kept *kept) {
    size_t count = 0;
    if (gpu->vk.vkGetPipelineCacheData(gpu->device, kept->cache, &count, NULL) != VK_SUCCESS || count == 0 ||
        (count <= sizeof(VkPipelineCacheHeaderVersionOne) && !gpu->keep.always))
        return;
    void *bytes = heap_alloc(count);
    if (bytes && gpu->vk.vkGetPipelineCacheData(gpu->device, kept->cache, &count, bytes) == VK_SUCCESS)
        gpu->keep.write(gpu->keep.context, kept->key, bytes, count);
    free(bytes);
}

void gpu_keep_end(struct gpu *gpu, const struct gpu_kept *kept, bool compiled) {
    if (!kept->owned)
        return;
    if (compiled && !kept->found)
        write_cache(gpu, kept);
    gpu->vk.vkDestroyPipelineCache(gpu->device, kept->cache, NULL);
}
