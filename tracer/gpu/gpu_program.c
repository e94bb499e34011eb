#include "core/heap.h"
#include "tracer/gpu/gpu_private.h"

#include <stdlib.h>

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
                                            .pSetLayouts = &program->compiled->set_layout};
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

struct gpu_program *gpu_program_create(struct gpu *gpu, const struct gpu_program_source *source) {
    struct gpu_program *program = heap_zeroed(1, sizeof *program);
    if (!program) {
        gpu_fail(gpu, GPU_NO_MEMORY, "not enough memory");
        return NULL;
    }
    program->compiled = gpu_pipeline_use(gpu, source);
    if (program->compiled && create_set(gpu, program, source))
        return program;
    gpu_program_destroy(gpu, program);
    return NULL;
}

void gpu_program_destroy(struct gpu *gpu, struct gpu_program *program) {
    if (!program)
        return;
    gpu_wait(gpu, NULL);
    gpu->vk.vkDestroyDescriptorPool(gpu->device, program->pool, NULL);
    gpu_pipeline_leave(gpu, program->compiled);
    free(program);
}
