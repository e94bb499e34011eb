#include "core/heap.h"
#include "shaders/kernel.h"
#include "tracer/gpu/gpu_private.h"

#include <stdlib.h>
#include <string.h>

// Numbers of the SPIR-V specification, section 3.
enum {
    SPIRV_HEADER_WORDS = 5,
    OP_EXTENSION = 10,
    OP_EXECUTION_MODE = 16,
    OP_CAPABILITY = 17,
    CAPABILITY_SIGNED_ZERO_INF_NAN_PRESERVE = 4466,
    MODE_SIGNED_ZERO_INF_NAN_PRESERVE = 4461,
    DOUBLE_BITS = 64,
};

// Whether an instruction asks for what the device does not know: one width of floats, or all of it.
static bool is_unknown(const struct gpu *gpu, const uint32_t *instruction) {
    static const char extension[] = "SPV_KHR_float_controls";
    const bool none = !gpu->preserves_nan && !gpu->preserves_nan64;
    switch (instruction[0] & 0xffff) {
    case OP_CAPABILITY:
        return none && instruction[1] == CAPABILITY_SIGNED_ZERO_INF_NAN_PRESERVE;
    case OP_EXECUTION_MODE:
        return instruction[2] == MODE_SIGNED_ZERO_INF_NAN_PRESERVE &&
               !(instruction[3] == DOUBLE_BITS ? gpu->preserves_nan64 : gpu->preserves_nan);
    case OP_EXTENSION:
        return none && strncmp((const char *)(instruction + 1), extension, sizeof extension) == 0;
    default:
        return false;
    }
}

// Takes out of a module what it asks for and the device does not know; returns the number of words left.
static size_t drop_unknown(const struct gpu *gpu, uint32_t *spirv, size_t words) {
    size_t count = SPIRV_HEADER_WORDS;
    for (size_t at = SPIRV_HEADER_WORDS, length; at < words; at += length) {
        length = spirv[at] >> 16;
        if (is_unknown(gpu, spirv + at))
            continue;
        memmove(spirv + count, spirv + at, length * sizeof *spirv);
        count += length;
    }
    return count;
}

static bool create_module(struct gpu *gpu, const struct gpu_program_source *source, VkShaderModule *out) {
    uint32_t *spirv = kernel_inflate(source->kernel);
    if (!spirv) {
        gpu_fail(gpu, GPU_NO_MEMORY, "not enough memory");
        return false;
    }
    const size_t words = drop_unknown(gpu, spirv, source->kernel->words);
    VkShaderModuleCreateInfo create = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                       .codeSize = words * sizeof *spirv,
                                       .pCode = spirv};
    const bool ok =
        gpu_check(gpu, gpu->vk.vkCreateShaderModule(gpu->device, &create, NULL, out), "vkCreateShaderModule");
    free(spirv);
    return ok;
}

static bool create_layout(struct gpu *gpu, struct gpu_program *program,
                          const struct gpu_program_source *source) {
    VkDescriptorSetLayoutBinding bindings[GPU_BINDINGS];
    uint32_t count = 0;
    for (uint32_t i = 0; i < GPU_BINDINGS; i++)
        if (source->buffers[i])
            bindings[count++] = (VkDescriptorSetLayoutBinding){.binding = i,
                                                               .descriptorType = source->buffers[i]->type,
                                                               .descriptorCount = 1,
                                                               .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT};
    VkDescriptorSetLayoutCreateInfo set = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                           .bindingCount = count,
                                           .pBindings = bindings};
    if (!gpu_check(gpu, gpu->vk.vkCreateDescriptorSetLayout(gpu->device, &set, NULL, &program->set_layout),
                   "vkCreateDescriptorSetLayout"))
        return false;
    VkPushConstantRange push = {.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT, .size = source->push_bytes};
    VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                         .setLayoutCount = 1,
                                         .pSetLayouts = &program->set_layout,
                                         .pushConstantRangeCount = source->push_bytes != 0,
                                         .pPushConstantRanges = &push};
    return gpu_check(gpu, gpu->vk.vkCreatePipelineLayout(gpu->device, &layout, NULL, &program->layout),
                     "vkCreatePipelineLayout");
}

