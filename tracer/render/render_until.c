// A frame that may end before it has all its samples. All pixels must have equally many, and an abandoned
// sample must leave no trace: sample by sample the sums of all portions are read back, and those of the last
// whole sample are kept beside those of the current one.
#include "core/heap.h"
#include "tracer/render/render_private.h"

#include <stdlib.h>

struct sums {
    uint32_t *whole, *next; // of all tiles, 4 words per slot: the last whole sample, and the current one
    bool has_portions;      // more than one: the portion's buffer serves them in turn
};

static uint32_t tiles_of_portion(const struct renderer *renderer, uint32_t begin) {
    const uint32_t left = renderer->tiles - begin;
    return left < renderer->portion_tiles ? left : renderer->portion_tiles;
}

static enum render_result draw_portion(struct renderer_frame *run, struct sums *sums, uint32_t begin) {
    struct renderer *renderer = run->renderer;
    const uint32_t tiles = tiles_of_portion(renderer, begin);
    const uint64_t bytes = (uint64_t)tiles * TILE_PIXELS * sizeof(struct gpu_word);
    const size_t at = (size_t)4 * TILE_PIXELS * begin;
    struct gpu_buffer *output = renderer->buffers[BINDING_OUTPUT];
    if (run->samples_done && sums->has_portions &&
        !gpu_write(renderer->gpu, output, 0, sums->whole + at, bytes))
        return RENDER_FAILED;
    const enum render_result result = renderer_draw_sample(run, begin, tiles, run->samples_done);
    if (result != RENDER_DONE)
        return result;
    return gpu_read(renderer->gpu, output, 0, sums->next + at, bytes) ? RENDER_DONE : RENDER_FAILED;
}

// One sample of all pixels.
static enum render_result draw_all(struct renderer_frame *run, struct sums *sums) {
    enum render_result result = RENDER_DONE;
    for (uint32_t begin = 0; result == RENDER_DONE && begin < run->renderer->tiles;
         begin += run->renderer->portion_tiles)
        result = draw_portion(run, sums, begin);
    if (result != RENDER_DONE)
        return result;
    uint32_t *whole = sums->next;
    sums->next = sums->whole;
    sums->whole = whole;
    run->samples_done++;
    return RENDER_DONE;
}

static enum render_result draw_samples(struct renderer_frame *run, struct sums *sums, float *rgb) {
    const struct renderer *renderer = run->renderer;
    const struct render_limit *limit = run->limit;
    enum render_result result = RENDER_DONE;
    while (result == RENDER_DONE && run->samples_done < renderer->settings.samples) {
        if (run->samples_done == 1 || (run->samples_done && limit->shows_each))
            renderer_unpack(renderer, 0, renderer->tiles, sums->whole, run->samples_done, rgb);
        if (run->samples_done && !limit->goes_on(limit->context, run->samples_done, rgb))
            break;
        result = draw_all(run, sums);
    }
    return result == RENDER_CANCELLED && run->is_over ? RENDER_DONE : result;
}

enum render_result renderer_draw_until(struct renderer_frame *run, const struct view_camera *camera,
                                       float *rgb) {
    const struct renderer *renderer = run->renderer;
    run->samples_done = 0;
    run->is_over = false;
    if (!renderer_begin_frame(run, camera))
        return RENDER_FAILED;
    const size_t words = heap_times(heap_times(4, TILE_PIXELS), renderer->tiles);
    struct sums sums = {heap_array(words, sizeof(uint32_t)), heap_array(words, sizeof(uint32_t)),
                        run->statistics->portions > 1};
    enum render_result result = sums.whole && sums.next ? draw_samples(run, &sums, rgb) : RENDER_FAILED;
    if (result == RENDER_DONE) {
        run->statistics->samples = run->samples_done;
        run->statistics->all_samples =
            (uint64_t)renderer->settings.width * renderer->settings.height * run->samples_done;
        if (renderer_unpack(renderer, 0, renderer->tiles, sums.whole, run->samples_done, rgb))
            renderer_note_faults(renderer, 0, renderer->tiles, sums.whole, run->statistics);
    }
    free(sums.whole);
    free(sums.next);
    return result;
}
