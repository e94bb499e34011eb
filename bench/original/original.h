// The baseline: pictures by the method of the course project that glint grew out of (original.comp).
//
// It borrows from a renderer of glint what must be the same for both: device, camera and frame, mapping of
// workgroups to pixels, background. Only the way through the triangles differs, and the recursion.
// lavapipe ends all loops of 8 pixels after 65535 turns in sum; the method then misses things, and says how
// many pixels were cut so.
// Errors: original_create tells in `error`, original_render in gpu_error.
// Ownership: original_destroy takes NULL. The renderer must outlive it, and render one frame before it does.
// Thread safety: the gpu's thread.
#ifndef GLINT_BENCH_ORIGINAL_ORIGINAL_H
#define GLINT_BENCH_ORIGINAL_ORIGINAL_H

#include "tracer/render/render.h"

enum original_fetch {
    ORIGINAL_STORAGE, // storage buffers, as the original
    ORIGINAL_TEXELS,  // texel buffers, as glint on CPU devices; not on others
};

enum {
    ORIGINAL_DEPTH = 20 // as the original
};

struct original;

struct original *original_create(struct renderer *renderer, enum original_fetch fetch,
                                 char error[GPU_ERROR_BYTES]);
void original_destroy(struct original *original);
// One frame, one sample a pixel, as the renderer's last: width * height * 3 floats, rows from the top.
// Seconds on the device's clock, and how many pixels the device cut short.
bool original_render(struct original *original, float *rgb, double *device_seconds, uint32_t *cut);

uint32_t original_box_count(const struct original *original);
uint32_t original_triangle_count(const struct original *original);

#endif
