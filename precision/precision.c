#include "precision/precision.h"

#include "core/clock.h"
#include "core/heap.h"
#include "core/timeline.h"
#include "grammar/ir.h"
#include "picture/write/image.h"
#include "reference/reference.h"
#include "scene/scene.h"
#include "tracer/render/render.h"

#include <math.h>
#include <stdlib.h>

enum {
    PIXELS = 8192,      // of the small picture at most,
    LEAST_PIXELS = 192, // and at least, whatever they cost
    ALL_RAYS = 800000,  // of the small picture, about
    RAYS = 4096,        // of a pixel at most, the heaviest ones
};

struct small {
    const struct precision_trial *trial;
    struct view view; // that of `reference`, too
    struct reference *reference;
    struct precision_gains device; // the scene in single precision, where there is a device
    uint32_t width, height;
    bool whole; // no smaller than the picture
    double *exact, *rounded;
    float *shown[2];
};

// A part of a pixel aside, and as much askew over the picture: where a scene is as symmetric as its view,
// whole columns of pixels would else lie on edges and on the lines of checkers.
static void turn_camera(struct small *small) {
    struct view_camera *camera = &small->view.camera;
    const bool is_parallel = camera->projection == IR_PROJECTION_ORTHOGRAPHIC;
    const double height = is_parallel ? camera->half_height : camera->tan_half_fov;
    const double pixel = 2 * height / small->height, part = 0.381966;
    const vec3 aside = vec3_add(vec3_mul(camera->right, pixel * part), vec3_mul(camera->up, -pixel * part));
    if (is_parallel)
        camera->position = vec3_add(camera->position, aside);
    else
        camera->forward = vec3_unit(vec3_add(camera->forward, aside));
    const vec3 askew = vec3_add(camera->right, vec3_mul(camera->up, 1.0 / small->width));
    const double along = vec3_dot(askew, camera->forward);
    camera->right = vec3_unit(vec3_sub(askew, vec3_mul(camera->forward, along)));
    camera->up = vec3_cross(camera->right, camera->forward);
}

static void choose_size(struct small *small, double pixels) {
    const double width = small->trial->width, height = small->trial->height;
    small->whole = width * height <= 2 * pixels;
    small->width = small->trial->width;
    small->height = small->trial->height;
    small->view.camera = small->trial->input->view->camera;
    if (small->whole)
        return;
    small->width = (uint32_t)fmin(width, fmax(1, round(sqrt(pixels * width / height))));
    small->height = (uint32_t)fmin(height, fmax(1, round(pixels / small->width)));
    turn_camera(small);
}

static size_t values_of(const struct small *small) {
    return heap_times(heap_times(3, small->width), small->height);
}

static struct reference *make_reference(const struct small *small, bool as_single) {
    const struct reference_input input = {.scene = small->trial->input->scene,
                                          .view = &small->view,
                                          .as_single = as_single,
                                          .no_bound = true,
                                          .gradient = !small->trial->gpu};
    return reference_create(&input);
}

static bool draw_reference(const struct small *small, const struct reference *reference, double *rgb,
                           struct reference_statistics *statistics) {
    const struct flat_input *input = small->trial->input;
    const struct ir_scene *ir = input->scene->ir;
    struct reference_settings settings = reference_settings_of(ir, &ir->image, input->limits, true);
    settings.width = small->width;
    settings.height = small->height;
    settings.samples = 1;
    settings.segments = RAYS;
    settings.as_file = false; // the heaviest rays first
    return reference_render(reference, &settings, rgb, NULL, statistics) == REFERENCE_DONE;
}

static struct render_settings device_settings(const struct small *small) {
    const struct flat_input *input = small->trial->input;
    struct render_settings settings = render_settings_of(input->scene, &small->device.flat, input->limits);
    settings.width = small->width;
    settings.height = small->height;
    settings.samples = 1;
    settings.features |= small->trial->features;
    settings.counts = small->trial->counts;
    settings.background_later = small->trial->ready != NULL;
    settings.timeline = input->timeline;
    return settings;
}

