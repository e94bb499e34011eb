#include "tracer/gpu/gpu_screen.h"

#include "core/heap.h"
#include "tracer/gpu/gpu_private.h"

#include <stdlib.h>
#include <string.h>

enum {
    FORMATS_MAX = 256,
    IMAGES_MAX = 16,
};

struct gpu_screen {
    VkSurfaceKHR surface;
    VkSwapchainKHR chain; // VK_NULL_HANDLE: there is none now
    VkSurfaceFormatKHR format;
    bool is_red_first; // of the format's bytes
    uint32_t width, height;
    VkImage images[IMAGES_MAX];
    uint32_t image_count;
    VkSemaphore acquired, drawn;
    VkFence done;
    VkCommandBuffer commands;
    struct gpu_buffer *pixels;
};

// ---- beginning and end

static bool choose_format(struct gpu *gpu, struct gpu_screen *screen) {
    VkSurfaceFormatKHR formats[FORMATS_MAX];
    uint32_t count = FORMATS_MAX;
    const VkResult result =
        vkGetPhysicalDeviceSurfaceFormatsKHR(gpu->physical, screen->surface, &count, formats);
    if (!gpu_check(gpu, result == VK_INCOMPLETE ? VK_SUCCESS : result,
                   "vkGetPhysicalDeviceSurfaceFormatsKHR"))
        return false;
    // Bytes are displayed colours already.
    for (uint32_t i = 0; i < count; i++)
        if (formats[i].format == VK_FORMAT_B8G8R8A8_UNORM || formats[i].format == VK_FORMAT_R8G8B8A8_UNORM) {
            screen->format = formats[i];
            screen->is_red_first = formats[i].format == VK_FORMAT_R8G8B8A8_UNORM;
            return true;
        }
    gpu_fail(gpu, GPU_FAILED, "%s shows no 8-bit colours in this window", gpu->info.name);
    return false;
}

static bool can_present(struct gpu *gpu, const struct gpu_screen *screen) {
    VkBool32 can = VK_FALSE;
    if (!gpu_check(
            gpu,
            vkGetPhysicalDeviceSurfaceSupportKHR(gpu->physical, gpu->queue_family, screen->surface, &can),
            "vkGetPhysicalDeviceSurfaceSupportKHR"))
        return false;
    if (!can)
        gpu_fail(gpu, GPU_FAILED, "%s cannot show pictures in this window", gpu->info.name);
    return can;
}

static bool make_signals(struct gpu *gpu, struct gpu_screen *screen) {
    const VkSemaphoreCreateInfo semaphore = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    const VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    const VkCommandBufferAllocateInfo commands = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                  .commandPool = gpu->pool,
                                                  .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                  .commandBufferCount = 1};
    return gpu_check(gpu, gpu->vk.vkCreateSemaphore(gpu->device, &semaphore, NULL, &screen->acquired),
                     "vkCreateSemaphore") &&
           gpu_check(gpu, gpu->vk.vkCreateSemaphore(gpu->device, &semaphore, NULL, &screen->drawn),
                     "vkCreateSemaphore") &&
           gpu_check(gpu, gpu->vk.vkCreateFence(gpu->device, &fence, NULL, &screen->done), "vkCreateFence") &&
           gpu_check(gpu, gpu->vk.vkAllocateCommandBuffers(gpu->device, &commands, &screen->commands),
                     "vkAllocateCommandBuffers");
}

struct gpu_screen *gpu_screen_create(struct gpu *gpu, gpu_make_surface *make, void *context) {
    struct gpu_screen *screen = gpu->shows ? heap_zeroed(1, sizeof *screen) : NULL;
    if (!screen) {
        gpu_fail(gpu, GPU_FAILED, "%s cannot show pictures in a window", gpu->info.name);
        return NULL;
    }
    bool made = make(context, gpu->instance.handle, &screen->surface);
    if (!made)
        gpu_fail(gpu, GPU_FAILED, "the window cannot show pictures of Vulkan");
    made = made && can_present(gpu, screen) && choose_format(gpu, screen) && make_signals(gpu, screen);
    if (made)
        return screen;
    gpu_screen_destroy(gpu, screen);
    return NULL;
}

