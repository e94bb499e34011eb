// Pictures in a window: a swapchain of the device that traces.
//
// The window belongs to the caller, who makes its surface; pixels come from this process. Needs a gpu that
// was created with screen_extensions. Errors: NULL, or GPU_SHOW_FAILED; gpu_error has the text. Ownership:
// gpu_screen_destroy frees it, surface included, and takes NULL; before the window and the gpu.
// Thread safety: the gpu's thread.
#ifndef GLINT_TRACER_GPU_GPU_SCREEN_H
#define GLINT_TRACER_GPU_GPU_SCREEN_H

#include "tracer/gpu/gpu.h"

struct gpu_screen;

// `instance` is a VkInstance, `surface` points to the VkSurfaceKHR that is made. false: it was not.
typedef bool gpu_make_surface(void *context, void *instance, void *surface);

struct gpu_screen *gpu_screen_create(struct gpu *gpu, gpu_make_surface *make, void *context);
void gpu_screen_destroy(struct gpu *gpu, struct gpu_screen *screen);

enum gpu_shown {
    GPU_SHOWN,
    GPU_HIDDEN, // the window has no size now, or a different one from the pixels: nothing was shown
    GPU_SHOW_FAILED,
};

// Shows width * height pixels of four bytes, blue, green, red and one that does not count, rows from the top.
// The size must be the window's.
enum gpu_shown gpu_screen_show(struct gpu *gpu, struct gpu_screen *screen, const uint8_t *pixels,
                               uint32_t width, uint32_t height);

#endif
