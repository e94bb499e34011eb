// Maps slots back to pixels, and numbers to bodies.
#include "tracer/render/render_private.h"

#include "core/parallel.h"

#include <assert.h>
#include <math.h>
#include <stdatomic.h>
#include <string.h>

enum {
    TILES_A_PIECE = 256,
};

// The pixel `i` of a tile.
static bool pixel_of_tile(const struct renderer *renderer, uint32_t tile_x, uint32_t tile_y, uint32_t i,
                          uint32_t *x, uint32_t *y) {
    *x = tile_x * TILE_SIDE + ((i & 1) | (i >> 1 & 2) | (i >> 2 & 4));
    *y = tile_y * TILE_SIDE + ((i >> 1 & 1) | (i >> 2 & 2) | (i >> 3 & 4));
    return *x < renderer->settings.width && *y < renderer->settings.height;
}

bool renderer_pixel(const struct renderer *renderer, uint32_t tile_begin, uint32_t slot, uint32_t *x,
                    uint32_t *y) {
    const uint32_t tile = tile_begin + slot / TILE_PIXELS;
    const uint32_t run = tile / renderer->run_tiles * renderer->run_step % renderer->runs;
    const uint32_t place = run * renderer->run_tiles + tile % renderer->run_tiles;
    return pixel_of_tile(renderer, place % renderer->tiles_x, place / renderer->tiles_x, slot % TILE_PIXELS,
                         x, y);
}

// Which pixel a slot of the portion at `tile_begin` shows; false: none in the picture. For a portion that the
// tracing kernel has filled, and for others.
static bool renderer_traced_pixel(const struct renderer *renderer, uint32_t tile_begin, uint32_t slot,
                                  uint32_t *x, uint32_t *y) {
    if (!renderer->order)
        return renderer_pixel(renderer, tile_begin, slot, x, y);
    const uint32_t place = renderer->order[tile_begin + slot / TILE_PIXELS];
    return pixel_of_tile(renderer, place & 0xffff, place >> 16, slot % TILE_PIXELS, x, y);
}

struct unpacking {
    const struct renderer *renderer;
    uint32_t tile_begin, samples;
    const uint32_t *sums;
    float *rgb;
    atomic_bool has_faults;
};

static void unpack_tiles(void *context, size_t begin, size_t end) {
    struct unpacking *u = context;
    const struct render_settings *settings = &u->renderer->settings;
    const float samples = (float)u->samples;
    uint32_t faults = 0; // any
    for (size_t slot = begin * TILE_PIXELS; slot < end * TILE_PIXELS; slot++) {
        uint32_t x, y;
        if (!renderer_traced_pixel(u->renderer, u->tile_begin, (uint32_t)slot, &x, &y))
            continue;
        float sum[3];
        memcpy(sum, u->sums + 4 * slot, sizeof sum);
        float *out = u->rgb + ((size_t)y * settings->width + x) * 3;
        const uint32_t fault = u->sums[4 * slot + 3] >> FAULT_KIND_SHIFT;
        for (int i = 0; i < 3; i++)
            out[i] = fault != FAULT_NOT_FINITE ? sum[i] / samples : NAN;
        faults |= fault;
    }
    static_assert(FAULT_NONE == 0, "bits of faults are gathered");
    if (faults)
        u->has_faults = true;
}

const uint32_t *renderer_sums(const struct renderer *renderer, uint32_t tile_count) {
    struct gpu_buffer *output = renderer->buffers[BINDING_OUTPUT];
    const bool is_cpu = gpu_info(renderer->gpu)->kind == GPU_CPU;
    if (is_cpu && gpu_contents(output))
        return gpu_wait(renderer->gpu, NULL) ? gpu_contents(output) : NULL;
    const uint64_t bytes = (uint64_t)tile_count * TILE_PIXELS * sizeof(struct gpu_word);
    return gpu_read(renderer->gpu, output, 0, renderer->portion, bytes) ? renderer->portion : NULL;
}

bool renderer_unpack(const struct renderer *renderer, uint32_t tile_begin, uint32_t tile_count,
                     const uint32_t *sums, uint32_t samples, float *rgb) {
    struct unpacking unpacking = {renderer, tile_begin, samples, sums, rgb, false};
    parallel_for(tile_count, TILES_A_PIECE, unpack_tiles, &unpacking);
    return unpacking.has_faults;
}

void renderer_number(const struct renderer *renderer, uint32_t number, uint32_t *body, uint32_t *triangle) {
    const struct flat_scene *flat = renderer->flat;
    *triangle = 0;
    *body = number;
    if (number < flat->sphere_count)
        return;
    // The last body whose first triangle does not come after this one.
    const uint32_t wanted = number - flat->sphere_count;
    uint32_t low = flat->sphere_count, high = flat->body_count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (flat->first_triangle[middle] <= wanted)
            low = middle;
        else
            high = middle;
    }
    *body = low;
    *triangle = wanted - flat->first_triangle[low];
}

void renderer_note_fault(const struct renderer *renderer, uint32_t word, uint32_t pixels, uint32_t x,
                         uint32_t y, struct render_fault *fault) {
    const bool first = fault->pixels == 0 || y < fault->y || (y == fault->y && x < fault->x);
    fault->pixels += pixels;
    if (!first)
        return;
    const uint32_t number = word & FAULT_NUMBER;
    fault->x = x;
    fault->y = y;
    fault->is_nested = number == FAULT_NESTED;
    fault->has_body = number != FAULT_NUMBER && !fault->is_nested;
    fault->body = fault->triangle = 0;
    if (fault->has_body)
        renderer_number(renderer, number, &fault->body, &fault->triangle);
}

void renderer_note_faults(const struct renderer *renderer, uint32_t tile_begin, uint32_t tile_count,
                          const uint32_t *sums, struct render_statistics *statistics) {
    for (uint32_t slot = 0; slot < tile_count * TILE_PIXELS; slot++) {
        const uint32_t word = sums[4 * (size_t)slot + 3];
        if (word >> FAULT_KIND_SHIFT == FAULT_NONE)
            continue;
        uint32_t x, y;
        if (renderer_traced_pixel(renderer, tile_begin, slot, &x, &y))
            renderer_note_fault(renderer, word, 1, x, y, &statistics->faults[word >> FAULT_KIND_SHIFT]);
    }
}
