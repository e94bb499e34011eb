// A frame, and a frame that counts, to their ends.
#include "core/float_bits.h"
#include "tracer/render/render_private.h"

#include "core/clock.h"

static bool clear_counters(struct renderer_frame *run) {
    struct renderer *renderer = run->renderer;
    renderer->pending[0] = renderer->pending[1] = renderer->taken = renderer->restarts = 0;
    for (int i = 0; i < COUNTER_COUNT; i++)
        run->counters[i] = 0;
    for (int i = 0; i < COUNTER_KINDS; i++)
        run->counts[i] = 0;
    return gpu_write(renderer->gpu, renderer->buffers[BINDING_COUNTERS], 0, run->counters,
                     sizeof run->counters);
}

static struct render_rays rays_of(const struct renderer_frame *run) {
    const uint64_t *counts = run->counts;
    return (struct render_rays){.primary = run->statistics->all_samples,
                                .reflected = counts[COUNTER_REFLECTED],
                                .refracted = counts[COUNTER_REFRACTED],
                                .shadow = counts[COUNTER_SHADOW],
                                .cut_by_depth = counts[COUNTER_CUT_DEPTH],
                                .cut_by_weight = counts[COUNTER_CUT_WEIGHT],
                                .total_reflections = counts[COUNTER_TOTAL_REFLECT],
                                .nodes = counts[COUNTER_NODES],
                                .items = counts[COUNTER_ITEMS],
                                .unseen = counts[COUNTER_UNSEEN],
                                .deepest = (uint32_t)counts[COUNTER_DEEPEST],
                                .lost_by_depth = float_of_bits((uint32_t)counts[COUNTER_LOST_DEPTH]),
                                .lost_by_weight = float_of_bits((uint32_t)counts[COUNTER_LOST_WEIGHT])};
}

// Begins with the kernel that counts, or the other, without any earlier count. false: see gpu_error.
static bool begin(struct renderer_frame *run, bool counts) {
    run->counting = counts;
    run->program = renderer_first_program(run->renderer, counts);
    const bool apart = !counts && run->renderer->samples_at_once && renderer_begins_apart(run->renderer);
    run->whole = apart ? renderer_program(run->renderer, false) : NULL;
    return run->program && (run->whole || !apart) && (!counts || clear_counters(run));
}

static enum render_result draw(struct renderer_frame *run, const struct view_camera *camera, float *rgb) {
    return run->limit ? renderer_draw_until(run, camera, rgb) : renderer_draw_frame(run, camera, rgb);
}

// If a ray needs more iterations than a slice has, the frame is restarted with kernels that can save it: the
// others are faster, and almost no scene has such a ray.
static enum render_result draw_frame(struct renderer_frame *run, const struct view_camera *camera,
                                     bool counts, float *rgb) {
    const double start = clock_seconds();
    *run->statistics = (struct render_statistics){0};
    enum render_result result = begin(run, counts) ? draw(run, camera, rgb) : RENDER_FAILED;
    if (run->met_long_ray)
        result = renderer_take_long_rays(run->renderer) && begin(run, counts) ? draw(run, camera, rgb)
                                                                              : RENDER_FAILED;
    run->renderer->has_drawn |= result == RENDER_DONE;
    if (counts)
        run->statistics->rays = rays_of(run);
    run->statistics->wall_seconds = clock_seconds() - start;
    return result;
}

enum render_result renderer_render(struct renderer *renderer, const struct view_camera *camera, float *rgb,
                                   const struct render_progress *progress,
                                   struct render_statistics *statistics) {
    return renderer_render_until(renderer, camera, rgb, progress, NULL, statistics);
}

enum render_result renderer_render_until(struct renderer *renderer, const struct view_camera *camera,
                                         float *rgb, const struct render_progress *progress,
                                         const struct render_limit *limit,
                                         struct render_statistics *statistics) {
    if (!CLI_HAS_DEVICES)
        return RENDER_FAILED;
    struct renderer_frame run = {
        .renderer = renderer, .progress = progress, .statistics = statistics, .limit = limit};
    const enum render_result result = draw_frame(&run, camera, false, rgb);
    if (result != RENDER_DONE || limit || !renderer->settings.counts)
        return result;
    return renderer_count(renderer, camera, progress, &statistics->rays);
}

enum render_result renderer_count(struct renderer *renderer, const struct view_camera *camera,
                                  const struct render_progress *progress, struct render_rays *rays) {
    struct render_statistics statistics;
    struct renderer_frame run = {.renderer = renderer, .progress = progress, .statistics = &statistics};
    // The picture's estimate of itself stays.
    const struct render_estimate estimate = renderer->estimate;
    const enum render_result result = draw_frame(&run, camera, true, NULL);
    if (estimate.error)
        renderer->estimate = estimate;
    *rays = statistics.rays;
    return result;
}