static bool create_set(struct gpu *gpu, struct gpu_program *program,
                       const struct gpu_program_source *source) {
    VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, GPU_BINDINGS},
                                    {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, GPU_BINDINGS},
                                    {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, GPU_BINDINGS}};
    VkDescriptorPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                       .maxSets = 1,
                                       .poolSizeCount = 3,
                                       .pPoolSizes = sizes};
    if (!gpu_check(gpu, gpu->vk.vkCreateDescriptorPool(gpu->device, &pool, NULL, &program->pool),
                   "vkCreateDescriptorPool"))
        return false;
    VkDescriptorSetAllocateInfo allocate = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                            .descriptorPool = program->pool,
                                            .descriptorSetCount = 1,
                                            .pSetLayouts = &program->set_layout};
    if (!gpu_check(gpu, gpu->vk.vkAllocateDescriptorSets(gpu->device, &allocate, &program->set),
                   "vkAllocateDescriptorSets"))
        return false;
    gpu_program_bind(gpu, program, source->buffers);
    return true;
}

void gpu_program_bind(struct gpu *gpu, struct gpu_program *program,
                      struct gpu_buffer *const buffers[GPU_BINDINGS]) {
    VkWriteDescriptorSet writes[GPU_BINDINGS];
    VkDescriptorBufferInfo infos[GPU_BINDINGS];
    uint32_t count = 0;
    for (uint32_t i = 0; i < GPU_BINDINGS; i++) {
        const struct gpu_buffer *buffer = buffers[i];
        if (!buffer)
            continue;
        infos[count] = (VkDescriptorBufferInfo){.buffer = buffer->buffer, .range = VK_WHOLE_SIZE};
        writes[count] = (VkWriteDescriptorSet){.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                               .dstSet = program->set,
                                               .dstBinding = i,
                                               .descriptorCount = 1,
                                               .descriptorType = buffer->type,
                                               .pBufferInfo = &infos[count],
                                               .pTexelBufferView = &buffer->view};
        count++;
    }
    gpu->vk.vkUpdateDescriptorSets(gpu->device, count, writes, 0, NULL);
}

static bool create_pipeline(struct gpu *gpu, struct gpu_program *program,
                            const struct gpu_program_source *source) {
    enum {
        MOST_CONSTANTS = 32
    };
    VkSpecializationMapEntry entries[MOST_CONSTANTS];
    if (source->constant_count > MOST_CONSTANTS) {
        gpu_fail(gpu, GPU_FAILED, "a kernel with more than %d constants", MOST_CONSTANTS);
        return false;
    }
    for (uint32_t i = 0; i < source->constant_count; i++)
        entries[i] = (VkSpecializationMapEntry){i, i * (uint32_t)sizeof(uint32_t), sizeof(uint32_t)};
    VkSpecializationInfo constants = {.mapEntryCount = source->constant_count,
                                      .pMapEntries = entries,
                                      .dataSize = source->constant_count * sizeof(uint32_t),
                                      .pData = source->constants};
    VkShaderModule module;
    if (!create_module(gpu, source, &module))
        return false;
    VkComputePipelineCreateInfo pipeline = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = module,
                  .pName = "main",
                  .pSpecializationInfo = &constants},
        .layout = program->layout};
    const VkResult result =
        gpu->vk.vkCreateComputePipelines(gpu->device, gpu->cache, 1, &pipeline, NULL, &program->pipeline);
    gpu->vk.vkDestroyShaderModule(gpu->device, module, NULL);
    return gpu_check(gpu, result, "vkCreateComputePipelines");
}

struct gpu_program *gpu_program_create(struct gpu *gpu, const struct gpu_program_source *source) {
    struct gpu_program *program = heap_zeroed(1, sizeof *program);
    if (!program) {
        gpu_fail(gpu, GPU_NO_MEMORY, "not enough memory");
        return NULL;
    }
    program->push_bytes = source->push_bytes;
    if (create_layout(gpu, program, source) && create_set(gpu, program, source) &&
        create_pipeline(gpu, program, source))
        return program;
    gpu_program_destroy(gpu, program);
    return NULL;
}

void gpu_program_destroy(struct gpu *gpu, struct gpu_program *program) {
    if (!program)
        return;
    gpu_wait(gpu, NULL);
    gpu->vk.vkDestroyPipeline(gpu->device, program->pipeline, NULL);
    gpu->vk.vkDestroyDescriptorPool(gpu->device, program->pool, NULL);
    gpu->vk.vkDestroyPipelineLayout(gpu->device, program->layout, NULL);
    gpu->vk.vkDestroyDescriptorSetLayout(gpu->device, program->set_layout, NULL);
    free(program);
}
