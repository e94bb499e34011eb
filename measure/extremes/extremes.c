#include "core/heap.h"
#include "measure/extremes/extremes_internal.h"

#include "core/clock.h"
#include "core/parallel.h"
#include "measure/hit_errors.h"
#include "measure/precision.h"
#include "picture/metrics/metrics.h"
#include "reference/reference.h"
#include "tracer/render/render.h"

#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const struct extreme_axis_info extreme_axes[EXTREME_AXES] = {
#define X(NAME, name, title) {name, title},
#include "measure/extremes/axes.def"
#undef X
};

const struct extreme_metric_info extreme_metrics[EXTREME_METRICS] = {
#define X(NAME, name, title, unit) {name, title, EXTREME_UNIT_##unit},
#include "measure/extremes/metrics.def"
#undef X
};

enum {
    PIXELS_A_PIECE = 64,
    MOVES_AND_SCALES = 1u << EXTREME_MOVE | 1u << EXTREME_SCALE, // measured against the picture at rest too
};

struct run {
    const struct extremes_input *input;
    const struct extremes_progress *progress;
    struct extremes *out;
    enum extremes_status status;
    struct arena arena; // of the current variant
    struct extreme_base base;
    struct arena base_arena;
    struct variant base_variant, limit_variant;
    uint32_t *taken;           // samples of the device's pixels, if they end by their error
    struct hit_pixel *hits[2]; // device, reference
    double *exact;
    float *rgb, *shown[2]; // the device's picture; displayed: device, reference
    float *rest;           // the device's picture of the base, displayed; NULL: not made
    struct diag_sink sink; // of flattening: its message becomes the reason why a cell is left out
};

static size_t pixels_of(const struct run *run) {
    return heap_times(run->input->width, run->input->height);
}

// ---- the device's side

static enum extremes_status choose_precision(const struct run *run, const struct variant *v,
                                             struct flat_input *input) {
    struct precision_choice choice = {.needs_double = false};
    if (run->input->alternative != RENDER_ALTERNATIVE_NONE)
        return EXTREMES_DONE;
    const struct precision_trial trial = {.input = input,
                                          .width = v->width,
                                          .height = v->height,
                                          .samples = v->samples,
                                          .gpu = run->input->gpu};
    if (v->ir.trace.precision == IR_PRECISION_AUTO) {
        const enum precision_status tried = precision_try(&trial, &choice, NULL);
        if (tried == PRECISION_MEMORY || tried == PRECISION_DEVICE)
            return tried == PRECISION_MEMORY ? EXTREMES_MEMORY : EXTREMES_DEVICE;
    }
    input->is_double = precision_is_double(&v->ir, &choice) && gpu_info(run->input->gpu)->has_double;
    return EXTREMES_DONE;
}

static void show(const void *context, const float *linear, size_t pixels, float *shown) {
    const struct variant *v = context;
    image_to_displayed(linear, pixels, image_display_of(&v->ir.image), shown);
}

static enum extremes_status draw(struct run *run, const struct variant *v, const struct flat_scene *flat) {
    struct render_settings settings = render_settings_of(&v->scene, flat, run->input->limits);
    settings.width = v->width;
    settings.height = v->height;
    settings.samples = v->samples;
    settings.error = v->error;
    settings.least_samples = v->min_samples;
    settings.show = show;
    settings.show_context = v;
    settings.alternative = run->input->alternative;
    struct render_statistics statistics;
    struct renderer *renderer = renderer_create(run->input->gpu, flat, &settings);
    bool good = renderer && renderer_hits(renderer, &v->view.camera, run->hits[0], NULL) == RENDER_DONE &&
                renderer_render(renderer, &v->view.camera, run->rgb, NULL, &statistics) == RENDER_DONE;
    if (good && v->error > 0)
        memcpy(run->taken, renderer_estimate(renderer)->samples, pixels_of(run) * sizeof *run->taken);
    renderer_destroy(renderer);
    return good ? EXTREMES_DONE : EXTREMES_DEVICE;
}

static enum extremes_status trace_flattened(struct run *run, const struct variant *v,
                                            const struct flat_input *input, struct extreme_cell *cell) {
    struct flat_scene flat;
    if (!flatten(input, &flat)) {
        cell->left_out = "its coordinates exceed 1e18";
        return EXTREMES_DONE;
    }
    enum extremes_status status = draw(run, v, &flat);
    flat_finish(&flat);
    return status;
}

static struct flat_input flat_input_of(struct run *run, const struct variant *v) {
    return (struct flat_input){.scene = &v->scene,
                               .view = &v->view,
                               .origin = v->view.camera.position,
                               .limits = run->input->limits,
                               .sink = &run->sink};
}