static void drop_chain(struct gpu *gpu, struct gpu_screen *screen) {
    gpu->vk.vkQueueWaitIdle(gpu->queue);
    gpu->vk.vkDestroySwapchainKHR(gpu->device, screen->chain, NULL);
    screen->chain = VK_NULL_HANDLE;
    gpu_buffer_destroy(gpu, screen->pixels);
    screen->pixels = NULL;
}

void gpu_screen_destroy(struct gpu *gpu, struct gpu_screen *screen) {
    if (!screen)
        return;
    gpu_wait(gpu, NULL);
    drop_chain(gpu, screen);
    if (screen->commands)
        gpu->vk.vkFreeCommandBuffers(gpu->device, gpu->pool, 1, &screen->commands);
    gpu->vk.vkDestroyFence(gpu->device, screen->done, NULL);
    gpu->vk.vkDestroySemaphore(gpu->device, screen->acquired, NULL);
    gpu->vk.vkDestroySemaphore(gpu->device, screen->drawn, NULL);
    if (screen->surface)
        vkDestroySurfaceKHR(gpu->instance.handle, screen->surface, NULL);
    free(screen);
}

// ---- the chain of images

// GPU_HIDDEN: the size of the window differs from that of the pixels.
static enum gpu_shown make_chain(struct gpu *gpu, struct gpu_screen *screen, uint32_t width,
                                 uint32_t height) {
    VkSurfaceCapabilitiesKHR can;
    if (!gpu_check(gpu, vkGetPhysicalDeviceSurfaceCapabilitiesKHR(gpu->physical, screen->surface, &can),
                   "vkGetPhysicalDeviceSurfaceCapabilitiesKHR"))
        return GPU_SHOW_FAILED;
    // A window without a size of its own takes the size of the pixels.
    const bool is_free = can.currentExtent.width == UINT32_MAX;
    if (!is_free && (can.currentExtent.width != width || can.currentExtent.height != height))
        return GPU_HIDDEN;
    const VkSwapchainCreateInfoKHR create = {.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
                                             .surface = screen->surface,
                                             .minImageCount = can.minImageCount,
                                             .imageFormat = screen->format.format,
                                             .imageColorSpace = screen->format.colorSpace,
                                             .imageExtent = {width, height},
                                             .imageArrayLayers = 1,
                                             .imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                             .preTransform = can.currentTransform,
                                             .compositeAlpha = can.supportedCompositeAlpha &
                                                                       VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                                                                   ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                                                                   : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR,
                                             .presentMode = VK_PRESENT_MODE_FIFO_KHR,
                                             .clipped = VK_TRUE};
    if (!gpu_check(gpu, gpu->vk.vkCreateSwapchainKHR(gpu->device, &create, NULL, &screen->chain),
                   "vkCreateSwapchainKHR"))
        return GPU_SHOW_FAILED;
    screen->width = width;
    screen->height = height;
    screen->image_count = IMAGES_MAX;
    screen->pixels = gpu_buffer_create(gpu, GPU_HOST, (uint64_t)width * height * 4);
    const VkResult got =
        gpu->vk.vkGetSwapchainImagesKHR(gpu->device, screen->chain, &screen->image_count, screen->images);
    return screen->pixels && gpu_check(gpu, got, "vkGetSwapchainImagesKHR") ? GPU_SHOWN : GPU_SHOW_FAILED;
}

// ---- one picture

static void put_pixels(const struct gpu_screen *screen, const uint8_t *from) {
    const size_t count = (size_t)screen->width * screen->height;
    uint8_t *to = screen->pixels->mapped;
    if (!screen->is_red_first) {
        memcpy(to, from, 4 * count);
        return;
    }
    for (size_t i = 0; i < 4 * count; i += 4) {
        to[i] = from[i + 2];
        to[i + 1] = from[i + 1];
        to[i + 2] = from[i];
        to[i + 3] = from[i + 3];
    }
}

static void change_layout(struct gpu *gpu, const struct gpu_screen *screen, VkImage image, bool before) {
    const VkImageMemoryBarrier barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
        .srcAccessMask = before ? 0 : VK_ACCESS_TRANSFER_WRITE_BIT,
        .dstAccessMask = before ? VK_ACCESS_TRANSFER_WRITE_BIT : 0,
        .oldLayout = before ? VK_IMAGE_LAYOUT_UNDEFINED : VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
        .newLayout = before ? VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL : VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1}};
    gpu->vk.vkCmdPipelineBarrier(screen->commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                 before ? VK_PIPELINE_STAGE_TRANSFER_BIT
                                        : VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT,
                                 0, 0, NULL, 0, NULL, 1, &barrier);
}

