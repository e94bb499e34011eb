#include "measure/tradeoff/measure/measure.h"

#include "core/clock.h"
#include "core/heap.h"
#include "core/quantile.h"
#include "measure/tradeoff/plan/plan.h"
#include "shaders/features.h"

#include <stdlib.h>
#include <string.h>

enum {
    FRAMES_MOST = 24, // of one timing
};
// A timing's frames go on until they sum to this. A GPU that was idle takes a while to reach its clock: it is
// warmed up once at the start, and briefly if buffers were made or a kernel compiled in between.
static const double TIMED_SECONDS = 0.04, WARM_SECONDS_GPU = 0.02, WAKE_SECONDS_GPU = 1;

static void show(const void *context, const float *linear, size_t pixels, float *shown) {
    const struct image_display *display = context;
    image_to_displayed(linear, pixels, *display, shown);
}

static struct render_settings settings_of(const struct measuring *s, const struct setting *setting,
                                          const struct flat_scene *flat) {
    struct render_settings r = render_settings_of(s->input->scene, flat, s->input->limits);
    r.width = setting->width;
    r.height = setting->height;
    r.samples = setting->samples;
    r.max_depth = setting->max_depth;
    r.min_weight = setting->min_weight;
    r.error = setting_ends_pixels(setting) ? setting->error : 0;
    r.least_samples = setting->min_samples;
    r.show = show;
    r.show_context = &s->display;
    r.alternative = setting->alternative;
    r.features = flat->features & ~without_features(setting->without, &s->input->view->camera);
    if (setting->general)
        r.features |= FEATURE_GENERAL;
    return r;
}

static enum tradeoff_status open_precision(struct measuring *s, bool is_double) {
    const struct tradeoff_input *in = s->input;
    const struct flat_input input = {.scene = in->scene,
                                     .view = in->view,
                                     .origin = in->origin,
                                     .is_double = is_double,
                                     // As render has it: its times are those of the study.
                                     .sharing = gpu_info(in->gpu)->has_double ? FLAT_CHEAPER : FLAT_COPIES,
                                     .limits = in->limits,
                                     .sink = in->sink};
    if (!flatten(&input, &s->flat[is_double]))
        return TRADEOFF_SCENE;
    s->shadowless[is_double] = s->flat[is_double];
    s->shadowless[is_double].features &= ~FEATURE_SHADOWS;
    return TRADEOFF_DONE;
}

static bool is_equal(const struct setting *a, const struct setting *b) {
    bool equal = true;
    for (int knob = 0; knob < KNOB_COUNT; knob++)
        equal &= !plan_differs(a, b, (enum knob)knob);
    return equal;
}

// The renderer of the setting's precision, set to it, with samples from `first` on.
static enum tradeoff_status set_from(struct measuring *s, const struct setting *setting, uint32_t first,
                                     struct renderer **out) {
    const bool d = setting->is_double;
    enum tradeoff_status status = TRADEOFF_DONE;
    if (!s->flat[d].strides.triangle)
        status = open_precision(s, d);
    if (status != TRADEOFF_DONE)
        return status;
    const struct flat_scene *flat = setting->shadows ? &s->flat[d] : &s->shadowless[d];
    struct render_settings settings = settings_of(s, setting, flat);
    settings.first_sample = first;
    const bool is_set = is_equal(&s->current[d], setting) && s->current_first[d] == first;
    if (!s->renderer[d])
        s->renderer[d] = renderer_create(s->input->gpu, flat, &settings);
    else if (!is_set && !renderer_change(s->renderer[d], flat, &settings)) {
        renderer_destroy(s->renderer[d]);
        s->renderer[d] = NULL;
    }
    s->current[d] = *setting;
    s->current_first[d] = first;
    *out = s->renderer[d];
    return *out ? TRADEOFF_DONE : TRADEOFF_DEVICE;
}

static enum tradeoff_status set(struct measuring *s, const struct setting *setting, struct renderer **out) {
    return set_from(s, setting, 0, out);
}

enum tradeoff_status device_open(struct measuring *s) {
    struct renderer *renderer;
    return set(s, &s->base, &renderer);
}

void device_close(struct measuring *s) {
    for (int d = 0; d < 2; d++) {
        renderer_destroy(s->renderer[d]);
        flat_finish(&s->flat[d]);
    }
}

static bool report_frame(void *context, double fraction) {
    struct measuring *s = context;
    (void)fraction;
    return !measuring_is_late(s) && measuring_report(s, s->steps_done);
}

static enum tradeoff_status status_of(enum render_result result) {
    return result == RENDER_DONE        ? TRADEOFF_DONE
           : result == RENDER_CANCELLED ? TRADEOFF_CANCELLED
                                        : TRADEOFF_DEVICE;
}

static struct view_camera camera_of(const struct measuring *s, const struct setting *setting) {
    struct view_camera camera = s->input->view->camera;
    if (setting->without & 1u << KNOB_LENS)
        camera.lens_radius = 0;
    return camera;
}

static enum tradeoff_status frame(struct measuring *s, const struct setting *setting,
                                  struct renderer *renderer, float *rgb,
                                  struct render_statistics *statistics) {
    const struct render_progress progress = {report_frame, s};
    const struct view_camera camera = camera_of(s, setting);
    return status_of(renderer_render(renderer, &camera, rgb, &progress, statistics));
}

