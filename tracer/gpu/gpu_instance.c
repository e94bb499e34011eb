#include "core/heap.h"
#include "tracer/gpu/gpu_private.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SCREEN_EXTENSIONS_MAX = 15
};
static const char VALIDATION_LAYER[] = "VK_LAYER_KHRONOS_validation";

static VKAPI_ATTR VkBool32 VKAPI_CALL count_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                    VkDebugUtilsMessageTypeFlagsEXT types,
                                                    const VkDebugUtilsMessengerCallbackDataEXT *data,
                                                    void *user) {
    (void)severity;
    (void)types;
    (void)data;
    uint32_t *messages = user;
    ++*messages;
    return VK_FALSE;
}

static bool has_validation(void) {
    uint32_t count = 0;
    if (vkEnumerateInstanceLayerProperties(&count, NULL) != VK_SUCCESS || count == 0)
        return false;
    VkLayerProperties *layers = heap_zeroed(count, sizeof *layers);
    bool found = false;
    if (layers && vkEnumerateInstanceLayerProperties(&count, layers) >= VK_SUCCESS)
        for (uint32_t i = 0; i < count; i++)
            found |= strcmp(layers[i].layerName, VALIDATION_LAYER) == 0;
    free(layers);
    return found;
}

// A library also fails to open if the system has no memory for it.
static bool open_loader(void) {
    if (volkInitialize() == VK_SUCCESS)
        return true;
    void *library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    const char *why = library ? NULL : dlerror();
    if (library)
        return volkInitialize() == VK_SUCCESS;
    if (why && strstr(why, "memory")) // dlopen(3) has no other way to say so
        heap_exhausted(0);
    return false;
}

static enum gpu_status refuse(const char *call, VkResult result, char *error) {
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY)
        heap_exhausted(0);
    const bool memory = result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY;
    if (memory)
        snprintf(error, GPU_ERROR_BYTES, "%s: not enough memory to start Vulkan", call);
    else
        snprintf(error, GPU_ERROR_BYTES, "%s failed (VkResult %d)", call, (int)result);
    return memory ? GPU_NO_MEMORY : GPU_FAILED;
}

enum gpu_status gpu_instance_create(const struct gpu_options *options, struct gpu_instance *out,
                                    char *error) {
    static const struct gpu_options none;
    options = options ? options : &none;
    uint32_t *messages = options->validation_messages;
    *out = (struct gpu_instance){.messages = messages};
    if (!open_loader()) {
        snprintf(error, GPU_ERROR_BYTES, "the Vulkan loader (libvulkan.so.1) is not installed");
        return GPU_NO_LOADER;
    }
    const bool layered = options->validate && has_validation();
    VkDebugUtilsMessengerCreateInfoEXT messenger = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType =
            VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
        .pfnUserCallback = count_message,
        .pUserData = messages};
    const char *layers[] = {VALIDATION_LAYER};
    const char *extensions[1 + SCREEN_EXTENSIONS_MAX] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
    uint32_t extension_count = layered && messages;
    for (uint32_t i = 0; i < options->screen_extension_count && i < SCREEN_EXTENSIONS_MAX; i++)
        extensions[extension_count++] = options->screen_extensions[i];
    VkInstanceCreateInfo create = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                   .pNext = layered && messages ? &messenger : NULL,
                                   .pApplicationInfo =
                                       &(VkApplicationInfo){.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                                            .pApplicationName = "glint",
                                                            .apiVersion = VK_API_VERSION_1_2},
                                   .enabledLayerCount = layered,
                                   .ppEnabledLayerNames = layers,
                                   .enabledExtensionCount = extension_count,
                                   .ppEnabledExtensionNames = extensions};
    VkResult result = vkCreateInstance(&create, &gpu_memory, &out->handle);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
        snprintf(error, GPU_ERROR_BYTES, "no Vulkan driver is installed");
        return GPU_NO_DRIVER;
    }
    if (result != VK_SUCCESS)
        return refuse("vkCreateInstance", result, error);
    volkLoadInstanceOnly(out->handle);
    if (layered && messages) {
        out->destroy_messenger = vkDestroyDebugUtilsMessengerEXT;
        if (vkCreateDebugUtilsMessengerEXT(out->handle, &messenger, NULL, &out->messenger) != VK_SUCCESS)
            out->messenger = VK_NULL_HANDLE;
    }
    return GPU_OK;
}

void gpu_instance_finish(struct gpu_instance *instance) {
    if (!instance->handle)
        return;
    if (instance->messenger)
        instance->destroy_messenger(instance->handle, instance->messenger, NULL);
    vkDestroyInstance(instance->handle, &gpu_memory);
    *instance = (struct gpu_instance){0};
}

