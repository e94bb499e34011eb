// A frame, and a frame that counts, to their ends.
#include "tracer/render/render_private.h"

#include "core/clock.h"

static bool begin_counting(struct renderer *renderer) {
    const uint32_t zero[COUNTER_COUNT] = {0};
    if (!renderer->counting)
        renderer->counting = renderer_keep_program(renderer, renderer->features | FEATURE_COUNTERS);
    renderer->pending = 0;
    return renderer->counting &&
           gpu_write(renderer->gpu, renderer->buffers[BINDING_COUNTERS], 0, zero, sizeof zero);
}

static enum render_result draw(struct renderer_frame *run, const struct view_camera *camera, float *rgb) {
    return run->limit ? renderer_draw_until(run, camera, rgb) : renderer_draw_frame(run, camera, rgb);
}

// Where a ray needs more iterations than a slice has, all is begun again with kernels that can save it: the
// others are faster, and almost no scene has such a ray.
static enum render_result draw_frame(struct renderer_frame *run, const struct view_camera *camera,
                                     float *rgb) {
    struct renderer *renderer = run->renderer;
    const double start = clock_seconds();
    *run->statistics = (struct render_statistics){0};
    enum render_result result = draw(run, camera, rgb);
    if (run->met_long_ray) {
        const bool counts = run->program == renderer->counting;
        result = RENDER_FAILED;
        if (renderer_take_long_rays(renderer) && (!counts || begin_counting(renderer))) {
            run->program = counts ? renderer->counting : renderer->program;
            result = draw(run, camera, rgb);
        }
    }
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
    struct renderer_frame run = {.renderer = renderer,
                                 .program = renderer->program,
                                 .progress = progress,
                                 .statistics = statistics,
                                 .limit = limit};
    return draw_frame(&run, camera, rgb);
}

static uint64_t wide(const uint32_t words[2]) {
    return (uint64_t)words[1] << 32 | words[0];
}

enum render_result renderer_count(struct renderer *renderer, const struct view_camera *camera,
                                  const struct render_progress *progress, struct render_rays *rays) {
    uint32_t values[COUNTER_COUNT] = {0};
    if (!begin_counting(renderer))
        return RENDER_FAILED;
    struct render_statistics statistics;
    struct renderer_frame run = {
        .renderer = renderer, .program = renderer->counting, .progress = progress, .statistics = &statistics};
    enum render_result result = draw_frame(&run, camera, NULL);
    if (result == RENDER_DONE &&
        !gpu_read(renderer->gpu, renderer->buffers[BINDING_COUNTERS], 0, values, sizeof values))
        result = RENDER_FAILED;
    *rays = (struct render_rays){.primary = values[COUNTER_PRIMARY],
                                 .reflected = values[COUNTER_REFLECTED],
                                 .refracted = values[COUNTER_REFRACTED],
                                 .shadow = values[COUNTER_SHADOW],
                                 .cut_by_depth = values[COUNTER_CUT_DEPTH],
                                 .cut_by_weight = values[COUNTER_CUT_WEIGHT],
                                 .total_reflections = values[COUNTER_TOTAL_REFLECT],
                                 .nodes = wide(values + COUNTER_NODES),
                                 .items = wide(values + COUNTER_ITEMS),
                                 .deepest = values[COUNTER_DEEPEST],
                                 .lost_by_depth = renderer_float(values[COUNTER_LOST_DEPTH]),
                                 .lost_by_weight = renderer_float(values[COUNTER_LOST_WEIGHT])};
    return result;
}
