#include "tests/sweep/sweep.h"

#include "core/heap.h"

#include "core/clock.h"
#include "grammar/ir.h"
#include "measure/hit_errors.h"
#include "measure/precision.h"
#include "picture/write/image.h"
#include "reference/reference.h"
#include "shaders/features.h"
#include "tracer/render/render.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

const char *const sweep_verdict_names[SWEEP_VERDICTS] = {
    [SWEEP_RIGHT] = "right",
    [SWEEP_WRONG] = "wrong",
    [SWEEP_NEEDLESS] = "needless",
    [SWEEP_BEYOND] = "beyond",
};

// What one scene's judging works on.
struct judging {
    const struct sweep_input *input;
    const struct sweep_scene *made;
    const struct scene *scene;
    struct view view;
    struct sweep_item *item;
    size_t pixels;
    float *rgb, *shown[2]; // linear; displayed: reference, another
    double *exact;
    struct hit_pixel *hits[2]; // reference, another
    struct arena arena;
    struct diag_sink sink; // of flattening; the status says enough
    enum sweep_status status;
};

// ---- what a picture shows

// Of closed rooms, however deep; a pixel that is not a number is as wrong.
static uint32_t count_bright(const struct judging *j, const float *rgb) {
    uint32_t count = 0;
    for (size_t i = 0; i < j->pixels; i++) {
        const float *p = rgb + 3 * i;
        count += image_is_marked(p) || (double)fmaxf(p[0], fmaxf(p[1], p[2])) > SWEEP_BRIGHT;
    }
    return count;
}

static uint32_t count_holes(const struct judging *j) {
    struct hit_errors errors;
    hits_compare(j->input->width, j->input->height, j->hits[1], j->hits[0], j->scene, &errors);
    return (uint32_t)lround(errors.holes * 1e-6 * (double)j->pixels);
}

static double share_off(const struct judging *j, const float *rgb) {
    uint64_t off = 0;
    for (size_t i = 0; i < j->pixels; i++) {
        bool differs = image_is_marked(rgb + 3 * i);
        for (size_t k = 3 * i; k < 3 * i + 3; k++)
            differs = differs || fabs((double)j->shown[1][k] - (double)j->shown[0][k]) > SWEEP_OFF;
        off += differs;
    }
    return (double)off / (double)j->pixels;
}

static struct image_display display_of(const struct judging *j) {
    return image_display_of(&j->scene->ir->image);
}

static void take_picture(struct judging *j, enum sweep_tracer tracer) {
    struct sweep_picture *picture = &j->item->pictures[tracer];
    image_to_displayed(j->rgb, j->pixels, display_of(j), j->shown[tracer != SWEEP_REFERENCE]);
    if (j->made->closed)
        picture->background = count_bright(j, j->rgb);
    else if (tracer != SWEEP_REFERENCE)
        picture->background = count_holes(j);
    if (tracer != SWEEP_REFERENCE)
        picture->off = share_off(j, j->rgb);
    picture->wrong = picture->off > SWEEP_SHARE || picture->background > 0;
}

// ---- tracing

static enum sweep_status trace_reference(struct judging *j) {
    const struct reference_input input = {.scene = j->scene, .view = &j->view};
    struct ir_image image = j->scene->ir->image;
    image.width = (int32_t)j->input->width;
    image.height = (int32_t)j->input->height;
    const struct reference_settings settings =
        reference_settings_of(j->scene->ir, &image, j->input->limits, true);
    struct reference *reference = reference_create(&input);
    const bool good =
        reference && reference_render(reference, &settings, j->exact, NULL, NULL) == REFERENCE_DONE &&
        (j->made->closed || reference_hits(reference, &settings, j->hits[0], NULL) == REFERENCE_DONE);
    reference_destroy(reference);
    for (size_t i = 0; good && i < 3 * j->pixels; i++)
        j->rgb[i] = (float)j->exact[i];
    return good ? SWEEP_DONE : SWEEP_MEMORY;
}

// The kernel is the general one, for every scene the same: compiling one for each would take longer than
// all else. `gains`: what the trial left, which is used again.
static enum sweep_status trace_device(struct judging *j, struct flat_input *input,
                                      struct precision_gains *gains) {
    gains->has_flat = gains->has_flat || flatten(input, &gains->flat);
    if (!gains->has_flat)
        return SWEEP_COORDINATES;
    struct render_settings settings = render_settings_of(j->scene, &gains->flat, j->input->limits);
    settings.width = j->input->width;
    settings.height = j->input->height;
    settings.features |= FEATURE_GENERAL;
    struct render_statistics statistics;
    bool good;
    if (gains->renderer)
        good = renderer_change(gains->renderer, &gains->flat, &settings);
    else
        good = (gains->renderer = renderer_create(j->input->gpu, &gains->flat, &settings)) != NULL;
    const struct view_camera *camera = &j->view.camera;
    good = good &&
           (j->made->closed || renderer_hits(gains->renderer, camera, j->hits[1], NULL) == RENDER_DONE) &&
           renderer_render(gains->renderer, camera, j->rgb, NULL, &statistics) == RENDER_DONE;
    precision_drop(gains);
    return good ? SWEEP_DONE : SWEEP_DEVICE;
}

