// The device: found by what it can do, opened with what the pipeline needs.
#include "bench/pipeline/rt.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    DEVICES_MOST = 32,
    EXTENSIONS_MOST = 1024,
    FAMILIES_MOST = 64,
};

static const char *const extensions[] = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                         VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME,
                                         VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

enum {
    EXTENSION_COUNT = sizeof extensions / sizeof *extensions
};

bool rt_fail(struct rt *rt, const char *format, ...) {
    va_list args;
    va_start(args, format);
    vsnprintf(rt->error, sizeof rt->error, format, args);
    va_end(args);
    return false;
}

bool rt_check(struct rt *rt, VkResult result, const char *call) {
    return result == VK_SUCCESS || rt_fail(rt, "%s failed (VkResult %d)", call, (int)result);
}

static bool cannot(struct rt *rt, const char *why) {
    rt->cannot = true;
    return rt_fail(rt, "%s", why);
}

static bool open_instance(struct rt *rt) {
    if (volkInitialize() != VK_SUCCESS)
        return cannot(rt, "the Vulkan loader (libvulkan.so.1) is not installed");
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .pApplicationName = "glint bench",
                                           .apiVersion = VK_API_VERSION_1_2};
    const VkInstanceCreateInfo create = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                         .pApplicationInfo = &application};
    const VkResult result = vkCreateInstance(&create, NULL, &rt->instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        return cannot(rt, "no Vulkan driver is installed");
    if (!rt_check(rt, result, "vkCreateInstance"))
        return false;
    volkLoadInstanceOnly(rt->instance);
    return true;
}

// ---- which device

static uint32_t family_of(VkPhysicalDevice physical) {
    VkQueueFamilyProperties families[FAMILIES_MOST];
    uint32_t count = FAMILIES_MOST;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    for (uint32_t i = 0; i < count; i++)
        if ((families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) && families[i].timestampValidBits)
            return i;
    return UINT32_MAX;
}

static bool has_extensions(VkPhysicalDevice physical) {
    uint32_t count = EXTENSIONS_MOST, found = 0;
    VkExtensionProperties *all = calloc(EXTENSIONS_MOST, sizeof *all);
    if (all && vkEnumerateDeviceExtensionProperties(physical, NULL, &count, all) >= VK_SUCCESS)
        for (uint32_t i = 0; i < count; i++)
            for (uint32_t k = 0; k < EXTENSION_COUNT; k++)
                found += strcmp(all[i].extensionName, extensions[k]) == 0;
    free(all);
    return found == EXTENSION_COUNT;
}

static bool has_features(VkPhysicalDevice physical) {
    VkPhysicalDeviceBufferDeviceAddressFeatures address = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR tree = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR, .pNext = &address};
    VkPhysicalDeviceRayTracingPipelineFeaturesKHR rays = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR, .pNext = &tree};
    VkPhysicalDeviceFeatures2 features = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                          .pNext = &rays};
    vkGetPhysicalDeviceFeatures2(physical, &features);
    return address.bufferDeviceAddress && tree.accelerationStructure && rays.rayTracingPipeline;
}

static bool can(VkPhysicalDevice physical, const VkPhysicalDeviceProperties *properties) {
    return properties->apiVersion >= VK_API_VERSION_1_2 && family_of(physical) != UINT32_MAX &&
           has_extensions(physical) && has_features(physical);
}

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

// By number among all devices, or by a part of its name; an empty choice takes every one.
static bool is_wanted(const char *wanted, uint32_t number, const char *name) {
    if (!wanted || !*wanted)
        return true;
    const bool numbered = strspn(wanted, "0123456789") == strlen(wanted);
    return numbered ? strtoul(wanted, NULL, 10) == number : contains(name, wanted);
}

static bool choose(struct rt *rt, const char *wanted) {
    VkPhysicalDevice all[DEVICES_MOST];
    uint32_t count = DEVICES_MOST;
    if (vkEnumeratePhysicalDevices(rt->instance, &count, all) < VK_SUCCESS)
        return rt_fail(rt, "vkEnumeratePhysicalDevices failed");
    for (uint32_t i = 0; i < count; i++) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(all[i], &properties);
        if (!is_wanted(wanted, i, properties.deviceName) || !can(all[i], &properties))
            continue;
        rt->physical = all[i];
        rt->tick_seconds = 1e-9 * (double)properties.limits.timestampPeriod;
        snprintf(rt->name, sizeof rt->name, "%s", properties.deviceName);
        return true;
    }
    return cannot(rt, "no such device has VK_KHR_ray_tracing_pipeline");
}

// ---- the device