static enum extremes_status trace_device(struct run *run, const struct variant *v,
                                         struct extreme_cell *cell) {
    struct flat_input input = flat_input_of(run, v);
    const enum extremes_status chosen = choose_precision(run, v, &input);
    if (chosen != EXTREMES_DONE)
        return chosen;
    cell->is_double = input.is_double;
    return trace_flattened(run, v, &input, cell);
}

// ---- the reference's side

// The picture, with as many samples of each pixel as the device took.
struct taking {
    const struct run *run;
    const struct reference *reference;
    struct reference_settings settings;
    atomic_bool failed;
};

static void take_piece(void *context, size_t begin, size_t end) {
    struct taking *t = context;
    const uint32_t width = t->settings.width;
    for (size_t i = begin; i < end; i++) {
        struct reference_settings settings = t->settings;
        settings.samples = t->run->taken[i];
        if (!reference_pixel(t->reference, &settings, (uint32_t)(i % width), (uint32_t)(i / width),
                             t->run->exact + 3 * i))
            atomic_store(&t->failed, true);
    }
}

static bool draw_reference(struct run *run, const struct variant *v, const struct reference *reference,
                           const struct reference_settings *settings) {
    struct reference_statistics statistics;
    if (!(v->error > 0))
        return reference_render(reference, settings, run->exact, NULL, &statistics) == REFERENCE_DONE;
    struct taking taking = {.run = run, .reference = reference, .settings = *settings};
    parallel_for(pixels_of(run), PIXELS_A_PIECE, take_piece, &taking);
    return !atomic_load(&taking.failed);
}

static enum extremes_status trace_reference(struct run *run, const struct variant *v, bool with_picture) {
    const struct reference_input input = {.scene = &v->scene, .view = &v->view};
    struct ir_image image = v->ir.image;
    image.width = (int32_t)v->width;
    image.height = (int32_t)v->height;
    image.samples = (int32_t)v->samples;
    image.error = v->error;
    image.min_samples = (int32_t)v->min_samples;
    const struct reference_settings settings =
        reference_settings_of(&v->ir, &image, run->input->limits, true);
    struct reference *reference = reference_create(&input);
    bool good = reference && reference_hits(reference, &settings, run->hits[1], NULL) == REFERENCE_DONE &&
                (!with_picture || draw_reference(run, v, reference, &settings));
    reference_destroy(reference);
    return good ? EXTREMES_DONE : EXTREMES_MEMORY;
}

// ---- comparing

// Displayed pictures. false: no memory.
static bool measure(const struct run *run, const float *picture, const float *reference,
                    struct measure_result *result) {
    struct measure_options options = measure_options_default();
    options.metrics = 1u << METRIC_MAE | 1u << METRIC_SHARE;
    return measure_pictures(run->input->width, run->input->height, picture, reference, &options, result, NULL,
                            NULL);
}

static bool compare_pictures(struct run *run, const struct variant *v, struct extreme_cell *cell) {
    const size_t count = pixels_of(run);
    struct measure_result result;
    uint64_t not_finite = 0;
    for (size_t i = 0; i < count; i++)
        not_finite += image_is_marked(run->rgb + 3 * i);
    for (size_t i = 0; i < 3 * count; i++)
        run->shown[1][i] = (float)run->exact[i];
    image_to_displayed(run->shown[1], count, image_display_of(&v->ir.image), run->shown[1]);
    image_to_displayed(run->rgb, count, image_display_of(&v->ir.image), run->shown[0]);
    if (!measure(run, run->shown[0], run->shown[1], &result))
        return false;
    cell->measured[EXTREME_NOT_FINITE] = (double)not_finite;
    cell->measured[EXTREME_OFF] = result.value[METRIC_SHARE];
    cell->measured[EXTREME_ERROR] = result.value[METRIC_MAE];
    if (!run->rest || !(MOVES_AND_SCALES >> cell->axis & 1))
        return true;
    if (!measure(run, run->shown[0], run->rest, &result))
        return false;
    cell->measured[EXTREME_CHANGED] = result.value[METRIC_SHARE];
    return true;
}

static void compare_hits(struct run *run, const struct variant *v, struct extreme_cell *cell) {
    struct hit_errors errors;
    hits_compare(v->width, v->height, run->hits[0], run->hits[1], &v->scene, &errors);
    cell->measured[EXTREME_WRONG] = errors.wrong_outside;
    cell->measured[EXTREME_SILHOUETTE] = errors.wrong_inside;
    cell->measured[EXTREME_SELF_HITS] = errors.acne;
    cell->measured[EXTREME_LEAKS] = errors.leaks;
    cell->measured[EXTREME_HOLES] = errors.holes;
}

