// Follows the paths of samples to their ends: passes over paths that begin and over saved ones, in
// dispatches.
#include "tracer/render/render_private.h"

#include <string.h>

static bool is_over(struct renderer_frame *run) {
    if (run->limit && run->samples_done)
        run->is_over = run->limit->is_over(run->limit->context);
    return run->is_over;
}

bool renderer_is_wanted(const struct renderer_frame *run, double part) {
    const struct render_progress *progress = run->progress;
    return !progress || !progress->report ||
           progress->report(progress->context, ((double)run->steps_done + part) / (double)run->steps);
}

// What the dispatch added to a bank.
static void add_bank(struct renderer_frame *run, const uint32_t *now, const uint32_t *before) {
    for (int kind = 0; kind < COUNTER_SUMS; kind++)
        run->counts[kind] += now[kind] - before[kind]; // which may wrap around
    for (int kind = COUNTER_SUMS; kind < COUNTER_KINDS; kind++)
        if (now[kind] > run->counts[kind])
            run->counts[kind] = now[kind];
}

static bool read_counters(struct renderer_frame *run) {
    struct renderer *renderer = run->renderer;
    uint32_t counters[COUNTER_COUNT];
    const uint64_t bytes = run->counting ? sizeof counters : COUNTER_SHARED * sizeof *counters;
    if (renderer->counters)
        memcpy(counters, gpu_contents(renderer->counters), bytes);
    else if (!gpu_read(renderer->gpu, renderer->buffers[BINDING_COUNTERS], 0, counters, bytes))
        return false;
    for (uint32_t at = COUNTER_SHARED; at < COUNTER_COUNT && run->counting; at += COUNTER_BANK)
        add_bank(run, counters + at, run->counters + at);
    memcpy(run->counters, counters, bytes);
    memcpy(renderer->pending, counters + COUNTER_PENDING, sizeof renderer->pending);
    renderer->taken = counters[COUNTER_PLACES];
    renderer->restarts = counters[COUNTER_RESTARTS];
    run->met_long_ray = counters[COUNTER_LONG_RAYS] != 0;
    return true;
}

static bool run_paths(struct renderer_frame *run, struct dispatch_block *block, uint32_t end) {
    struct renderer *renderer = run->renderer;
    double seconds;
    struct gpu_program *program = block->resume ? renderer_program(renderer, run->counting) : run->program;
    if (!program || !renderer_run_paths(renderer, program, block->resume ? RENDERER_RESUMES : RENDERER_BEGINS,
                                        renderer->settings.workgroup, block, end,
                                        renderer->counters ? run : NULL, &seconds))
        return false;
    run->statistics->device_seconds += seconds;
    run->statistics->dispatches++;
    return read_counters(run);
}

// The number of paths that begin.
static uint32_t paths_of(const struct dispatch_block *block) {
    return block->listed ? block->listed
                         : block->tile_count * TILE_PIXELS * (block->samples ? block->samples : 1);
}

// The number of paths that a pass has put into its list; and how many of them have gone on right after it.
static uint32_t saved_by(const struct renderer_frame *run, const struct dispatch_block *block) {
    return run->renderer->pending[1 - block->read_list] - block->pending_base;
}

static uint32_t gone_on(const struct renderer_frame *run, uint32_t saved) {
    return saved < run->follow ? saved : run->follow;
}

// All paths from the camera, or all that were saved, until they end or are saved again.
static enum render_result draw_pass(struct renderer_frame *run, struct dispatch_block *block, uint32_t end) {
    const uint32_t all = paths_of(block);
    const uint32_t read_base = run->renderer->pending[block->read_list];
    for (; block->path_begin < end; block->path_begin = block->path_end) {
        if (!run_paths(run, block, end))
            return RENDER_FAILED;
        const uint32_t saved = saved_by(run, block),
                       again = run->renderer->pending[block->read_list] - read_base;
        const uint32_t open = end - block->path_end + saved - gone_on(run, saved) + again;
        if (run->met_long_ray)
            return RENDER_CANCELLED;
        if (open > 0 && (is_over(run) || !renderer_is_wanted(run, open < all ? 1 - (double)open / all : 0)))
            return RENDER_CANCELLED;
    }
    return RENDER_DONE;
}