static void read_limits(struct rt *rt) {
    rt->family = family_of(rt->physical);
    rt->tree_limits = (VkPhysicalDeviceAccelerationStructurePropertiesKHR){
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
    rt->limits = (VkPhysicalDeviceRayTracingPipelinePropertiesKHR){
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR,
        .pNext = &rt->tree_limits};
    VkPhysicalDeviceProperties2 properties = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                              .pNext = &rt->limits};
    vkGetPhysicalDeviceProperties2(rt->physical, &properties);
    vkGetPhysicalDeviceMemoryProperties(rt->physical, &rt->memory);
}

static bool create_device(struct rt *rt) {
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                           .queueFamilyIndex = rt->family,
                                           .queueCount = 1,
                                           .pQueuePriorities = &priority};
    VkPhysicalDeviceBufferDeviceAddressFeatures address = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES,
        .bufferDeviceAddress = VK_TRUE};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR tree = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR,
        .pNext = &address,
        .accelerationStructure = VK_TRUE};
    VkPhysicalDeviceRayTracingPipelineFeaturesKHR rays = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR,
        .pNext = &tree,
        .rayTracingPipeline = VK_TRUE};
    const VkDeviceCreateInfo create = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                       .pNext = &rays,
                                       .queueCreateInfoCount = 1,
                                       .pQueueCreateInfos = &queue,
                                       .enabledExtensionCount = EXTENSION_COUNT,
                                       .ppEnabledExtensionNames = extensions};
    if (!rt_check(rt, vkCreateDevice(rt->physical, &create, NULL, &rt->device), "vkCreateDevice"))
        return false;
    volkLoadDeviceTable(&rt->vk, rt->device);
    rt->vk.vkGetDeviceQueue(rt->device, rt->family, 0, &rt->queue);
    return true;
}

static bool create_commands(struct rt *rt) {
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                          .queueFamilyIndex = rt->family};
    const VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    const VkQueryPoolCreateInfo queries = {.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                           .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                           .queryCount = 2};
    if (!rt_check(rt, rt->vk.vkCreateCommandPool(rt->device, &pool, NULL, &rt->pool), "vkCreateCommandPool"))
        return false;
    const VkCommandBufferAllocateInfo commands = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                  .commandPool = rt->pool,
                                                  .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                  .commandBufferCount = 1};
    return rt_check(rt, rt->vk.vkAllocateCommandBuffers(rt->device, &commands, &rt->commands),
                    "vkAllocateCommandBuffers") &&
           rt_check(rt, rt->vk.vkCreateFence(rt->device, &fence, NULL, &rt->fence), "vkCreateFence") &&
           rt_check(rt, rt->vk.vkCreateQueryPool(rt->device, &queries, NULL, &rt->queries),
                    "vkCreateQueryPool");
}

bool rt_open(struct rt *rt, const char *device) {
    *rt = (struct rt){.cannot = false};
    if (!open_instance(rt) || !choose(rt, device))
        return false;
    read_limits(rt);
    return create_device(rt) && create_commands(rt);
}

// ---- the end

static void close_device(struct rt *rt) {
    struct rt_buffer *const buffers[] = {&rt->vertices, &rt->indices, &rt->materials, &rt->colors,
                                         &rt->lights,   &rt->frame,   &rt->output,    &rt->read_back,
                                         &rt->low,      &rt->top,     &rt->instances, &rt->table};
    rt->vk.vkDeviceWaitIdle(rt->device);
    rt->vk.vkDestroyPipeline(rt->device, rt->pipeline, NULL);
    rt->vk.vkDestroyDescriptorPool(rt->device, rt->sets, NULL);
    rt->vk.vkDestroyPipelineLayout(rt->device, rt->layout, NULL);
    rt->vk.vkDestroyDescriptorSetLayout(rt->device, rt->set_layout, NULL);
    rt->vk.vkDestroyAccelerationStructureKHR(rt->device, rt->top_tree, NULL);
    rt->vk.vkDestroyAccelerationStructureKHR(rt->device, rt->low_tree, NULL);
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        rt_buffer_free(rt, buffers[i]);
    rt->vk.vkDestroyQueryPool(rt->device, rt->queries, NULL);
    rt->vk.vkDestroyFence(rt->device, rt->fence, NULL);
    rt->vk.vkDestroyCommandPool(rt->device, rt->pool, NULL);
    rt->vk.vkDestroyDevice(rt->device, NULL);
}

void rt_close(struct rt *rt) {
    if (rt->device)
        close_device(rt);
    if (rt->instance)
        vkDestroyInstance(rt->instance, NULL);
    rt->device = VK_NULL_HANDLE;
    rt->instance = VK_NULL_HANDLE;
}