// What needs no pixels of the background: the scene on the device, and its kernel. Its size is not known yet.
static enum precision_status prepare_device(struct small *small) {
    struct flat_input input = *small->trial->input;
    input.is_double = false;
    small->device.has_flat = flatten(&input, &small->device.flat);
    if (!small->device.has_flat)
        return PRECISION_SCENE;
    choose_size(small, LEAST_PIXELS);
    const struct render_settings settings = device_settings(small);
    small->device.renderer = renderer_create(small->trial->gpu, &small->device.flat, &settings);
    return small->device.renderer ? PRECISION_DONE : PRECISION_DEVICE;
}

static bool draw_device(const struct small *small, double *rgb) {
    const struct render_settings settings = device_settings(small);
    struct renderer *renderer = small->device.renderer;
    struct render_statistics statistics;
    float *values = small->shown[0];
    const bool good =
        renderer_change(renderer, &small->device.flat, &settings) &&
        renderer_render(renderer, &small->view.camera, values, NULL, &statistics) == RENDER_DONE;
    for (size_t i = 0; good && i < values_of(small); i++)
        rgb[i] = (double)values[i];
    return good;
}

// Compares as displayed.
static void compare(const struct small *small, struct precision_choice *out) {
    const struct ir_image *image = &small->trial->input->scene->ir->image;
    const struct image_display display = {image->tone, image->transfer};
    const double *pictures[2] = {small->exact, small->rounded};
    out->pixels = small->width * small->height;
    out->off = 0;
    out->traced = true;
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < values_of(small); i++)
            small->shown[k][i] = (float)pictures[k][i];
        image_to_displayed(small->shown[k], out->pixels, display, small->shown[k]);
    }
    for (size_t i = 0; i < values_of(small); i += 3) {
        bool off = false;
        // What no float holds, no precision of places mends.
        const bool finite =
            isfinite(small->rounded[i]) && isfinite(small->rounded[i + 1]) && isfinite(small->rounded[i + 2]);
        for (size_t k = i; k < i + 3 && finite; k++)
            off = off || !(fabs((double)small->shown[0][k] - (double)small->shown[1][k]) <= PRECISION_OFF);
        out->off += off;
    }
    out->needs_double = out->off > PRECISION_SHARE * (small->whole ? 1 : PRECISION_PART) * out->pixels;
}

static enum precision_status try_device(struct small *small, struct precision_choice *out) {
    out->on_device = draw_device(small, small->rounded);
    if (out->on_device)
        compare(small, out);
    return out->on_device ? PRECISION_DONE : PRECISION_DEVICE;
}

static bool forecast(struct small *small, struct precision_choice *out) {
    struct reference *single = make_reference(small, true);
    const bool good = single && draw_reference(small, single, small->rounded, NULL);
    reference_destroy(single);
    if (good)
        compare(small, out);
    return good;
}

static enum precision_status try_small(struct small *small, struct precision_choice *out) {
    struct reference_statistics statistics;
    if (!draw_reference(small, small->reference, small->exact, &statistics))
        return PRECISION_MEMORY;
    // A device follows all rays, so what was cut here cannot be compared with it.
    if (small->trial->gpu && !statistics.cut_by_segments)
        return try_device(small, out);
    return forecast(small, out) ? PRECISION_DONE : PRECISION_MEMORY;
}

// How many pixels the small picture may have: a very small one tells what they cost.
static bool afford(struct small *small, double *pixels) {
    struct reference_statistics statistics;
    choose_size(small, LEAST_PIXELS);
    double *rgb = heap_array(values_of(small), sizeof *rgb);
    const bool good = rgb && draw_reference(small, small->reference, rgb, &statistics);
    free(rgb);
    if (!good)
        return false;
    const double rays =
        (double)(statistics.primary + statistics.reflected + statistics.refracted + statistics.shadow);
    const double each = rays / ((double)small->width * small->height);
    *pixels = fmax(LEAST_PIXELS, fmin(PIXELS, ALL_RAYS / fmax(each, 1)));
    return true;
}

