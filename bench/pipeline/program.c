// The pipeline, its shader binding table and its descriptors.
#include "bench/pipeline/rt.h"

#include "bench/pipeline/clear_rmiss.h"
#include "bench/pipeline/hit_rchit.h"
#include "bench/pipeline/miss_rmiss.h"
#include "bench/pipeline/trace_rgen.h"

#include <stdlib.h>
#include <string.h>

enum {
    STAGES = 4, // and groups: the ray generation shader, two miss shaders, the closest hit
    MISSES = 2,
};

static const struct {
    VkShaderStageFlagBits stage;
    const uint32_t *words;
    size_t bytes;
} stages[STAGES] = {
    {VK_SHADER_STAGE_RAYGEN_BIT_KHR, trace_rgen, sizeof trace_rgen},
    {VK_SHADER_STAGE_MISS_BIT_KHR, miss_rmiss, sizeof miss_rmiss},
    {VK_SHADER_STAGE_MISS_BIT_KHR, clear_rmiss, sizeof clear_rmiss},
    {VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR, hit_rchit, sizeof hit_rchit},
};

static VkDescriptorType type_of(uint32_t binding) {
    return binding == PIPELINE_SCENE   ? VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR
           : binding == PIPELINE_FRAME ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                       : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

static bool make_layout(struct rt *rt) {
    VkDescriptorSetLayoutBinding bindings[PIPELINE_BINDINGS];
    for (uint32_t i = 0; i < PIPELINE_BINDINGS; i++)
        bindings[i] = (VkDescriptorSetLayoutBinding){.binding = i,
                                                     .descriptorType = type_of(i),
                                                     .descriptorCount = 1,
                                                     .stageFlags = VK_SHADER_STAGE_RAYGEN_BIT_KHR};
    const VkDescriptorSetLayoutCreateInfo set = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                 .bindingCount = PIPELINE_BINDINGS,
                                                 .pBindings = bindings};
    if (!rt_check(rt, rt->vk.vkCreateDescriptorSetLayout(rt->device, &set, NULL, &rt->set_layout),
                  "vkCreateDescriptorSetLayout"))
        return false;
    const VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                               .setLayoutCount = 1,
                                               .pSetLayouts = &rt->set_layout};
    return rt_check(rt, rt->vk.vkCreatePipelineLayout(rt->device, &layout, NULL, &rt->layout),
                    "vkCreatePipelineLayout");
}

static bool make_set(struct rt *rt) {
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, 1},
                                          {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, PIPELINE_BINDINGS - 2}};
    const VkDescriptorPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                             .maxSets = 1,
                                             .poolSizeCount = sizeof sizes / sizeof *sizes,
                                             .pPoolSizes = sizes};
    if (!rt_check(rt, rt->vk.vkCreateDescriptorPool(rt->device, &pool, NULL, &rt->sets),
                  "vkCreateDescriptorPool"))
        return false;
    const VkDescriptorSetAllocateInfo allocate = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                                  .descriptorPool = rt->sets,
                                                  .descriptorSetCount = 1,
                                                  .pSetLayouts = &rt->set_layout};
    return rt_check(rt, rt->vk.vkAllocateDescriptorSets(rt->device, &allocate, &rt->set),
                    "vkAllocateDescriptorSets");
}

static void bind_buffers(struct rt *rt) {
    const struct rt_buffer *const buffers[PIPELINE_BINDINGS] = {
        [PIPELINE_OUTPUT] = &rt->output,   [PIPELINE_FRAME] = &rt->frame,
        [PIPELINE_LIGHTS] = &rt->lights,   [PIPELINE_VERTICES] = &rt->vertices,
        [PIPELINE_INDICES] = &rt->indices, [PIPELINE_MATERIALS] = &rt->materials,
        [PIPELINE_COLORS] = &rt->colors,
    };
    const VkWriteDescriptorSetAccelerationStructureKHR tree = {
        .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR,
        .accelerationStructureCount = 1,
        .pAccelerationStructures = &rt->top_tree};
    VkDescriptorBufferInfo infos[PIPELINE_BINDINGS];
    VkWriteDescriptorSet writes[PIPELINE_BINDINGS];
    for (uint32_t i = 0; i < PIPELINE_BINDINGS; i++) {
        infos[i] = (VkDescriptorBufferInfo){.buffer = buffers[i] ? buffers[i]->buffer : VK_NULL_HANDLE,
                                            .range = VK_WHOLE_SIZE};
        writes[i] = (VkWriteDescriptorSet){.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                           .pNext = i == PIPELINE_SCENE ? &tree : NULL,
                                           .dstSet = rt->set,
                                           .dstBinding = i,
                                           .descriptorCount = 1,
                                           .descriptorType = type_of(i),
                                           .pBufferInfo = i == PIPELINE_SCENE ? NULL : &infos[i]};
    }
    rt->vk.vkUpdateDescriptorSets(rt->device, PIPELINE_BINDINGS, writes, 0, NULL);
}

