// A frame whose samples are traced at once: the last paths of a dispatch, and each wait for it, leave a GPU
// idle. So a portion's samples share a dispatch, and what follows it (sums, picture, counters, copies to this
// process) is recorded with it.
#include "tracer/render/render_private.h"

#include "core/parallel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PIXELS_A_PIECE = 65536
};

static bool create(struct renderer *renderer, uint32_t binding, enum gpu_use use, uint64_t bytes) {
    renderer->buffers[binding] = gpu_buffer_create(renderer->gpu, use, bytes);
    return renderer->buffers[binding] != NULL;
}

// A kernel refers to these buffers even if it does not trace at once.
static bool make_named(struct renderer *renderer, uint64_t picture, uint64_t order) {
    return create(renderer, BINDING_SAMPLES, GPU_UNIFORM, sizeof(struct samples_block)) &&
           create(renderer, BINDING_PICTURE, GPU_STORAGE, picture) &&
           create(renderer, BINDING_ORDER, GPU_STORAGE, order);
}

bool renderer_make_at_once(struct renderer *renderer) {
    const struct render_settings *settings = &renderer->settings;
    const uint64_t picture = (uint64_t)settings->width * settings->height * 3 * sizeof(float);
    const uint64_t slots = (uint64_t)renderer->portion_tiles * TILE_PIXELS;
    const bool has_sums = settings->samples > renderer->samples_at_once;
    if (renderer->samples_at_once == 0)
        return gpu_fetches_texels(renderer->gpu) || make_named(renderer, 0, 0);
    if (!make_named(renderer, picture, (uint64_t)renderer->tiles * sizeof *renderer->order) ||
        !create(renderer, BINDING_SUMS, GPU_STORAGE, has_sums ? slots * sizeof(struct gpu_word) : 0))
        return false;
    renderer->picture = gpu_buffer_create(renderer->gpu, GPU_HOST, picture);
    renderer->counters = gpu_buffer_create(renderer->gpu, GPU_HOST, COUNTER_COUNT * sizeof(uint32_t));
    renderer->resolve = renderer_compile_kernel(renderer, RENDERER_RESOLVE, 0, NULL, NULL);
    return renderer->picture && renderer->counters && renderer->resolve;
}

void renderer_drop_at_once(struct renderer *renderer) {
    gpu_program_destroy(renderer->gpu, renderer->resolve);
    gpu_buffer_destroy(renderer->gpu, renderer->picture);
    gpu_buffer_destroy(renderer->gpu, renderer->counters);
    free(renderer->order);
    renderer->order = NULL;
    renderer->resolve = NULL;
    renderer->picture = renderer->counters = NULL;
}

// The word of each kind's first fault is looked up only if there is one.
static bool note_faults(struct renderer_frame *run) {
    struct renderer *renderer = run->renderer;
    const uint32_t *counters = gpu_contents(renderer->counters);
    uint32_t faults = 0;
    for (uint32_t kind = 1; kind < FAULT_KINDS; kind++)
        faults += counters[COUNTER_FAULT_PIXELS + kind];
    if (faults == 0)
        return true;
    if (!renderer_resolve(run, RESOLVE_FIND) || !renderer_copy_counters(run) || !gpu_submit(renderer->gpu) ||
        !gpu_wait(renderer->gpu, NULL))
        return false;
    for (uint32_t kind = 1; kind < RENDER_FAULT_KINDS; kind++) {
        const uint32_t first = ~counters[COUNTER_FAULT_FIRST + kind], width = renderer->settings.width;
        if (counters[COUNTER_FAULT_PIXELS + kind])
            renderer_note_fault(renderer, counters[COUNTER_FAULT_WORD + kind],
                                counters[COUNTER_FAULT_PIXELS + kind], first % width, first / width,
                                &run->statistics->faults[kind]);
    }
    return true;
}

static enum render_result draw_samples(struct renderer_frame *run, struct dispatch_block *block,
                                       uint32_t first, bool last_portion) {
    struct renderer *renderer = run->renderer;
    const uint32_t left = renderer->settings.samples - first;
    block->samples = left < renderer->samples_at_once ? left : renderer->samples_at_once;
    block->first_sample = renderer->settings.first_sample + first;
    run->resolve = *block;
    run->resolve.sample_index = first;
    run->shows = left == block->samples;
    run->shows_all = run->shows && last_portion;
    block->shows = renderer->settings.samples == 1;
    if (!renderer_write_samples(renderer, first, block->samples) ||
        (block->shows && !renderer_clear_faults(renderer)))
        return RENDER_FAILED;
    const enum render_result result = renderer_draw_paths(run, block);
    if (result != RENDER_DONE)
        return result;
    run->steps_done += block->samples;
    // Unless they are the last ones, samples are added up before the next ones overwrite their words.
    if (!(run->shows ? note_faults(run) : renderer_resolve(run, RESOLVE_ADD)))
        return RENDER_FAILED;
    return renderer_is_wanted(run, 0) ? RENDER_DONE : RENDER_CANCELLED;
}

static enum render_result draw_portion(struct renderer_frame *run, uint32_t tile_begin, bool *is_last) {
    struct renderer *renderer = run->renderer;
    const uint32_t left = renderer->tiles - tile_begin;
    struct dispatch_block block = {.tile_begin = tile_begin,
                                   .tile_count =
                                       left < renderer->portion_tiles ? left : renderer->portion_tiles};
    *is_last = block.tile_count == left;
    enum render_result result = RENDER_DONE;
    for (uint32_t first = 0; result == RENDER_DONE && first < renderer->settings.samples;
         first += renderer->samples_at_once)
        result = draw_samples(run, &block, first, *is_last);
    return result;
}

struct mean {
    const float *sums;
    float samples;
    float *rgb;
};

static void divide(void *context, size_t begin, size_t end) {
    const struct mean *mean = context;
    if (mean->samples == 1)
        memcpy(mean->rgb + begin, mean->sums + begin, (end - begin) * sizeof *mean->rgb);
    else
        for (size_t i = begin; i < end; i++)
            mean->rgb[i] = mean->sums[i] / mean->samples;
}

enum render_result renderer_draw_at_once(struct renderer_frame *run, float *rgb) {
    struct renderer *renderer = run->renderer;
    const struct render_settings *settings = &renderer->settings;
    enum render_result result = RENDER_DONE;
    bool is_last = false;
    for (uint32_t begin = 0; result == RENDER_DONE && !is_last; begin += renderer->portion_tiles)
        result = draw_portion(run, begin, &is_last);
    run->shows = run->shows_all = false;
    if (result != RENDER_DONE || !rgb)
        return result;
    struct mean mean = {gpu_contents(renderer->picture), (float)settings->samples, rgb};
    parallel_for((size_t)settings->width * settings->height * 3, PIXELS_A_PIECE, divide, &mean);
    return RENDER_DONE;
}
