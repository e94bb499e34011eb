// Buffers with an address on the device, and work that is waited for.
#include "bench/pipeline/rt.h"

#include <string.h>

static const uint64_t WAIT_NS = 60000000000U;

bool rt_begin(struct rt *rt) {
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    if (!rt_check(rt, rt->vk.vkBeginCommandBuffer(rt->commands, &begin), "vkBeginCommandBuffer"))
        return false;
    // What earlier submissions wrote is seen by this one.
    const VkMemoryBarrier memory = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                    .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
                                    .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT};
    rt->vk.vkCmdPipelineBarrier(rt->commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &memory, 0, NULL, 0, NULL);
    return true;
}

bool rt_finish(struct rt *rt) {
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &rt->commands};
    return rt_check(rt, rt->vk.vkEndCommandBuffer(rt->commands), "vkEndCommandBuffer") &&
           rt_check(rt, rt->vk.vkQueueSubmit(rt->queue, 1, &submit, rt->fence), "vkQueueSubmit") &&
           rt_check(rt, rt->vk.vkWaitForFences(rt->device, 1, &rt->fence, VK_TRUE, WAIT_NS),
                    "vkWaitForFences") &&
           rt_check(rt, rt->vk.vkResetFences(rt->device, 1, &rt->fence), "vkResetFences");
}

static uint32_t memory_type(const struct rt *rt, uint32_t allowed, VkMemoryPropertyFlags wanted) {
    for (uint32_t i = 0; i < rt->memory.memoryTypeCount; i++)
        if ((allowed & (1U << i)) && (rt->memory.memoryTypes[i].propertyFlags & wanted) == wanted)
            return i;
    return UINT32_MAX;
}

static bool allocate(struct rt *rt, struct rt_buffer *buffer, bool host) {
    VkMemoryRequirements needs;
    rt->vk.vkGetBufferMemoryRequirements(rt->device, buffer->buffer, &needs);
    const VkMemoryPropertyFlags visible =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    // Memory that is cached for the processor is read many times faster, where there is such.
    uint32_t type = memory_type(rt, needs.memoryTypeBits,
                                host ? visible | VK_MEMORY_PROPERTY_HOST_CACHED_BIT
                                     : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (type == UINT32_MAX)
        type = memory_type(rt, needs.memoryTypeBits, host ? visible : 0);
    if (type == UINT32_MAX)
        return rt_fail(rt, "the device has no memory of a kind that is needed");
    const VkMemoryAllocateFlagsInfo flags = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                             .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
    const VkMemoryAllocateInfo allocation = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                             .pNext = &flags,
                                             .allocationSize = needs.size,
                                             .memoryTypeIndex = type};
    return rt_check(rt, rt->vk.vkAllocateMemory(rt->device, &allocation, NULL, &buffer->memory),
                    "vkAllocateMemory") &&
           rt_check(rt, rt->vk.vkBindBufferMemory(rt->device, buffer->buffer, buffer->memory, 0),
                    "vkBindBufferMemory") &&
           (!host ||
            rt_check(rt, rt->vk.vkMapMemory(rt->device, buffer->memory, 0, VK_WHOLE_SIZE, 0, &buffer->mapped),
                     "vkMapMemory"));
}

bool rt_buffer_make(struct rt *rt, struct rt_buffer *buffer, VkDeviceSize bytes, VkBufferUsageFlags usage,
                    bool host) {
    *buffer = (struct rt_buffer){.bytes = bytes ? bytes : 4};
    const VkBufferCreateInfo create = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                       .size = buffer->bytes,
                                       .usage = usage | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT};
    if (!rt_check(rt, rt->vk.vkCreateBuffer(rt->device, &create, NULL, &buffer->buffer), "vkCreateBuffer") ||
        !allocate(rt, buffer, host))
        return false;
    const VkBufferDeviceAddressInfo address = {.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                               .buffer = buffer->buffer};
    buffer->address = rt->vk.vkGetBufferDeviceAddress(rt->device, &address);
    return true;
}

void rt_buffer_free(struct rt *rt, struct rt_buffer *buffer) {
    rt->vk.vkDestroyBuffer(rt->device, buffer->buffer, NULL);
    rt->vk.vkFreeMemory(rt->device, buffer->memory, NULL);
    *buffer = (struct rt_buffer){0};
}

bool rt_buffer_fill(struct rt *rt, struct rt_buffer *buffer, const void *data, VkDeviceSize bytes,
                    VkBufferUsageFlags usage) {
    struct rt_buffer staging;
    const bool made = rt_buffer_make(rt, &staging, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true) &&
                      rt_buffer_make(rt, buffer, bytes, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, false) &&
                      rt_begin(rt);
    if (made) {
        if (bytes)
            memcpy(staging.mapped, data, bytes);
        const VkBufferCopy copy = {.size = buffer->bytes};
        rt->vk.vkCmdCopyBuffer(rt->commands, staging.buffer, buffer->buffer, 1, &copy);
    }
    const bool done = made && rt_finish(rt);
    rt_buffer_free(rt, &staging);
    return done;
}