enum tradeoff_status device_samples(struct measuring *s, const struct setting *setting, uint32_t first,
                                    uint32_t count, double *seconds, uint64_t *not_finite) {
    struct setting some = *setting;
    struct render_statistics statistics;
    struct renderer *renderer;
    some.samples = count;
    some.error = 0;
    enum tradeoff_status status = set_from(s, &some, first, &renderer);
    if (status == TRADEOFF_DONE)
        status = frame(s, &some, renderer, s->picture, &statistics);
    if (status != TRADEOFF_DONE)
        return status;
    *seconds = statistics.device_seconds;
    const uint64_t pixels = statistics.faults[RENDER_NOT_FINITE].pixels;
    if (not_finite && pixels > *not_finite)
        *not_finite = pixels;
    return status;
}

// Keeps how many samples the row's pixels took, for the parts of its error.
static bool keep_taken(struct measuring *s, const struct renderer *renderer, const struct setting *setting) {
    const size_t pixels = heap_times(setting->width, setting->height);
    free(s->taken);
    s->taken = heap_array(pixels, sizeof *s->taken);
    if (s->taken)
        memcpy(s->taken, renderer_estimate(renderer)->samples, pixels * sizeof *s->taken);
    return s->taken != NULL;
}

enum tradeoff_status device_picture(struct measuring *s, struct row *row, float *rgb) {
    struct render_statistics statistics;
    struct renderer *renderer;
    enum tradeoff_status status = set(s, &row->setting, &renderer);
    if (status == TRADEOFF_DONE)
        status = frame(s, &row->setting, renderer, rgb, &statistics);
    if (status != TRADEOFF_DONE)
        return status;
    if (setting_ends_pixels(&row->setting) && !keep_taken(s, renderer, &row->setting))
        return TRADEOFF_MEMORY;
    row->not_finite = statistics.faults[RENDER_NOT_FINITE].pixels;
    row->time_ms = row->time_low_ms = row->time_high_ms = 1e3 * statistics.device_seconds;
    s->round_seconds += statistics.device_seconds > TIMED_SECONDS ? statistics.device_seconds : TIMED_SECONDS;
    return status;
}

// Rays, nodes and items of one sample per pixel, times the samples: counts that are equal for all samples
// need no further frames. If pixels end by their error, the counts of all samples.
enum tradeoff_status device_count(struct measuring *s, struct row *row) {
    struct setting counted = row->setting;
    struct renderer *renderer;
    struct render_rays rays;
    const struct render_progress progress = {report_frame, s};
    const struct view_camera camera = camera_of(s, &row->setting);
    const bool whole = setting_ends_pixels(&counted);
    counted.samples = whole ? counted.samples : 1;
    enum tradeoff_status status = set(s, &counted, &renderer);
    if (status == TRADEOFF_DONE)
        status = status_of(renderer_count(renderer, &camera, &progress, &rays));
    if (status != TRADEOFF_DONE)
        return status;
    const uint64_t n = whole ? 1 : row->setting.samples;
    const double pixels = (double)row->setting.width * row->setting.height;
    row->work = (struct work){.rays = n * (rays.primary + rays.reflected + rays.refracted + rays.shadow),
                              .nodes = n * rays.nodes,
                              .triangles = n * rays.items,
                              .deepest = rays.deepest,
                              .samples = (double)(n * rays.primary) / pixels};
    row->work.cost = (double)(row->work.nodes + row->work.triangles) * (row->setting.is_double ? 2 : 1);
    return TRADEOFF_DONE;
}

enum tradeoff_status device_time(struct measuring *s, const struct setting *setting, double *ms) {
    double times[FRAMES_MOST], warm = 0, timed = 0;
    struct render_statistics statistics;
    struct renderer *renderer;
    const bool is_gpu = gpu_info(s->input->gpu)->kind != GPU_CPU;
    const bool is_warm =
        !is_gpu && s->renderer[setting->is_double] && is_equal(&s->current[setting->is_double], setting);
    int count = 0;
    enum tradeoff_status status = set(s, setting, &renderer);
    statistics.device_seconds = 1;
    while (status == TRADEOFF_DONE && !is_warm && statistics.device_seconds > 0 &&
           (warm <= 0 || (is_gpu && warm < WARM_SECONDS_GPU))) {
        status = frame(s, setting, renderer, s->picture, &statistics);
        warm += status == TRADEOFF_DONE ? statistics.device_seconds : 0;
    }
    while (status == TRADEOFF_DONE && count < FRAMES_MOST && (count == 0 || timed < TIMED_SECONDS)) {
        status = frame(s, setting, renderer, s->picture, &statistics);
        times[count++] = statistics.device_seconds;
        timed += statistics.device_seconds;
    }
    if (status != TRADEOFF_DONE)
        return status;
    quantile_sort(times, (size_t)count);
    *ms = 1e3 * quantile(times, (size_t)count, 0.5);
    return TRADEOFF_DONE;
}

enum tradeoff_status device_wake(struct measuring *s) {
    const double start = clock_seconds();
    struct render_statistics statistics;
    struct renderer *renderer;
    enum tradeoff_status status = TRADEOFF_DONE;
    if (gpu_info(s->input->gpu)->kind == GPU_CPU)
        return status;
    status = set(s, &s->base, &renderer);
    while (status == TRADEOFF_DONE && clock_seconds() - start < WAKE_SECONDS_GPU)
        status = frame(s, &s->base, renderer, s->picture, &statistics);
    return status;
}

enum tradeoff_status device_hits(struct measuring *s, const struct setting *setting, struct hit_pixel *hits) {
    const struct render_progress progress = {report_frame, s};
    struct renderer *renderer;
    enum tradeoff_status status = set(s, setting, &renderer);
    if (status == TRADEOFF_DONE)
        status = status_of(renderer_hits(renderer, &s->input->view->camera, hits, &progress));
    return status;
}