static bool make_pictures(struct small *small) {
    small->exact = heap_array(values_of(small), sizeof *small->exact);
    small->rounded = heap_array(values_of(small), sizeof *small->rounded);
    for (int i = 0; i < 2; i++)
        small->shown[i] = heap_array(values_of(small), sizeof *small->shown[i]);
    return small->exact && small->rounded && small->shown[0] && small->shown[1];
}

// Up to where pixels of the background are needed, and until they are there.
static enum precision_status prepare(struct small *small, struct precision_report *report) {
    const struct precision_trial *trial = small->trial;
    small->view = *trial->input->view;
    // First what goes on in the driver's threads.
    const enum precision_status status = trial->gpu ? prepare_device(small) : PRECISION_DONE;
    if (status != PRECISION_DONE)
        return status;
    small->reference = make_reference(small, false);
    if (!small->reference || !precision_measure(trial->input, report))
        return PRECISION_MEMORY;
    if (!trial->ready)
        return PRECISION_DONE;
    if (!trial->ready(trial->ready_context))
        return PRECISION_ENDED;
    return !trial->gpu || renderer_background(small->device.renderer) ? PRECISION_DONE : PRECISION_DEVICE;
}

static bool make_small(struct small *small) {
    double pixels;
    if (!afford(small, &pixels))
        return false;
    choose_size(small, pixels);
    return make_pictures(small);
}

static void leave_reference(struct small *small) {
    if (!small->trial->reference || !small->trial->gpu || !small->reference)
        return;
    reference_look(small->reference, small->trial->input->view);
    *small->trial->reference = small->reference;
    small->reference = NULL;
}

void precision_drop(struct precision_gains *gains) {
    renderer_destroy(gains->renderer);
    flat_finish(&gains->flat);
    *gains = (struct precision_gains){0};
}

static void finish_small(struct small *small) {
    precision_drop(&small->device);
    reference_destroy(small->reference);
    free(small->exact);
    free(small->rounded);
    free(small->shown[0]);
    free(small->shown[1]);
}

static uint64_t size_of(const struct scene *scene) {
    uint64_t sum = 0;
    for (uint32_t i = 0; i < scene->body_count; i++)
        sum += scene->bodies[i].shape == SCENE_SPHERE ? 1 : scene->bodies[i].triangle_count;
    return sum;
}

static enum precision_status try_traced(struct small *small, struct precision_choice *out) {
    enum precision_status status = prepare(small, &out->report);
    if (status != PRECISION_DONE)
        return status;
    const double start = clock_seconds();
    status = make_small(small) ? try_small(small, out) : PRECISION_MEMORY;
    timeline_add(small->trial->input->timeline, "trial", STR(""), start);
    return status;
}

enum precision_status precision_try(const struct precision_trial *trial, struct precision_choice *out,
                                    struct precision_gains *gains) {
    struct small small = {.trial = trial};
    *out = (struct precision_choice){.pixels = 0};
    if (gains)
        *gains = (struct precision_gains){0};
    if (size_of(trial->input->scene) > PRECISION_TRACED) {
        if (!precision_measure(trial->input, &out->report))
            return PRECISION_MEMORY;
        out->needs_double = !out->report.suffices;
        return PRECISION_DONE;
    }
    const enum precision_status status = try_traced(&small, out);
    if (status == PRECISION_DONE)
        leave_reference(&small);
    if (status == PRECISION_DONE && gains && !out->needs_double) {
        *gains = small.device;
        small.device = (struct precision_gains){0};
    }
    finish_small(&small);
    return status;
}

bool precision_is_double(const struct ir_scene *ir, const struct precision_choice *choice) {
    return ir->trace.precision == IR_PRECISION_DOUBLE ||
           (ir->trace.precision == IR_PRECISION_AUTO && choice->needs_double);
}