uint32_t gpu_compute_family(VkPhysicalDevice physical) {
    enum {
        MOST_FAMILIES = 64
    };
    VkQueueFamilyProperties families[MOST_FAMILIES];
    uint32_t count = MOST_FAMILIES;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    for (uint32_t i = 0; i < count; i++)
        if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT)
            return i;
    return UINT32_MAX;
}

static enum gpu_kind kind_of(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return GPU_DISCRETE;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return GPU_INTEGRATED;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return GPU_CPU;
    default:
        return GPU_VIRTUAL;
    }
}

static void describe(VkPhysicalDevice physical, uint32_t number, struct gpu_device_info *info) {
    VkPhysicalDeviceDriverProperties driver = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    vkGetPhysicalDeviceProperties(physical, &properties.properties);
    if (properties.properties.apiVersion >= VK_API_VERSION_1_2) {
        properties.pNext = &driver;
        vkGetPhysicalDeviceProperties2(physical, &properties);
    }
    *info = (struct gpu_device_info){.number = number,
                                     .kind = kind_of(properties.properties.deviceType),
                                     .storage_bytes = properties.properties.limits.maxStorageBufferRange};
    snprintf(info->name, sizeof info->name, "%s", properties.properties.deviceName);
    snprintf(info->driver, sizeof info->driver, "%s%s%s", driver.driverName, driver.driverInfo[0] ? ", " : "",
             driver.driverInfo);
    VkPhysicalDeviceFeatures features;
    vkGetPhysicalDeviceFeatures(physical, &features);
    info->has_double = features.shaderFloat64;
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    for (uint32_t i = 0; i < memory.memoryHeapCount; i++)
        if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) &&
            memory.memoryHeaps[i].size > info->memory_bytes)
            info->memory_bytes = memory.memoryHeaps[i].size;
}

static bool can_compute(VkPhysicalDevice physical) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    return properties.apiVersion >= VK_API_VERSION_1_1 && gpu_compute_family(physical) != UINT32_MAX;
}

// All devices that the loader knows.
static enum gpu_status list_all(const struct gpu_instance *instance, VkPhysicalDevice **handles,
                                uint32_t *count, char *error) {
    *handles = NULL;
    VkResult result = vkEnumeratePhysicalDevices(instance->handle, count, NULL);
    if (result == VK_SUCCESS && *count) {
        *handles = heap_zeroed(*count, sizeof **handles);
        result = *handles ? vkEnumeratePhysicalDevices(instance->handle, count, *handles)
                          : VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    return result < VK_SUCCESS ? refuse("vkEnumeratePhysicalDevices", result, error) : GPU_OK;
}

enum gpu_status gpu_instance_devices(const struct gpu_instance *instance, VkPhysicalDevice **handles,
                                     struct gpu_device_info **infos, uint32_t *count, char *error) {
    uint32_t all = 0, usable = 0, best = 0;
    *infos = NULL;
    *count = 0;
    const enum gpu_status status = list_all(instance, handles, &all, error);
    if (status != GPU_OK)
        return status;
    *infos = heap_zeroed(all + (size_t)1, sizeof **infos);
    for (uint32_t i = 0; *infos && i < all; i++) {
        if (!can_compute((*handles)[i]))
            continue;
        (*handles)[usable] = (*handles)[i];
        describe((*handles)[i], usable, &(*infos)[usable]);
        usable++;
    }
    for (uint32_t i = 1; i < usable; i++)
        if ((*infos)[i].kind < (*infos)[best].kind)
            best = i;
    *count = usable;
    if (usable == 0) {
        snprintf(error, GPU_ERROR_BYTES, "no Vulkan driver offers a device that can compute");
        return GPU_NO_DRIVER;
    }
    (*infos)[best].preferred = true;
    return GPU_OK;
}

enum gpu_status gpu_list(struct gpu_device_info *items, uint32_t capacity, uint32_t *count,
                         char error[GPU_ERROR_BYTES]) {
    *count = 0;
    struct gpu_instance instance;
    enum gpu_status status = gpu_instance_create(NULL, &instance, error);
    if (status != GPU_OK)
        return status;
    VkPhysicalDevice *handles;
    struct gpu_device_info *infos;
    status = gpu_instance_devices(&instance, &handles, &infos, count, error);
    for (uint32_t i = 0; i < *count && i < capacity; i++)
        items[i] = infos[i];
    free(handles);
    free(infos);
    gpu_instance_finish(&instance);
    return status;
}
