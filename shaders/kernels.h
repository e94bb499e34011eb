// The compiled kernels that a program holds: each as kernel_NAME_texels for devices that fetch texels, and as
// kernel_NAME_storage for those that read storage buffers.
#ifndef GLINT_SHADERS_KERNELS_H
#define GLINT_SHADERS_KERNELS_H

#include "shaders/kernel.h"

#define KERNEL(name) extern const struct kernel kernel_##name##_texels, kernel_##name##_storage;

KERNEL(trace)
KERNEL(hits) // what every pixel's first ray hits
KERNEL(log)  // what single rays hit, in full
// In single precision, on devices without doubles.
KERNEL(trace_pairs)
KERNEL(hits_pairs)
KERNEL(log_pairs)
// In double precision.
KERNEL(trace64)
KERNEL(hits64)
KERNEL(log64)
// Of scenes with instances (instances.glsl).
KERNEL(trace_instances)
KERNEL(hits_instances)
KERNEL(log_instances)
KERNEL(trace64_instances)
KERNEL(hits64_instances)
KERNEL(log64_instances)
// With the methods of other tracers (alternatives.glsl).
KERNEL(trace_alternative)
KERNEL(hits_alternative)
KERNEL(log_alternative)
// With operations that may be fused.
KERNEL(trace_fused)
KERNEL(hits_fused)
KERNEL(log_fused)

// From samples traced at once to a picture, on GPUs only.
extern const struct kernel kernel_resolve_storage;

#undef KERNEL

#endif
