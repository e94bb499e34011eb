// Compiled kernels, which a gpu keeps: another scene with the same features compiles nothing.
#include "shaders/kernel.h"

#include "core/heap.h"
#include "tracer/gpu/gpu_private.h"

#include <spirv/unified1/spirv.h>
#include <stdlib.h>
#include <string.h>

// Numbers of the SPIR-V specification, section 3.
enum {
    SPIRV_HEADER_WORDS = 5,
    DOUBLE_BITS = 64,
};

// Whether an instruction requests something that the device does not support: one width of floats, or the
// whole feature.
static bool is_unknown(const struct gpu *gpu, const uint32_t *instruction) {
    static const char extension[] = "SPV_KHR_float_controls";
    const bool none = !gpu->preserves_nan && !gpu->preserves_nan64;
    switch (instruction[0] & 0xffff) {
    case SpvOpCapability:
        return none && instruction[1] == SpvCapabilitySignedZeroInfNanPreserve;
    case SpvOpExecutionMode:
        return instruction[2] == SpvExecutionModeSignedZeroInfNanPreserve &&
               !(instruction[3] == DOUBLE_BITS ? gpu->preserves_nan64 : gpu->preserves_nan);
    case SpvOpExtension:
        return none && strncmp((const char *)(instruction + 1), extension, sizeof extension) == 0;
    default:
        return false;
    }
}

// Removes from a module the requests that the device does not support; returns the number of words left.
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

static bool create_module(struct gpu *gpu, const struct gpu_program_source *source,
                          const struct gpu_pipeline *wanted, VkShaderModule *out, struct gpu_kept *kept) {
    uint32_t *spirv = kernel_inflate(source->kernel);
    if (!spirv) {
        gpu_fail(gpu, GPU_NO_MEMORY, "not enough memory");
        return false;
    }
    size_t words = drop_unknown(gpu, spirv, source->kernel->words);
    if (!gpu_prune(source, spirv, &words)) {
        free(spirv);
        gpu_fail(gpu, GPU_NO_MEMORY, "not enough memory");
        return false;
    }
    VkShaderModuleCreateInfo create = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                       .codeSize = words * sizeof *spirv,
                                       .pCode = spirv};
    const bool ok =
        gpu_check(gpu, gpu->vk.vkCreateShaderModule(gpu->device, &create, NULL, out), "vkCreateShaderModule");
    if (ok)
        *kept = gpu_keep_begin(gpu, wanted, spirv, words);
    free(spirv);
    return ok;
}

static bool create_layout(struct gpu *gpu, struct gpu_pipeline *made,
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
    if (!gpu_check(gpu, gpu->vk.vkCreateDescriptorSetLayout(gpu->device, &set, NULL, &made->set_layout),
                   "vkCreateDescriptorSetLayout"))
        return false;
    VkPushConstantRange push = {.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT, .size = source->push_bytes};
    VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                         .setLayoutCount = 1,
                                         .pSetLayouts = &made->set_layout,
                                         .pushConstantRangeCount = source->push_bytes != 0,
                                         .pPushConstantRanges = &push};
    return gpu_check(gpu, gpu->vk.vkCreatePipelineLayout(gpu->device, &layout, NULL, &made->layout),
                     "vkCreatePipelineLayout");
}

static bool create_pipeline(struct gpu *gpu, struct gpu_pipeline *made,
                            const struct gpu_program_source *source) {
    VkSpecializationMapEntry entries[GPU_CONSTANTS];
    for (uint32_t i = 0; i < source->constant_count; i++)
        entries[i] = (VkSpecializationMapEntry){i, i * (uint32_t)sizeof(uint32_t), sizeof(uint32_t)};
    VkSpecializationInfo constants = {.mapEntryCount = source->constant_count,
                                      .pMapEntries = entries,
                                      .dataSize = source->constant_count * sizeof(uint32_t),
                                      .pData = source->constants};
    VkShaderModule module;
    struct gpu_kept kept;
    if (!create_module(gpu, source, made, &module, &kept))
        return false;
    VkComputePipelineCreateInfo pipeline = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .flags = gpu->tells ? VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR : 0,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = module,
                  .pName = "main",
                  .pSpecializationInfo = &constants},
        .layout = made->layout};
    const VkResult result =
        gpu->vk.vkCreateComputePipelines(gpu->device, kept.cache, 1, &pipeline, NULL, &made->pipeline);
    gpu_keep_end(gpu, &kept, result == VK_SUCCESS);
    gpu->vk.vkDestroyShaderModule(gpu->device, module, NULL);
    return gpu_check(gpu, result, "vkCreateComputePipelines");
}

