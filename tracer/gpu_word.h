// The unit of every buffer that host and kernels share: 16 bytes, a uvec4 in GLSL (shaders/gpu_scene.h).
#ifndef GLINT_TRACER_GPU_WORD_H
#define GLINT_TRACER_GPU_WORD_H

#include <stdint.h>

struct gpu_word {
    uint32_t x, y, z, w;
};

#endif
