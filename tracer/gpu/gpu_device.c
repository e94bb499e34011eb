#include "core/heap.h"
#include "tracer/gpu/gpu_private.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool contains(const char *text, const char *part) {
    const size_t length = strlen(part);
    for (; *text; text++) {
        size_t i = 0;
        while (i < length && tolower((unsigned char)text[i]) == tolower((unsigned char)part[i]))
            i++;
        if (i == length)
            return true;
    }
    return false;
}

static bool is_number(const char *text) {
    for (const char *at = text; *at; at++)
        if (!isdigit((unsigned char)*at))
            return false;
    return *text != 0;
}

// Returns `count` if nothing fits.
static uint32_t choose(const char *wanted, const struct gpu_device_info *infos, uint32_t count) {
    const bool any = !wanted || !*wanted, numbered = !any && is_number(wanted);
    const unsigned long number = numbered ? strtoul(wanted, NULL, 10) : 0;
    uint32_t best = count;
    for (uint32_t i = 0; i < count; i++) {
        if (numbered ? infos[i].number != number : !any && !contains(infos[i].name, wanted))
            continue;
        if (best == count || infos[i].kind < infos[best].kind)
            best = i;
    }
    return best;
}

static enum gpu_status choose_device(struct gpu *gpu, const char *wanted, char *error) {
    VkPhysicalDevice *handles;
    struct gpu_device_info *infos;
    uint32_t count;
    enum gpu_status status = gpu_instance_devices(&gpu->instance, &handles, &infos, &count, error);
    const uint32_t chosen = choose(wanted, infos, count);
    if (status == GPU_OK && chosen == count) {
        snprintf(error, GPU_ERROR_BYTES, "no Vulkan device matches '%s'", wanted);
        status = GPU_NO_DEVICE;
    } else if (status == GPU_OK) {
        gpu->physical = handles[chosen];
        gpu->info = infos[chosen];
    }
    free(handles);
    free(infos);
    return status;
}

static void read_properties(struct gpu *gpu, const struct gpu_options *options) {
    vkGetPhysicalDeviceProperties(gpu->physical, &gpu->properties);
    vkGetPhysicalDeviceMemoryProperties(gpu->physical, &gpu->memory);
    gpu->queue_family = gpu_compute_family(gpu->physical);
    gpu->texels = gpu->info.kind == GPU_CPU && !options->storage;
    gpu->tells = options->tells && gpu_can_tell(gpu->physical);
    gpu->shows =
        options->screen_extension_count && gpu_has_extension(gpu->physical, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    if (gpu->properties.apiVersion >= VK_API_VERSION_1_2) {
        VkPhysicalDeviceFloatControlsProperties controls = {
            .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES};
        VkPhysicalDeviceProperties2 properties = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                                  .pNext = &controls};
        vkGetPhysicalDeviceProperties2(gpu->physical, &properties);
        gpu->preserves_nan = controls.shaderSignedZeroInfNanPreserveFloat32;
        gpu->preserves_nan64 = controls.shaderSignedZeroInfNanPreserveFloat64;
    }
}

