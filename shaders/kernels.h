// The compiled kernels, embedded: each for devices that fetch texels and for those that read storage buffers;
// with 64 in their names, in double precision.
#ifndef GLINT_SHADERS_KERNELS_H
#define GLINT_SHADERS_KERNELS_H

#include <stddef.h>
#include <stdint.h>

extern const uint32_t kernel_trace_texels[];
extern const size_t kernel_trace_texels_words;
extern const uint32_t kernel_trace_storage[];
extern const size_t kernel_trace_storage_words;
extern const uint32_t kernel_trace64_texels[];
extern const size_t kernel_trace64_texels_words;
extern const uint32_t kernel_trace64_storage[];
extern const size_t kernel_trace64_storage_words;
// What every pixel's first ray meets.
extern const uint32_t kernel_hits_texels[];
extern const size_t kernel_hits_texels_words;
extern const uint32_t kernel_hits_storage[];
extern const size_t kernel_hits_storage_words;
extern const uint32_t kernel_hits64_texels[];
extern const size_t kernel_hits64_texels_words;
extern const uint32_t kernel_hits64_storage[];
extern const size_t kernel_hits64_storage_words;
// The same two by other tracers' ways (study.glsl), and with operations that may be fused.
extern const uint32_t kernel_trace_study_texels[];
extern const size_t kernel_trace_study_texels_words;
extern const uint32_t kernel_trace_study_storage[];
extern const size_t kernel_trace_study_storage_words;
extern const uint32_t kernel_hits_study_texels[];
extern const size_t kernel_hits_study_texels_words;
extern const uint32_t kernel_hits_study_storage[];
extern const size_t kernel_hits_study_storage_words;
extern const uint32_t kernel_trace_fused_texels[];
extern const size_t kernel_trace_fused_texels_words;
extern const uint32_t kernel_trace_fused_storage[];
extern const size_t kernel_trace_fused_storage_words;
extern const uint32_t kernel_hits_fused_texels[];
extern const size_t kernel_hits_fused_texels_words;
extern const uint32_t kernel_hits_fused_storage[];
extern const size_t kernel_hits_fused_storage_words;
// What single rays meet, in full.
extern const uint32_t kernel_log_texels[];
extern const size_t kernel_log_texels_words;
extern const uint32_t kernel_log_storage[];
extern const size_t kernel_log_storage_words;
extern const uint32_t kernel_log64_texels[];
extern const size_t kernel_log64_texels_words;
extern const uint32_t kernel_log64_storage[];
extern const size_t kernel_log64_storage_words;
extern const uint32_t kernel_log_study_texels[];
extern const size_t kernel_log_study_texels_words;
extern const uint32_t kernel_log_study_storage[];
extern const size_t kernel_log_study_storage_words;
extern const uint32_t kernel_log_fused_texels[];
extern const size_t kernel_log_fused_texels_words;
extern const uint32_t kernel_log_fused_storage[];
extern const size_t kernel_log_fused_storage_words;
// Writes the fields of each record back, for tests.
extern const uint32_t kernel_layout_texels[];
extern const size_t kernel_layout_texels_words;
extern const uint32_t kernel_layout_storage[];
extern const size_t kernel_layout_storage_words;
extern const uint32_t kernel_layout64_texels[];
extern const size_t kernel_layout64_texels_words;
extern const uint32_t kernel_layout64_storage[];
extern const size_t kernel_layout64_storage_words;
// Traces single rays, for tests.
extern const uint32_t kernel_probe_texels[];
extern const size_t kernel_probe_texels_words;
extern const uint32_t kernel_probe_storage[];
extern const size_t kernel_probe_storage_words;
extern const uint32_t kernel_probe64_texels[];
extern const size_t kernel_probe64_texels_words;
extern const uint32_t kernel_probe64_storage[];
extern const size_t kernel_probe64_storage_words;

#endif