// Whole paths: how much of the background they see, in the precision of the cell. This modifies the variant.
static enum extremes_status compare_paths(struct run *run, struct variant *v, struct extreme_cell *cell) {
    if (!variant_bounces(v))
        return EXTREMES_DONE;
    variant_show_background(v);
    struct flat_input input = flat_input_of(run, v);
    input.is_double = cell->is_double;
    enum extremes_status status = trace_flattened(run, v, &input, cell);
    if (status == EXTREMES_DONE)
        status = trace_reference(run, v, true);
    if (status == EXTREMES_DONE)
        cell->measured[EXTREME_ESCAPES] = hits_escapes(v->width, v->height, run->rgb, run->exact);
    return status;
}

// The device's own picture of the axis' limit; the cell's own is in shown[0].
static enum extremes_status compare_limit(struct run *run, struct extreme_cell *cell) {
    struct variant *v = &run->limit_variant;
    struct measure_result result;
    double value;
    if (!extreme_limit(cell->axis, cell->value, &value))
        return EXTREMES_DONE;
    if (variant_make(v, &run->arena, &run->base, cell->axis, value))
        return EXTREMES_DONE;
    struct flat_input input = flat_input_of(run, v);
    struct extreme_cell other = {.left_out = NULL};
    input.is_double = cell->is_double;
    const enum extremes_status status = trace_flattened(run, v, &input, &other);
    if (status != EXTREMES_DONE || other.left_out)
        return status;
    image_to_displayed(run->rgb, pixels_of(run), image_display_of(&v->ir.image), run->shown[1]);
    if (!measure(run, run->shown[0], run->shown[1], &result))
        return EXTREMES_MEMORY;
    cell->measured[EXTREME_LIMIT] = result.value[METRIC_SHARE];
    return EXTREMES_DONE;
}

static void judge(const struct extremes_input *input, struct extreme_cell *cell) {
    for (uint32_t i = 0; i < input->bound_count; i++) {
        const struct extreme_bound *b = &input->bounds[i];
        if (!(b->axes >> cell->axis & 1) || cell->value < b->from || cell->value > b->to)
            continue;
        for (int m = 0; m < EXTREME_METRICS; m++)
            cell->bound[m] = fmin(cell->bound[m], b->bound[m]);
    }
    for (int m = 0; m < EXTREME_METRICS; m++)
        if (cell->measured[m] > cell->bound[m])
            cell->broken |= 1u << m;
}

// ---- cells

static enum extremes_status measure_cell(struct run *run, struct extreme_cell *cell) {
    struct variant v;
    arena_reset(&run->arena);
    cell->left_out = variant_make(&v, &run->arena, &run->base, cell->axis, cell->value);
    if (cell->left_out)
        return EXTREMES_DONE;
    enum extremes_status status = trace_device(run, &v, cell);
    if (status != EXTREMES_DONE || cell->left_out)
        return status;
    status = trace_reference(run, &v, true);
    if (status != EXTREMES_DONE)
        return status;
    compare_hits(run, &v, cell);
    if (!compare_pictures(run, &v, cell))
        return EXTREMES_MEMORY;
    status = compare_limit(run, cell);
    if (status == EXTREMES_DONE)
        status = compare_paths(run, &v, cell);
    if (status == EXTREMES_DONE)
        judge(run->input, cell);
    return status;
}

static bool list_cells(struct extremes *out, uint32_t axes) {
    out->cells = heap_zeroed(heap_times(EXTREME_AXES, EXTREME_VALUES_MAX), sizeof *out->cells);
    if (!out->cells)
        return false;
    for (int axis = 0; axis < EXTREME_AXES; axis++) {
        double values[EXTREME_VALUES_MAX];
        const uint32_t count = extreme_values((enum extreme_axis)axis, values);
        for (uint32_t i = 0; (axes >> axis & 1) && i < count; i++) {
            struct extreme_cell *cell = &out->cells[out->count++];
            *cell = (struct extreme_cell){.axis = (enum extreme_axis)axis, .value = values[i]};
            for (int m = 0; m < EXTREME_METRICS; m++)
                cell->measured[m] = cell->bound[m] = (double)NAN;
        }
    }
    return true;
}

// ---- the base

// The nearest surface at the picture's middle that does not refract.
static void find_surface(struct run *run) {
    const struct variant *v = &run->base_variant;
    struct extreme_base *base = &run->base;
    double nearest = HUGE_VAL;
    for (uint32_t y = 0; y < v->height; y++)
        for (uint32_t x = 0; x < v->width; x++) {
            const struct hit_pixel *hit = &run->hits[1][(size_t)y * v->width + x];
            const double from_middle = hypot(x - 0.5 * v->width, y - 0.5 * v->height);
            if (hit->body == HIT_NONE || hit->refracted != HIT_NONE || from_middle >= nearest)
                continue;
            const double aspect = (double)v->width / v->height;
            const struct view_ray ray = view_ray_at(&v->view.camera, aspect, 2 * (x + 0.5) / v->width - 1,
                                                    1 - 2 * (y + 0.5) / v->height);
            nearest = from_middle;
            base->has_surface = true;
            base->surface = vec3_add(ray.start, vec3_mul(ray.direction, hit->distance));
            base->normal = hit->normal;
            base->seen_along = ray.direction;
        }
}

