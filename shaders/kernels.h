// The compiled kernels, embedded: each as kernel_NAME_texels for devices that fetch texels, and as
// kernel_NAME_storage for those that read storage buffers, with its number of words.
#ifndef GLINT_SHADERS_KERNELS_H
#define GLINT_SHADERS_KERNELS_H

#include <stddef.h>
#include <stdint.h>

#define KERNEL(name)                                                                                         \
    extern const uint32_t kernel_##name##_texels[];                                                          \
    extern const size_t kernel_##name##_texels_words;                                                        \
    extern const uint32_t kernel_##name##_storage[];                                                         \
    extern const size_t kernel_##name##_storage_words;

KERNEL(trace)
KERNEL(hits)   // what every pixel's first ray meets
KERNEL(log)    // what single rays meet, in full
KERNEL(layout) // writes the fields of each record back, for tests
KERNEL(probe)  // traces single rays, for tests
// In double precision.
KERNEL(trace64)
KERNEL(hits64)
KERNEL(log64)
KERNEL(layout64)
KERNEL(probe64)
// By other tracers' ways (study.glsl).
KERNEL(trace_study)
KERNEL(hits_study)
KERNEL(log_study)
// With operations that may be fused.
KERNEL(trace_fused)
KERNEL(hits_fused)
KERNEL(log_fused)

#undef KERNEL

#endif
