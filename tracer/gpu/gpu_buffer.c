#include "core/heap.h"
#include "tracer/gpu/gpu_private.h"

#include <stdlib.h>
#include <string.h>

// lavapipe's compiler makes a variant of a kernel per size class of a texel buffer; sizes of one class share
// it (measured), and the odd 256 bytes avoid its power-of-two paths.
static const uint64_t TEXEL_QUANTUM = 65536, TEXEL_ODD = 256;
// Staged copies go in pieces of at most this size.
static const uint64_t STAGING_BYTES = 16u << 20;

static bool is_texels(const struct gpu *gpu, enum gpu_use use) {
    return use == GPU_TEXELS_U8 || use == GPU_TEXELS_F32 || (use == GPU_WORDS && gpu->texels);
}

static VkFormat format_of(enum gpu_use use) {
    if (use == GPU_TEXELS_U8)
        return VK_FORMAT_R8G8B8A8_UNORM;
    return use == GPU_TEXELS_F32 ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32G32B32A32_UINT;
}

static VkDescriptorType type_of(const struct gpu *gpu, enum gpu_use use) {
    if (is_texels(gpu, use))
        return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    return use == GPU_UNIFORM ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

static VkBufferUsageFlags usage_of(VkDescriptorType type) {
    const VkBufferUsageFlags copies = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER)
        return copies | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    return copies | (type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER ? VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT
                                                               : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

// The type of `allowed` with all `needed` flags and most of the `wanted` ones; UINT32_MAX if none.
static uint32_t memory_type(const struct gpu *gpu, uint32_t allowed, VkMemoryPropertyFlags needed,
                            VkMemoryPropertyFlags wanted) {
    uint32_t best = UINT32_MAX;
    int best_score = -1;
    for (uint32_t i = 0; i < gpu->memory.memoryTypeCount; i++) {
        const VkMemoryPropertyFlags flags = gpu->memory.memoryTypes[i].propertyFlags;
        if (!(allowed & (1u << i)) || (flags & needed) != needed)
            continue;
        int score = 0;
        for (VkMemoryPropertyFlags bit = 1; bit <= VK_MEMORY_PROPERTY_HOST_CACHED_BIT; bit <<= 1)
            score += (flags & wanted & bit) != 0;
        if (score > best_score) {
            best = i;
            best_score = score;
        }
    }
    return best;
}

static bool allocate(struct gpu *gpu, struct gpu_buffer *buffer, VkBufferUsageFlags usage, bool host) {
    VkBufferCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = buffer->size, .usage = usage};
    if (!gpu_check(gpu, gpu->vk.vkCreateBuffer(gpu->device, &create, NULL, &buffer->buffer),
                   "vkCreateBuffer"))
        return false;
    VkMemoryRequirements requirements;
    gpu->vk.vkGetBufferMemoryRequirements(gpu->device, buffer->buffer, &requirements);
    const VkMemoryPropertyFlags mappable =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    uint32_t type =
        host ? memory_type(gpu, requirements.memoryTypeBits, mappable, VK_MEMORY_PROPERTY_HOST_CACHED_BIT)
             : memory_type(gpu, requirements.memoryTypeBits, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (type == UINT32_MAX) {
        gpu_fail(gpu, GPU_FAILED, "%s has no memory for a buffer", gpu->info.name);
        return false;
    }
    VkMemoryAllocateInfo memory = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                   .allocationSize = requirements.size,
                                   .memoryTypeIndex = type};
    if (!gpu_check(gpu, gpu->vk.vkAllocateMemory(gpu->device, &memory, NULL, &buffer->memory),
                   "vkAllocateMemory") ||
        !gpu_check(gpu, gpu->vk.vkBindBufferMemory(gpu->device, buffer->buffer, buffer->memory, 0),
                   "vkBindBufferMemory"))
        return false;
    // Reading through a write-combined mapping is slow, so memory of the device is mapped only if it is
    // cached, as that of CPU devices is.
    const VkMemoryPropertyFlags flags = gpu->memory.memoryTypes[type].propertyFlags;
    const bool direct = host || (flags & (mappable | VK_MEMORY_PROPERTY_HOST_CACHED_BIT)) ==
                                    (mappable | VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
    if (!direct)
        return true;
    if (!gpu_check(gpu,
                   gpu->vk.vkMapMemory(gpu->device, buffer->memory, 0, VK_WHOLE_SIZE, 0, &buffer->mapped),
                   "vkMapMemory"))
        return false;
    if (gpu->info.kind == GPU_CPU)
        heap_expect(buffer->mapped, (size_t)requirements.size);
    return true;
}

static bool fits(struct gpu *gpu, const struct gpu_buffer *buffer, enum gpu_use use) {
    const VkPhysicalDeviceLimits *limits = &gpu->properties.limits;
    const uint64_t texel = use == GPU_TEXELS_U8 ? 4 : 16;
    uint64_t most = limits->maxStorageBufferRange;
    if (buffer->type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER)
        most = limits->maxTexelBufferElements * texel;
    else if (buffer->type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER)
        most = limits->maxUniformBufferRange;
    if (buffer->size <= most)
        return true;
    gpu_fail(gpu, GPU_NO_MEMORY, "a buffer of %llu MiB exceeds the %llu MiB that %s allows%s",
             (unsigned long long)(buffer->size >> 20), (unsigned long long)(most >> 20), gpu->info.name,
             use == GPU_WORDS
                 ? ": use smaller meshes, or models that share one; 'glint inspect' lists the buffers"
                 : "");
    return false;
}

struct gpu_buffer *gpu_buffer_create(struct gpu *gpu, enum gpu_use use, uint64_t bytes) {
    struct gpu_buffer *buffer = heap_zeroed(1, sizeof *buffer);
    if (!buffer) {
        gpu_fail(gpu, GPU_NO_MEMORY, "not enough memory");
        return NULL;
    }
    buffer->bytes = bytes;
    buffer->type = type_of(gpu, use);
    buffer->size = bytes < 16 ? 16 : (bytes + 15) / 16 * 16;
    if (is_texels(gpu, use))
        buffer->size = (bytes + TEXEL_QUANTUM - 1) / TEXEL_QUANTUM * TEXEL_QUANTUM + TEXEL_ODD;
    if (!fits(gpu, buffer, use) ||
        !allocate(gpu, buffer, usage_of(buffer->type), use == GPU_UNIFORM || use == GPU_HOST))
        goto failed;
    if (buffer->type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER) {
        VkBufferViewCreateInfo view = {.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                       .buffer = buffer->buffer,
                                       .format = format_of(use),
                                       .range = VK_WHOLE_SIZE};
        if (!gpu_check(gpu, gpu->vk.vkCreateBufferView(gpu->device, &view, NULL, &buffer->view),
                       "vkCreateBufferView"))
            goto failed;
    }
    return buffer;
failed:
    gpu_buffer_destroy(gpu, buffer);
    return NULL;
}

void gpu_buffer_destroy(struct gpu *gpu, struct gpu_buffer *buffer) {
    if (!buffer)
        return;
    gpu_wait(gpu, NULL);
    gpu->vk.vkDestroyBufferView(gpu->device, buffer->view, NULL);
    gpu->vk.vkDestroyBuffer(gpu->device, buffer->buffer, NULL);
    gpu->vk.vkFreeMemory(gpu->device, buffer->memory, NULL);
    free(buffer);
}

const void *gpu_contents(const struct gpu_buffer *buffer) {
    return buffer->mapped;
}

uint64_t gpu_buffer_bytes(const struct gpu_buffer *buffer) {
    return buffer->bytes;
}

static bool make_staging(struct gpu *gpu) {
    if (gpu->staging)
        return true;
    struct gpu_buffer *staging = heap_zeroed(1, sizeof *staging);
    if (!staging) {
        gpu_fail(gpu, GPU_NO_MEMORY, "not enough memory");
        return false;
    }
    staging->bytes = staging->size = STAGING_BYTES;
    gpu->staging = staging;
    if (allocate(gpu, staging, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, true))
        return true;
    gpu_buffer_destroy(gpu, staging);
    gpu->staging = NULL;
    return false;
}

static bool copy(struct gpu *gpu, VkBuffer from, uint64_t from_offset, VkBuffer to, uint64_t to_offset,
                 uint64_t bytes) {
    if (!gpu_record(gpu))
        return false;
    gpu_record_copy(gpu, from, to,
                    (VkBufferCopy){.srcOffset = from_offset, .dstOffset = to_offset, .size = bytes});
    return gpu_submit(gpu) && gpu_wait(gpu, NULL);
}

bool gpu_fill(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, uint64_t bytes, gpu_put *put,
              void *context) {
    if (bytes == 0)
        return true;
    if (!gpu->compiling && !gpu_wait(gpu, NULL))
        return false;
    if (buffer->mapped) {
        put(context, offset, (char *)buffer->mapped + offset, bytes);
        return true;
    }
    if (!make_staging(gpu))
        return false;
    for (uint64_t done = 0; done < bytes;) {
        const uint64_t piece = bytes - done < STAGING_BYTES ? bytes - done : STAGING_BYTES;
        put(context, offset + done, gpu->staging->mapped, piece);
        if (!copy(gpu, gpu->staging->buffer, 0, buffer->buffer, offset + done, piece))
            return false;
        done += piece;
    }
    return true;
}

struct written {
    const char *data;
    uint64_t offset;
};

static void put_written(void *context, uint64_t offset, void *to, uint64_t bytes) {
    const struct written *written = context;
    memcpy(to, written->data + (offset - written->offset), bytes);
}

bool gpu_write(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, const void *data,
               uint64_t bytes) {
    return gpu_fill(gpu, buffer, offset, bytes, put_written, &(struct written){data, offset});
}

bool gpu_read(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, void *data, uint64_t bytes) {
    if (bytes == 0)
        return true;
    if (!gpu_wait(gpu, NULL))
        return false;
    if (buffer->mapped) {
        memcpy(data, (const char *)buffer->mapped + offset, bytes);
        return true;
    }
    if (!make_staging(gpu))
        return false;
    for (uint64_t done = 0; done < bytes;) {
        const uint64_t piece = bytes - done < STAGING_BYTES ? bytes - done : STAGING_BYTES;
        if (!copy(gpu, buffer->buffer, offset + done, gpu->staging->buffer, 0, piece))
            return false;
        memcpy((char *)data + done, gpu->staging->mapped, piece);
        done += piece;
    }
    return true;
}