static enum extremes_status make_base(struct run *run) {
    struct variant *v = &run->base_variant;
    variant_copy(v, &run->base_arena, run->input);
    run->base = (struct extreme_base){.input = run->input, .view = v->view, .radius = 1};
    vec3 lower, upper;
    if (scene_bounds(&v->scene, &lower, &upper)) {
        run->base.center = vec3_mul(vec3_add(lower, upper), 0.5);
        run->base.radius = 0.5 * vec3_length(vec3_sub(upper, lower));
    }
    enum extremes_status status = trace_reference(run, v, false);
    if (status == EXTREMES_DONE)
        find_surface(run);
    return status;
}

// Makes the picture that moves and scales are compared with.
static enum extremes_status make_rest(struct run *run) {
    struct extreme_cell cell = {0};
    enum extremes_status status = trace_device(run, &run->base_variant, &cell);
    if (status != EXTREMES_DONE || cell.left_out)
        return status;
    float *rest = heap_array(heap_times(3, pixels_of(run)), sizeof *rest);
    if (!rest)
        return EXTREMES_MEMORY;
    image_to_displayed(run->rgb, pixels_of(run), image_display_of(&run->input->scene->ir->image), rest);
    run->rest = rest;
    return EXTREMES_DONE;
}

// ---- the whole

static bool make_pictures(struct run *run) {
    const size_t count = pixels_of(run);
    for (int i = 0; i < 2; i++) {
        run->hits[i] = heap_array(count, sizeof *run->hits[i]);
        run->shown[i] = heap_array(heap_times(3, count), sizeof *run->shown[i]);
    }
    run->exact = heap_array(heap_times(3, count), sizeof *run->exact);
    run->rgb = heap_array(heap_times(3, count), sizeof *run->rgb);
    run->taken = heap_array(count, sizeof *run->taken);
    return run->hits[0] && run->hits[1] && run->shown[0] && run->shown[1] && run->exact && run->rgb &&
           run->taken;
}

static enum extremes_status measure_cells(struct run *run) {
    struct extremes *out = run->out;
    const struct extremes_progress *progress = run->progress;
    if (!make_pictures(run) || !list_cells(out, run->input->axes))
        return EXTREMES_MEMORY;
    enum extremes_status status = make_base(run);
    if (status == EXTREMES_DONE && (run->input->axes & MOVES_AND_SCALES))
        status = make_rest(run);
    for (uint32_t i = 0; status == EXTREMES_DONE && i < out->count; i++) {
        struct extreme_cell *cell = &out->cells[i];
        const double start = clock_seconds();
        if (progress && progress->report &&
            !progress->report(progress->context, (double)i / out->count, cell))
            return EXTREMES_CANCELLED;
        status = measure_cell(run, cell);
        cell->seconds = clock_seconds() - start;
        out->broken += cell->broken != 0;
        out->left_out += cell->left_out != NULL;
    }
    return status;
}

static void finish(struct run *run) {
    for (int i = 0; i < 2; i++) {
        free(run->hits[i]);
        free(run->shown[i]);
    }
    free(run->exact);
    free(run->rgb);
    free(run->taken);
    free(run->rest);
    diag_sink_finish(&run->sink);
    arena_finish(&run->arena);
    arena_finish(&run->base_arena);
}

static void measure_all(void *context) {
    struct run *run = context;
    run->status = measure_cells(run);
}

enum extremes_status extremes_run(struct extremes *out, const struct extremes_input *input,
                                  const struct extremes_progress *progress) {
    const double start = clock_seconds();
    *out = (struct extremes){0};
    struct run *run = heap_zeroed(1, sizeof *run);
    if (!run)
        return EXTREMES_MEMORY;
    *run = (struct run){.input = input, .out = out, .progress = progress};
    diag_sink_init(&run->sink);
    arena_init(&run->arena, SIZE_MAX);
    arena_init(&run->base_arena, SIZE_MAX);
    snprintf(out->device, sizeof out->device, "%s", gpu_info(input->gpu)->name);
    struct arena *arenas[] = {&run->arena, &run->base_arena, NULL};
    enum arena_fault fault = arena_guarded_all(arenas, measure_all, run);
    enum extremes_status status = fault ? EXTREMES_MEMORY : run->status;
    out->seconds = clock_seconds() - start;
    finish(run);
    free(run);
    return status;
}

void extremes_finish(struct extremes *extremes) {
    if (!extremes)
        return;
    free(extremes->cells);
    *extremes = (struct extremes){0};
}