static bool create_device(struct gpu *gpu) {
    const char *extensions[2];
    uint32_t extension_count = 0;
    if (gpu->tells)
        extensions[extension_count++] = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
    if (gpu->shows)
        extensions[extension_count++] = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR tells = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR,
        .pipelineExecutableInfo = VK_TRUE};
    const float priority = 1;
    VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                     .queueFamilyIndex = gpu->queue_family,
                                     .queueCount = 1,
                                     .pQueuePriorities = &priority};
    // Every device has robust access; only kernels that fetch texels read past the end of a buffer.
    const VkPhysicalDeviceFeatures features = {.shaderFloat64 = gpu->info.has_double,
                                               .robustBufferAccess = gpu->texels};
    VkDeviceCreateInfo create = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                 .pNext = gpu->tells ? &tells : NULL,
                                 .queueCreateInfoCount = 1,
                                 .pQueueCreateInfos = &queue,
                                 .enabledExtensionCount = extension_count,
                                 .ppEnabledExtensionNames = extensions,
                                 .pEnabledFeatures = &features};
    if (!gpu_check(gpu, vkCreateDevice(gpu->physical, &create, NULL, &gpu->device), "vkCreateDevice"))
        return false;
    volkLoadDeviceTable(&gpu->vk, gpu->device);
    gpu->vk.vkGetDeviceQueue(gpu->device, gpu->queue_family, 0, &gpu->queue);
    VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                    .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                    .queueFamilyIndex = gpu->queue_family};
    if (!gpu_check(gpu, gpu->vk.vkCreateCommandPool(gpu->device, &pool, NULL, &gpu->pool),
                   "vkCreateCommandPool"))
        return false;
    VkCommandBufferAllocateInfo commands = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                            .commandPool = gpu->pool,
                                            .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                            .commandBufferCount = 1};
    VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkQueryPoolCreateInfo queries = {.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                     .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                     .queryCount = 2};
    VkPipelineCacheCreateInfo cache = {.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    return gpu_check(gpu, gpu->vk.vkAllocateCommandBuffers(gpu->device, &commands, &gpu->commands),
                     "vkAllocateCommandBuffers") &&
           gpu_check(gpu, gpu->vk.vkCreateFence(gpu->device, &fence, NULL, &gpu->fence), "vkCreateFence") &&
           gpu_check(gpu, gpu->vk.vkCreateQueryPool(gpu->device, &queries, NULL, &gpu->queries),
                     "vkCreateQueryPool") &&
           gpu_check(gpu, gpu->vk.vkCreatePipelineCache(gpu->device, &cache, NULL, &gpu->cache),
                     "vkCreatePipelineCache");
}

enum gpu_status gpu_create(const struct gpu_options *options, struct gpu **out, char error[GPU_ERROR_BYTES]) {
    *out = NULL;
    struct gpu *gpu = heap_zeroed(1, sizeof *gpu);
    if (!gpu) {
        snprintf(error, GPU_ERROR_BYTES, "not enough memory");
        return GPU_NO_MEMORY;
    }
    enum gpu_status status = gpu_instance_create(options, &gpu->instance, error);
    if (status == GPU_OK)
        status = choose_device(gpu, options->device, error);
    if (status == GPU_OK) {
        read_properties(gpu, options);
        if (gpu->info.kind != GPU_CPU || options->keep.always)
            gpu->keep = options->keep;
        if (!create_device(gpu)) {
            status = gpu->status;
            snprintf(error, GPU_ERROR_BYTES, "%s", gpu->error);
        }
    }
    if (status == GPU_OK)
        *out = gpu;
    else
        gpu_destroy(gpu);
    return status;
}

bool gpu_destroy(struct gpu *gpu) {
    if (!gpu)
        return true;
    if (gpu->device) {
        gpu_settle(gpu);
        gpu_buffer_destroy(gpu, gpu->staging);
        gpu_pipelines_destroy(gpu);
        gpu->vk.vkDestroyPipelineCache(gpu->device, gpu->cache, NULL);
        gpu->vk.vkDestroyQueryPool(gpu->device, gpu->queries, NULL);
        gpu->vk.vkDestroyFence(gpu->device, gpu->fence, NULL);
        gpu->vk.vkDestroyCommandPool(gpu->device, gpu->pool, NULL);
        gpu->vk.vkDestroyDevice(gpu->device, NULL);
    }
    const bool rests = !gpu->stuck;
    if (rests)
        gpu_instance_finish(&gpu->instance);
    free(gpu);
    return rests;
}

const struct gpu_device_info *gpu_info(const struct gpu *gpu) {
    return &gpu->info;
}
bool gpu_fetches_texels(const struct gpu *gpu) {
    return gpu->texels;
}
