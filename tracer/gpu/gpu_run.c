#include "tracer/gpu/gpu_private.h"

bool gpu_record(struct gpu *gpu) {
    if (gpu->recording)
        return true;
    if (gpu->stuck || !gpu_wait(gpu, NULL))
        return false;
    VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                      .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    if (!gpu_check(gpu, gpu->vk.vkBeginCommandBuffer(gpu->commands, &begin), "vkBeginCommandBuffer"))
        return false;
    gpu->recording = true;
    gpu->recorded = 0;
    return true;
}

// A barrier between this stage's writes and everything after it: kernels, transfers, and the host's reads.
static void order(struct gpu *gpu, VkPipelineStageFlags stage, VkAccessFlags writes) {
    const VkMemoryBarrier barrier = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                     .srcAccessMask = writes,
                                     .dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT |
                                                      VK_ACCESS_TRANSFER_READ_BIT |
                                                      VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_HOST_READ_BIT};
    gpu->vk.vkCmdPipelineBarrier(gpu->commands, stage,
                                 VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT |
                                     VK_PIPELINE_STAGE_HOST_BIT,
                                 0, 1, &barrier, 0, NULL, 0, NULL);
}

bool gpu_dispatch_beside(struct gpu *gpu, struct gpu_program *program, uint32_t groups_x, uint32_t groups_y,
                         const void *push) {
    if (!gpu_record(gpu))
        return false;
    if (gpu->recorded++ == 0) {
        gpu->vk.vkCmdResetQueryPool(gpu->commands, gpu->queries, 0, 1);
        // After what was recorded before is done: the dispatches' time does not include copies and clears
        // either.
        gpu->vk.vkCmdWriteTimestamp(gpu->commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, gpu->queries, 0);
    }
    gpu->vk.vkCmdBindPipeline(gpu->commands, VK_PIPELINE_BIND_POINT_COMPUTE, program->compiled->pipeline);
    gpu->vk.vkCmdBindDescriptorSets(gpu->commands, VK_PIPELINE_BIND_POINT_COMPUTE, program->compiled->layout,
                                    0, 1, &program->set, 0, NULL);
    if (program->compiled->push_bytes)
        gpu->vk.vkCmdPushConstants(gpu->commands, program->compiled->layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                   program->compiled->push_bytes, push);
    gpu->vk.vkCmdDispatch(gpu->commands, groups_x, groups_y, 1);
    return true;
}

bool gpu_dispatch(struct gpu *gpu, struct gpu_program *program, uint32_t groups_x, uint32_t groups_y,
                  const void *push) {
    if (!gpu_dispatch_beside(gpu, program, groups_x, groups_y, push))
        return false;
    // The last dispatch's timestamp stays: the dispatches' time does not include copies after it.
    gpu->vk.vkCmdResetQueryPool(gpu->commands, gpu->queries, 1, 1);
    gpu->vk.vkCmdWriteTimestamp(gpu->commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, gpu->queries, 1);
    order(gpu, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT);
    return true;
}

void gpu_record_copy(struct gpu *gpu, VkBuffer from, VkBuffer to, VkBufferCopy region) {
    gpu->vk.vkCmdCopyBuffer(gpu->commands, from, to, 1, &region);
    order(gpu, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT);
}

bool gpu_copy(struct gpu *gpu, struct gpu_buffer *from, struct gpu_buffer *to, uint64_t bytes) {
    if (!gpu_record(gpu))
        return false;
    gpu_record_copy(gpu, from->buffer, to->buffer, (VkBufferCopy){.size = bytes});
    return true;
}

bool gpu_clear(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, uint64_t bytes) {
    if (!gpu_record(gpu))
        return false;
    gpu->vk.vkCmdFillBuffer(gpu->commands, buffer->buffer, offset, bytes, 0);
    order(gpu, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT);
    return true;
}

bool gpu_submit(struct gpu *gpu) {
    if (!gpu->recording)
        return true;
    gpu->recording = false;
    gpu->timed = gpu->recorded != 0;
    if (!gpu_check(gpu, gpu->vk.vkEndCommandBuffer(gpu->commands), "vkEndCommandBuffer"))
        return false;
    VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &gpu->commands};
    if (!gpu_check(gpu, gpu->vk.vkQueueSubmit(gpu->queue, 1, &submit, gpu->fence), "vkQueueSubmit")) {
        gpu_settle(gpu); // a lost device may have begun
        return false;
    }
    gpu->submitted = true;
    return true;
}

static bool read_times(struct gpu *gpu, double *seconds) {
    uint64_t times[2];
    if (!gpu_check(gpu,
                   gpu->vk.vkGetQueryPoolResults(gpu->device, gpu->queries, 0, 2, sizeof times, times,
                                                 sizeof times[0],
                                                 VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                   "vkGetQueryPoolResults"))
        return false;
    *seconds = (double)(times[1] - times[0]) * gpu->properties.limits.timestampPeriod * 1e-9;
    return true;
}

bool gpu_wait(struct gpu *gpu, double *seconds) {
    if (seconds)
        *seconds = 0;
    if (!gpu->submitted)
        return true;
    gpu->submitted = gpu->compiling = false;
    if (!gpu_check(gpu, gpu->vk.vkWaitForFences(gpu->device, 1, &gpu->fence, VK_TRUE, UINT64_MAX),
                   "vkWaitForFences")) {
        gpu_settle(gpu);
        return false;
    }
    if (!gpu_check(gpu, gpu->vk.vkResetFences(gpu->device, 1, &gpu->fence), "vkResetFences"))
        return false;
    return !seconds || !gpu->timed || read_times(gpu, seconds);
}

bool gpu_compile(struct gpu *gpu, struct gpu_program *program, const void *push) {
    gpu->compiling = gpu_dispatch(gpu, program, 0, 1, push) && gpu_submit(gpu);
    return gpu->compiling;
}
