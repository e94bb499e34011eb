// What went wrong on a device: the status and message of the last failed call.
#include "core/heap.h"
#include "tracer/gpu/gpu_private.h"

#include <stdarg.h>
#include <stdio.h>

void gpu_fail(struct gpu *gpu, enum gpu_status status, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(gpu->error, sizeof gpu->error, format, arguments);
    va_end(arguments);
    gpu->status = status;
}

bool gpu_check(struct gpu *gpu, VkResult result, const char *call) {
    if (result >= VK_SUCCESS)
        return true;
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY)
        heap_exhausted(0);
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
        gpu_fail(gpu, GPU_NO_MEMORY, "%s: not enough memory on %s", call, gpu->info.name);
    else if (result == VK_ERROR_DEVICE_LOST)
        gpu_fail(gpu, GPU_LOST, "%s: %s stopped answering", call, gpu->info.name);
    else
        gpu_fail(gpu, GPU_FAILED, "%s failed on %s (VkResult %d)", call, gpu->info.name, (int)result);
    return false;
}

// ---- what is kept

#define EACH_OBJECT(X)                                                                                       \
    X(vkDestroyBuffer, VkBuffer)                                                                             \
    X(vkDestroyBufferView, VkBufferView)                                                                     \
    X(vkFreeMemory, VkDeviceMemory)                                                                          \
    X(vkDestroyShaderModule, VkShaderModule)                                                                 \
    X(vkDestroyPipeline, VkPipeline)                                                                         \
    X(vkDestroyPipelineLayout, VkPipelineLayout)                                                             \
    X(vkDestroyPipelineCache, VkPipelineCache)                                                               \
    X(vkDestroyDescriptorPool, VkDescriptorPool)                                                             \
    X(vkDestroyDescriptorSetLayout, VkDescriptorSetLayout)                                                   \
    X(vkDestroyQueryPool, VkQueryPool)                                                                       \
    X(vkDestroyFence, VkFence)                                                                               \
    X(vkDestroyCommandPool, VkCommandPool)

#define KEEP(call, type)                                                                                     \
    static VKAPI_ATTR void VKAPI_CALL keep_##call(VkDevice device, type object,                              \
                                                  const VkAllocationCallbacks *memory) {                     \
        (void)device;                                                                                        \
        (void)object;                                                                                        \
        (void)memory;                                                                                        \
    }
EACH_OBJECT(KEEP)

static VKAPI_ATTR void VKAPI_CALL keep_device(VkDevice device, const VkAllocationCallbacks *memory) {
    (void)device;
    (void)memory;
}

// Whoever destroys something looks up the function in this table.
static void keep_all(struct gpu *gpu) {
#define EXCHANGE(call, type) gpu->vk.call = keep_##call;
    EACH_OBJECT(EXCHANGE)
    gpu->vk.vkDestroyDevice = keep_device;
    gpu->stuck = true;
}

void gpu_settle(struct gpu *gpu) {
    if (!gpu->stuck && gpu->vk.vkDeviceWaitIdle(gpu->device) != VK_SUCCESS)
        keep_all(gpu);
}

const char *gpu_error(const struct gpu *gpu) {
    return gpu->error;
}
enum gpu_status gpu_last_status(const struct gpu *gpu) {
    return gpu->status;
}