// ---- the pipeline

static VkRayTracingShaderGroupCreateInfoKHR group_of(uint32_t stage) {
    const bool is_hit = stages[stage].stage == VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR;
    return (VkRayTracingShaderGroupCreateInfoKHR){
        .sType = VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR,
        .type = is_hit ? VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR
                       : VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR,
        .generalShader = is_hit ? VK_SHADER_UNUSED_KHR : stage,
        .closestHitShader = is_hit ? stage : VK_SHADER_UNUSED_KHR,
        .anyHitShader = VK_SHADER_UNUSED_KHR,
        .intersectionShader = VK_SHADER_UNUSED_KHR};
}

static bool make_pipeline(struct rt *rt) {
    VkPipelineShaderStageCreateInfo parts[STAGES] = {{0}};
    VkRayTracingShaderGroupCreateInfoKHR groups[STAGES];
    bool good = true;
    for (uint32_t i = 0; i < STAGES; i++) {
        const VkShaderModuleCreateInfo module = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                                 .codeSize = stages[i].bytes,
                                                 .pCode = stages[i].words};
        parts[i] =
            (VkPipelineShaderStageCreateInfo){.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                              .stage = stages[i].stage,
                                              .pName = "main"};
        good = good && rt_check(rt, rt->vk.vkCreateShaderModule(rt->device, &module, NULL, &parts[i].module),
                                "vkCreateShaderModule");
        groups[i] = group_of(i);
    }
    const VkRayTracingPipelineCreateInfoKHR create = {
        .sType = VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR,
        .stageCount = STAGES,
        .pStages = parts,
        .groupCount = STAGES,
        .pGroups = groups,
        .maxPipelineRayRecursionDepth = 1,
        .layout = rt->layout};
    good = good && rt_check(rt,
                            rt->vk.vkCreateRayTracingPipelinesKHR(rt->device, VK_NULL_HANDLE, VK_NULL_HANDLE,
                                                                  1, &create, NULL, &rt->pipeline),
                            "vkCreateRayTracingPipelinesKHR");
    for (uint32_t i = 0; i < STAGES; i++)
        rt->vk.vkDestroyShaderModule(rt->device, parts[i].module, NULL);
    return good;
}

// ---- the shader binding table

// Regions begin at multiples of the base alignment; handles within one are apart by multiples of theirs.
static bool make_table(struct rt *rt) {
    const uint32_t handle = rt->limits.shaderGroupHandleSize;
    const VkDeviceSize base = rt->limits.shaderGroupBaseAlignment;
    const VkDeviceSize stride = rt_aligned(handle, rt->limits.shaderGroupHandleAlignment);
    const VkDeviceSize room = rt_aligned(stride * MISSES, base);
    // The buffer may begin anywhere: `base` more lets the table begin where it must.
    const VkDeviceSize bytes = RT_REGIONS * room + base;
    unsigned char *handles = calloc(STAGES, handle), *table = calloc(1, bytes);
    bool good = handles && table;
    good = (good || rt_fail(rt, "not enough memory")) &&
           rt_check(rt,
                    rt->vk.vkGetRayTracingShaderGroupHandlesKHR(rt->device, rt->pipeline, 0, STAGES,
                                                                (size_t)STAGES * handle, handles),
                    "vkGetRayTracingShaderGroupHandlesKHR") &&
           rt_buffer_make(rt, &rt->table, bytes, VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR, true);
    if (good) {
        const VkDeviceSize skip = rt_aligned(rt->table.address, base) - rt->table.address;
        uint32_t next = 0;
        for (uint32_t region = 0; region < RT_REGIONS; region++) {
            const uint32_t count = region == RT_MISS ? MISSES : 1;
            const VkDeviceSize step = region == RT_RAYGEN ? room : stride; // its size must be its stride
            for (uint32_t i = 0; i < count; i++, next++)
                memcpy(table + skip + region * room + i * step, handles + (size_t)next * handle, handle);
            rt->regions[region] = (VkStridedDeviceAddressRegionKHR){
                rt->table.address + skip + region * room, step, region == RT_RAYGEN ? room : count * stride};
        }
        memcpy(rt->table.mapped, table, bytes);
    }
    free(handles);
    free(table);
    return good;
}

bool rt_compile(struct rt *rt) {
    if (!make_layout(rt) || !make_set(rt) || !make_pipeline(rt) || !make_table(rt))
        return false;
    bind_buffers(rt);
    return true;
}