static bool record(struct gpu *gpu, const struct gpu_screen *screen, VkImage image) {
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    const VkBufferImageCopy region = {
        .imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
        .imageExtent = {screen->width, screen->height, 1}};
    if (!gpu_check(gpu, gpu->vk.vkBeginCommandBuffer(screen->commands, &begin), "vkBeginCommandBuffer"))
        return false;
    change_layout(gpu, screen, image, true);
    gpu->vk.vkCmdCopyBufferToImage(screen->commands, screen->pixels->buffer, image,
                                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    change_layout(gpu, screen, image, false);
    return gpu_check(gpu, gpu->vk.vkEndCommandBuffer(screen->commands), "vkEndCommandBuffer");
}

static bool draw(struct gpu *gpu, struct gpu_screen *screen, VkImage image) {
    const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
    const VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                 .waitSemaphoreCount = 1,
                                 .pWaitSemaphores = &screen->acquired,
                                 .pWaitDstStageMask = &stage,
                                 .commandBufferCount = 1,
                                 .pCommandBuffers = &screen->commands,
                                 .signalSemaphoreCount = 1,
                                 .pSignalSemaphores = &screen->drawn};
    return record(gpu, screen, image) &&
           gpu_check(gpu, gpu->vk.vkQueueSubmit(gpu->queue, 1, &submit, screen->done), "vkQueueSubmit") &&
           gpu_check(gpu, gpu->vk.vkWaitForFences(gpu->device, 1, &screen->done, VK_TRUE, UINT64_MAX),
                     "vkWaitForFences") &&
           gpu_check(gpu, gpu->vk.vkResetFences(gpu->device, 1, &screen->done), "vkResetFences");
}

// If the window has changed, the chain is made again next time.
static enum gpu_shown judge(struct gpu *gpu, struct gpu_screen *screen, VkResult result, const char *call) {
    if (result == VK_SUCCESS)
        return GPU_SHOWN;
    if (result != VK_SUBOPTIMAL_KHR && result != VK_ERROR_OUT_OF_DATE_KHR && result != VK_TIMEOUT &&
        result != VK_NOT_READY) {
        gpu_check(gpu, result, call);
        return GPU_SHOW_FAILED;
    }
    drop_chain(gpu, screen);
    return GPU_HIDDEN;
}

enum gpu_shown gpu_screen_show(struct gpu *gpu, struct gpu_screen *screen, const uint8_t *pixels,
                               uint32_t width, uint32_t height) {
    static const uint64_t LONG_NS = 1000000000;
    uint32_t index = 0;
    if (width == 0 || height == 0)
        return GPU_HIDDEN;
    if (screen->chain && (screen->width != width || screen->height != height))
        drop_chain(gpu, screen);
    enum gpu_shown shown = screen->chain ? GPU_SHOWN : make_chain(gpu, screen, width, height);
    if (shown != GPU_SHOWN)
        return shown;
    VkResult result = gpu->vk.vkAcquireNextImageKHR(gpu->device, screen->chain, LONG_NS, screen->acquired,
                                                    VK_NULL_HANDLE, &index);
    const bool is_old = result == VK_SUBOPTIMAL_KHR;
    shown = judge(gpu, screen, is_old ? VK_SUCCESS : result, "vkAcquireNextImageKHR");
    if (shown != GPU_SHOWN)
        return shown;
    put_pixels(screen, pixels);
    if (!draw(gpu, screen, screen->images[index]))
        return GPU_SHOW_FAILED;
    const VkPresentInfoKHR present = {.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                      .waitSemaphoreCount = 1,
                                      .pWaitSemaphores = &screen->drawn,
                                      .swapchainCount = 1,
                                      .pSwapchains = &screen->chain,
                                      .pImageIndices = &index};
    result = gpu->vk.vkQueuePresentKHR(gpu->queue, &present);
    return judge(gpu, screen, is_old && result == VK_SUCCESS ? VK_SUBOPTIMAL_KHR : result,
                 "vkQueuePresentKHR");
}
