// Frames: rays between two marks of the device's clock, then the picture to the host.
#include "bench/pipeline/rt.h"

bool rt_load(struct rt *rt, const struct rt_scene *scene, uint32_t width, uint32_t height) {
    const VkBufferUsageFlags read = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const VkBufferUsageFlags built =
        read | VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;
    const VkDeviceSize pixels = (VkDeviceSize)width * height, word = 4 * sizeof(float);
    if (scene->triangle_count > rt->tree_limits.maxPrimitiveCount ||
        pixels > rt->limits.maxRayDispatchInvocationCount)
        return rt_fail(rt, "the device takes fewer triangles or pixels");
    return rt_buffer_fill(rt, &rt->vertices, scene->vertices,
                          (VkDeviceSize)scene->vertex_count * 3 * sizeof(float), built) &&
           rt_buffer_fill(rt, &rt->indices, scene->indices,
                          (VkDeviceSize)scene->triangle_count * 3 * sizeof(uint32_t), built) &&
           rt_buffer_fill(rt, &rt->materials, scene->materials,
                          (VkDeviceSize)scene->triangle_count * sizeof(uint32_t), read) &&
           rt_buffer_fill(rt, &rt->colors, scene->colors, scene->color_count * word, read) &&
           rt_buffer_fill(rt, &rt->lights, scene->lights, 2 * scene->light_count * word, read) &&
           rt_buffer_fill(rt, &rt->frame, scene->frame, sizeof scene->frame,
                          VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT) &&
           rt_buffer_make(rt, &rt->output, pixels * word, read | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, false) &&
           rt_buffer_make(rt, &rt->read_back, pixels * word, VK_BUFFER_USAGE_TRANSFER_DST_BIT, true) &&
           rt_build(rt, scene) && rt_compile(rt);
}

static void barrier(struct rt *rt, VkPipelineStageFlags from, VkAccessFlags wrote, VkPipelineStageFlags to,
                    VkAccessFlags reads) {
    const VkMemoryBarrier memory = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER, .srcAccessMask = wrote, .dstAccessMask = reads};
    rt->vk.vkCmdPipelineBarrier(rt->commands, from, to, 0, 1, &memory, 0, NULL, 0, NULL);
}

static void record(struct rt *rt, uint32_t width, uint32_t height) {
    static const VkStridedDeviceAddressRegionKHR none = {0};
    const VkPipelineBindPoint point = VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR;
    const VkPipelineStageFlags rays = VK_PIPELINE_STAGE_RAY_TRACING_SHADER_BIT_KHR;
    rt->vk.vkCmdResetQueryPool(rt->commands, rt->queries, 0, 2);
    rt->vk.vkCmdBindPipeline(rt->commands, point, rt->pipeline);
    rt->vk.vkCmdBindDescriptorSets(rt->commands, point, rt->layout, 0, 1, &rt->set, 0, NULL);
    rt->vk.vkCmdWriteTimestamp(rt->commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, rt->queries, 0);
    rt->vk.vkCmdTraceRaysKHR(rt->commands, &rt->regions[RT_RAYGEN], &rt->regions[RT_MISS],
                             &rt->regions[RT_HIT], &none, width, height, 1);
    rt->vk.vkCmdWriteTimestamp(rt->commands, rays, rt->queries, 1);
    barrier(rt, rays, VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_TRANSFER_READ_BIT);
    const VkBufferCopy copy = {.size = rt->output.bytes};
    rt->vk.vkCmdCopyBuffer(rt->commands, rt->output.buffer, rt->read_back.buffer, 1, &copy);
    barrier(rt, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT,
            VK_ACCESS_HOST_READ_BIT);
}

bool rt_frame(struct rt *rt, uint32_t width, uint32_t height, float *rgb, double *seconds) {
    uint64_t marks[2];
    if (!rt_begin(rt))
        return false;
    record(rt, width, height);
    if (!rt_finish(rt) || !rt_check(rt,
                                    rt->vk.vkGetQueryPoolResults(
                                        rt->device, rt->queries, 0, 2, sizeof marks, marks, sizeof *marks,
                                        VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                                    "vkGetQueryPoolResults"))
        return false;
    *seconds = (double)(marks[1] - marks[0]) * rt->tick_seconds;
    const float *from = rt->read_back.mapped;
    for (size_t i = 0; i < (size_t)width * height; i++)
        for (size_t c = 0; c < 3; c++)
            rgb[3 * i + c] = from[4 * i + c];
    return true;
}