static enum sweep_verdict verdict_of(const struct sweep_item *item) {
    const bool single = item->pictures[SWEEP_SINGLE].wrong, twofold = item->pictures[SWEEP_DOUBLE].wrong;
    if (twofold)
        return SWEEP_BEYOND;
    if (item->is_double)
        return single ? SWEEP_RIGHT : SWEEP_NEEDLESS;
    return single ? SWEEP_WRONG : SWEEP_RIGHT;
}

static enum sweep_status judge_pictures(struct judging *j) {
    struct flat_input input = {.scene = j->scene,
                               .view = &j->view,
                               .origin = j->view.camera.position,
                               .limits = j->input->limits,
                               .sink = &j->sink};
    struct precision_choice choice;
    struct precision_gains gains;
    const struct precision_trial trial = {.input = &input,
                                          .width = j->input->width,
                                          .height = j->input->height,
                                          .samples = (uint32_t)j->scene->ir->image.samples,
                                          .gpu = j->input->gpu,
                                          .features = FEATURE_GENERAL};
    const enum precision_status tried = precision_try(&trial, &choice, &gains);
    if (tried != PRECISION_DONE)
        return tried == PRECISION_MEMORY  ? SWEEP_MEMORY
               : tried == PRECISION_SCENE ? SWEEP_COORDINATES
                                          : SWEEP_DEVICE;
    const struct precision_measure *least = &choice.report.least[choice.report.decides];
    j->item->is_double = precision_is_double(j->scene->ir, &choice);
    j->item->steps = least->any ? least->steps : (double)INFINITY;
    j->item->trial_off = choice.share;
    enum sweep_status status = trace_reference(j);
    if (status == SWEEP_DONE)
        take_picture(j, SWEEP_REFERENCE);
    if (status == SWEEP_DONE)
        status = trace_device(j, &input, &gains);
    if (status == SWEEP_DONE)
        take_picture(j, SWEEP_SINGLE);
    // Where single precision is right, double is too.
    input.is_double = true;
    if (status == SWEEP_DONE && j->item->pictures[SWEEP_SINGLE].wrong) {
        status = trace_device(j, &input, &gains);
        if (status == SWEEP_DONE)
            take_picture(j, SWEEP_DOUBLE);
    }
    precision_drop(&gains);
    return status;
}

static void judge_guarded(void *context) {
    struct judging *j = context;
    const size_t pixels = j->pixels;
    j->rgb = ARENA_ARRAY(&j->arena, float, heap_times(3, pixels));
    j->exact = ARENA_ARRAY(&j->arena, double, heap_times(3, pixels));
    for (int i = 0; i < 2; i++) {
        j->shown[i] = ARENA_ARRAY(&j->arena, float, heap_times(3, pixels));
        j->hits[i] = ARENA_ARRAY(&j->arena, struct hit_pixel, pixels);
    }
    view_build(j->scene, 0, (int32_t)j->input->width, (int32_t)j->input->height, &j->arena, NULL, &j->view);
    j->status = judge_pictures(j);
}

enum sweep_status sweep_judge(struct sweep *sweep, const struct sweep_input *input,
                              const struct sweep_scene *made, const struct scene *scene) {
    const double start = clock_seconds();
    struct sweep_item *item = &sweep->items[sweep->count];
    struct judging j = {.input = input, .made = made, .scene = scene, .item = item};
    *item = (struct sweep_item){.family = made->family, .number = made->number};
    j.pixels = (size_t)input->width * input->height;
    arena_init(&j.arena, SIZE_MAX);
    diag_sink_init(&j.sink);
    if (arena_guarded(&j.arena, judge_guarded, &j))
        j.status = SWEEP_MEMORY;
    diag_sink_finish(&j.sink);
    arena_finish(&j.arena);
    if (j.status != SWEEP_DONE)
        return j.status;
    item->verdict = verdict_of(item);
    item->seconds = clock_seconds() - start;
    sweep->verdicts[item->verdict]++;
    sweep->doubles += item->is_double;
    sweep->seconds += item->seconds;
    sweep->count++;
    return SWEEP_DONE;
}

// ---- the whole

bool sweep_init(struct sweep *sweep, const struct sweep_input *input) {
    *sweep = (struct sweep){0};
    sweep->items = heap_zeroed((size_t)input->count + 1, sizeof *sweep->items);
    snprintf(sweep->device, sizeof sweep->device, "%s", gpu_info(input->gpu)->name);
    return sweep->items != NULL;
}

void sweep_finish(struct sweep *sweep) {
    free(sweep->items);
    *sweep = (struct sweep){0};
}

void sweep_which(const struct sweep_input *input, uint32_t index, enum sweep_family *family,
                 uint32_t *number) {
    uint32_t wanted[SWEEP_FAMILIES], count = 0;
    for (uint32_t i = 0; i < SWEEP_FAMILIES; i++)
        if (input->families >> i & 1)
            wanted[count++] = i;
    *family = (enum sweep_family)wanted[index % count];
    *number = index / count;
}

double sweep_needless(const struct sweep *sweep) {
    return sweep->doubles ? (double)sweep->verdicts[SWEEP_NEEDLESS] / sweep->doubles : 0;
}

bool sweep_is_noted(const struct sweep_item *item) {
    return item->verdict != SWEEP_RIGHT || item->pictures[SWEEP_REFERENCE].wrong;
}

bool sweep_is_broken(const struct sweep_report *report) {
    return report->sweep->verdicts[SWEEP_WRONG] > report->max_wrong ||
           sweep_needless(report->sweep) > report->max_needless;
}
