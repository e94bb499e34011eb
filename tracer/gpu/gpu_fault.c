// What went wrong on a device: the status and the words of the call that failed last.
#include "core/heap.h"
#include "tracer/gpu/gpu_private.h"

#include <stdarg.h>
#include <stdio.h>

void gpu_fail(struct gpu *gpu, enum gpu_status status, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(gpu->error, sizeof gpu->error, format, arguments);
    va_end(arguments);
    gpu->status = status;
}

bool gpu_check(struct gpu *gpu, VkResult result, const char *call) {
    if (result >= VK_SUCCESS)
        return true;
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY)
        heap_exhausted(0);
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
        gpu_fail(gpu, GPU_NO_MEMORY, "%s: not enough memory on %s", call, gpu->info.name);
    else if (result == VK_ERROR_DEVICE_LOST)
        gpu_fail(gpu, GPU_LOST, "%s: %s stopped answering", call, gpu->info.name);
    else
        gpu_fail(gpu, GPU_FAILED, "%s failed on %s (VkResult %d)", call, gpu->info.name, (int)result);
    return false;
}

const char *gpu_error(const struct gpu *gpu) {
    return gpu->error;
}
enum gpu_status gpu_last_status(const struct gpu *gpu) {
    return gpu->status;
}