// A pass, and further passes until none of its paths is left.
static enum render_result draw_to_end(struct renderer_frame *run, struct dispatch_block *block,
                                      uint32_t begin, uint32_t end) {
    struct renderer *renderer = run->renderer;
    uint32_t base = renderer->pending[1 - block->read_list];
    block->place_base = renderer->taken;
    block->resume = 0;
    for (;;) {
        // Of the list that is read: paths that go on right after this pass and are saved again are written
        // there.
        const uint32_t next_base = renderer->pending[block->read_list];
        block->path_begin = begin;
        block->pending_base = base;
        run->follow = 0;
        const enum render_result result = draw_pass(run, block, end);
        if (result != RENDER_DONE)
            return result;
        end = block->resume = saved_by(run, block);
        begin = gone_on(run, end);
        run->statistics->slices += end > 0;
        if (begin == end && renderer->pending[block->read_list] == next_base)
            return RENDER_DONE;
        base = next_base;
        block->read_list = 1 - block->read_list;
    }
}

enum render_result renderer_draw_paths(struct renderer_frame *run, struct dispatch_block *block) {
    struct renderer *renderer = run->renderer;
    block->places = renderer->places;
    block->restart_base = renderer->restarts;
    block->restarts = 0;
    const uint32_t all = paths_of(block);
    enum render_result result = draw_to_end(run, block, 0, all);
    // Paths that found no place, as many at a time as there are places.
    const uint32_t left = renderer->restarts - block->restart_base;
    block->restarts = 1;
    for (uint32_t begin = 0; result == RENDER_DONE && begin < left; begin += renderer->places) {
        const uint32_t end = left - begin < renderer->places ? left : begin + renderer->places;
        result = draw_to_end(run, block, begin, end);
    }
    return result;
}

// Where a sample lies in its pixel, which is only a part of the grid's cell if pixels lie apart.
static void offset_of(const struct renderer *renderer, uint32_t number, float *a, float *b) {
    const double apart = renderer->settings.apart;
    double x, y;
    view_sample_offset(number, &x, &y);
    *a = (float)(apart > 1 ? 0.5 + (x - 0.5) / apart : x);
    *b = (float)(apart > 1 ? 0.5 + (y - 0.5) / apart : y);
}

static enum render_result draw_sample(struct renderer_frame *run, uint32_t tile_begin, uint32_t tile_count,
                                      uint32_t sample, uint32_t before, uint32_t listed) {
    struct renderer *renderer = run->renderer;
    const uint32_t number = renderer->settings.first_sample + sample;
    struct dispatch_block block = {.tile_begin = tile_begin,
                                   .tile_count = tile_count,
                                   .sample_index = before,
                                   .first_sample = number,
                                   .listed = listed};
    offset_of(renderer, number, &block.offset_x, &block.offset_y);
    if (renderer->samples_at_once && !renderer_write_samples(renderer, sample, 1))
        return RENDER_FAILED;
    const enum render_result result = renderer_draw_paths(run, &block);
    if (result != RENDER_DONE)
        return result;
    run->steps_done++;
    return renderer_is_wanted(run, 0) ? RENDER_DONE : RENDER_CANCELLED;
}

enum render_result renderer_draw_sample(struct renderer_frame *run, uint32_t tile_begin, uint32_t tile_count,
                                        uint32_t sample) {
    return draw_sample(run, tile_begin, tile_count, sample, sample, 0);
}

enum render_result renderer_draw_listed(struct renderer_frame *run, uint32_t tile_begin, uint32_t tile_count,
                                        uint32_t sample, uint32_t before, uint32_t listed) {
    return draw_sample(run, tile_begin, tile_count, sample, before, listed);
}

bool renderer_write_samples(struct renderer *renderer, uint32_t first, uint32_t count) {
    struct samples_block block;
    for (uint32_t i = 0; i < SAMPLES_AT_ONCE; i++)
        offset_of(renderer, renderer->settings.first_sample + first + (i < count ? i : 0),
                  &block.offsets[i][0], &block.offsets[i][1]);
    return gpu_write(renderer->gpu, renderer->buffers[BINDING_SAMPLES], 0, &block, sizeof block);
}
