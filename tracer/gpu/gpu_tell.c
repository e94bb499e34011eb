// A driver's figures about the kernels that it compiled.
#include "core/heap.h"
#include "tracer/gpu/gpu_private.h"

#include <stdlib.h>
#include <string.h>

bool gpu_has_extension(VkPhysicalDevice physical, const char *name) {
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physical, NULL, &count, NULL);
    VkExtensionProperties *items = heap_array(count + (size_t)1, sizeof *items);
    bool found = false;
    if (items && vkEnumerateDeviceExtensionProperties(physical, NULL, &count, items) == VK_SUCCESS)
        for (uint32_t i = 0; i < count; i++)
            found = found || strcmp(items[i].extensionName, name) == 0;
    free(items);
    return found;
}

bool gpu_can_tell(VkPhysicalDevice physical) {
    if (!gpu_has_extension(physical, VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME))
        return false;
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR tells = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR};
    VkPhysicalDeviceFeatures2 features = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                          .pNext = &tells};
    vkGetPhysicalDeviceFeatures2(physical, &features);
    return tells.pipelineExecutableInfo;
}

static double value_of(const VkPipelineExecutableStatisticKHR *figure) {
    switch (figure->format) {
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
        return figure->value.b32;
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
        return (double)figure->value.i64;
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
        return (double)figure->value.u64;
    default:
        return figure->value.f64;
    }
}

// A compute pipeline is one executable.
bool gpu_program_tell(struct gpu *gpu, const struct gpu_program *program, gpu_tell *tell, void *context) {
    enum {
        MOST_FIGURES = 64
    };
    VkPipelineExecutableStatisticKHR figures[MOST_FIGURES];
    const VkPipelineExecutableInfoKHR executable = {.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR,
                                                    .pipeline = program->compiled->pipeline};
    uint32_t count = MOST_FIGURES;
    for (uint32_t i = 0; i < MOST_FIGURES; i++)
        figures[i] =
            (VkPipelineExecutableStatisticKHR){.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR};
    if (!gpu->tells ||
        gpu->vk.vkGetPipelineExecutableStatisticsKHR(gpu->device, &executable, &count, figures) < VK_SUCCESS)
        return false;
    for (uint32_t i = 0; i < count; i++)
        tell(context, figures[i].name, value_of(&figures[i]));
    return count > 0;
}