// Describes the pipeline that a source needs, to compare with `made`.
static void describe(const struct gpu_program_source *source, struct gpu_pipeline *made) {
    made->kernel = source->kernel;
    made->constant_count = source->constant_count;
    made->push_bytes = source->push_bytes;
    if (source->constant_count)
        memcpy(made->constants, source->constants, source->constant_count * sizeof *made->constants);
    for (uint32_t i = 0; i < GPU_BINDINGS; i++)
        made->types[i] = source->buffers[i] ? 1 + (uint32_t)source->buffers[i]->type : 0;
}

static bool is_same(const struct gpu_pipeline *a, const struct gpu_pipeline *b) {
    return a->kernel == b->kernel && a->constant_count == b->constant_count &&
           a->push_bytes == b->push_bytes && memcmp(a->constants, b->constants, sizeof a->constants) == 0 &&
           memcmp(a->types, b->types, sizeof a->types) == 0;
}

static void destroy(struct gpu *gpu, struct gpu_pipeline *pipeline) {
    gpu->vk.vkDestroyPipeline(gpu->device, pipeline->pipeline, NULL);
    gpu->vk.vkDestroyPipelineLayout(gpu->device, pipeline->layout, NULL);
    gpu->vk.vkDestroyDescriptorSetLayout(gpu->device, pipeline->set_layout, NULL);
    free(pipeline);
}

// Removes a matching pipeline from the list; NULL: none matches.
static struct gpu_pipeline *take(struct gpu *gpu, const struct gpu_pipeline *wanted) {
    for (struct gpu_pipeline **at = &gpu->pipelines; *at; at = &(*at)->next)
        if (is_same(*at, wanted)) {
            struct gpu_pipeline *found = *at;
            *at = found->next;
            return found;
        }
    return NULL;
}

// Drops the pipeline that has been idle longest.
static void drop_idle(struct gpu *gpu) {
    uint32_t idle = 0;
    for (struct gpu_pipeline **at = &gpu->pipelines; *at;) {
        struct gpu_pipeline *pipeline = *at;
        if (pipeline->users || ++idle <= GPU_PIPELINES_IDLE) {
            at = &pipeline->next;
            continue;
        }
        *at = pipeline->next;
        destroy(gpu, pipeline);
    }
}

static struct gpu_pipeline *make(struct gpu *gpu, const struct gpu_program_source *source,
                                 const struct gpu_pipeline *wanted) {
    struct gpu_pipeline *made = heap_alloc(sizeof *made);
    if (!made) {
        gpu_fail(gpu, GPU_NO_MEMORY, "not enough memory");
        return NULL;
    }
    *made = *wanted;
    if (create_layout(gpu, made, source) && create_pipeline(gpu, made, source)) {
        gpu->pipelines_made++;
        return made;
    }
    destroy(gpu, made);
    return NULL;
}

struct gpu_pipeline *gpu_pipeline_use(struct gpu *gpu, const struct gpu_program_source *source) {
    if (source->constant_count > GPU_CONSTANTS) {
        gpu_fail(gpu, GPU_FAILED, "a kernel with more than %d constants", GPU_CONSTANTS);
        return NULL;
    }
    struct gpu_pipeline wanted = {0};
    describe(source, &wanted);
    struct gpu_pipeline *pipeline = take(gpu, &wanted);
    if (!pipeline)
        pipeline = make(gpu, source, &wanted);
    if (!pipeline)
        return NULL;
    pipeline->next = gpu->pipelines;
    gpu->pipelines = pipeline;
    pipeline->users++;
    return pipeline;
}

void gpu_pipeline_leave(struct gpu *gpu, struct gpu_pipeline *pipeline) {
    if (!pipeline)
        return;
    pipeline->users--;
    drop_idle(gpu);
}

uint32_t gpu_pipelines_made(const struct gpu *gpu) {
    return gpu->pipelines_made;
}

void gpu_pipelines_destroy(struct gpu *gpu) {
    while (gpu->pipelines) {
        struct gpu_pipeline *next = gpu->pipelines->next;
        destroy(gpu, gpu->pipelines);
        gpu->pipelines = next;
    }
}
