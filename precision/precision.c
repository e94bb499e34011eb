#include "precision/precision.h"

#include "core/heap.h"
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
    uint32_t width, height;
    bool whole; // no smaller than the picture
    double *exact, *rounded;
    float *shown[2];
};

// A part of a pixel aside, and as much askew over the picture: where a scene is as symmetric as its view,
// whole columns of pixels would else lie on edges and on the lines of checkers.
static void turn_camera(struct small *small) {
    struct view_camera *camera = &small->view.camera;
    const double pixel = 2 * camera->tan_half_fov / small->height, part = 0.381966;
    const vec3 aside = vec3_add(vec3_mul(camera->right, pixel * part), vec3_mul(camera->up, -pixel * part));
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
    return 3 * (size_t)small->width * small->height;
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

static bool draw_device(const struct small *small, const struct flat_scene *flat, double *rgb) {
    const struct flat_input *input = small->trial->input;
    struct render_settings settings = render_settings_of(input->scene, flat, input->limits);
    settings.width = small->width;
    settings.height = small->height;
    settings.samples = 1;
    settings.features |= small->trial->features;
    struct render_statistics statistics;
    float *values = small->shown[0];
    struct renderer *renderer = renderer_create(small->trial->gpu, flat, &settings);
    const bool good =
        renderer && renderer_render(renderer, &small->view.camera, values, NULL, &statistics) == RENDER_DONE;
    renderer_destroy(renderer);
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

static enum precision_status try_device(struct small *small, struct precision_choice *out,
                                        struct flat_scene *flat, bool *has_flat) {
    struct flat_input input = *small->trial->input;
    struct flat_scene made;
    input.is_double = false;
    if (!flatten(&input, &made))
        return PRECISION_SCENE;
    const bool good = draw_device(small, &made, small->rounded);
    if (good)
        compare(small, out);
    out->on_device = good;
    *has_flat = good && flat && !out->needs_double;
    if (*has_flat)
        *flat = made;
    else
        flat_finish(&made);
    return good ? PRECISION_DONE : PRECISION_DEVICE;
}

static bool forecast(struct small *small, struct precision_choice *out) {
    struct reference *single = make_reference(small, true);
    const bool good = single && draw_reference(small, single, small->rounded, NULL);
    reference_destroy(single);
    if (good)
        compare(small, out);
    return good;
}

static enum precision_status try_small(struct small *small, struct precision_choice *out,
                                       struct flat_scene *flat, bool *has_flat) {
    struct reference_statistics statistics;
    if (!draw_reference(small, small->reference, small->exact, &statistics))
        return PRECISION_MEMORY;
    // A device follows all rays, so what was cut here cannot be compared with it.
    if (small->trial->gpu && !statistics.cut_by_segments)
        return try_device(small, out, flat, has_flat);
    return forecast(small, out) ? PRECISION_DONE : PRECISION_MEMORY;
}

// How many pixels the small picture may have: a very small one tells what they cost.
static bool afford(struct small *small, double *pixels) {
    struct reference_statistics statistics;
    choose_size(small, LEAST_PIXELS);
    double *rgb = heap_alloc(values_of(small) * sizeof *rgb);
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
    small->exact = heap_alloc(values_of(small) * sizeof *small->exact);
    small->rounded = heap_alloc(values_of(small) * sizeof *small->rounded);
    for (int i = 0; i < 2; i++)
        small->shown[i] = heap_alloc(values_of(small) * sizeof *small->shown[i]);
    return small->exact && small->rounded && small->shown[0] && small->shown[1];
}

static bool make_small(struct small *small) {
    double pixels;
    small->view = *small->trial->input->view;
    small->reference = make_reference(small, false);
    if (!small->reference || !afford(small, &pixels))
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

static void finish_small(struct small *small) {
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

enum precision_status precision_try(const struct precision_trial *trial, struct precision_choice *out,
                                    struct flat_scene *flat, bool *has_flat) {
    struct small small = {.trial = trial};
    *out = (struct precision_choice){.pixels = 0};
    *has_flat = false;
    if (!precision_measure(trial->input, &out->report))
        return PRECISION_MEMORY;
    if (size_of(trial->input->scene) > PRECISION_TRACED) {
        out->needs_double = !out->report.suffices;
        return PRECISION_DONE;
    }
    const enum precision_status status =
        make_small(&small) ? try_small(&small, out, flat, has_flat) : PRECISION_MEMORY;
    if (status == PRECISION_DONE)
        leave_reference(&small);
    finish_small(&small);
    return status;
}

bool precision_is_double(const struct ir_scene *ir, const struct precision_choice *choice) {
    return ir->trace.precision == IR_PRECISION_DOUBLE ||
           (ir->trace.precision == IR_PRECISION_AUTO && choice->needs_double);
}
