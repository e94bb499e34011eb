#include "measure/precision.h"

#include "core/clock.h"
#include "core/heap.h"
#include "core/timeline.h"
#include "grammar/ir.h"
#include "measure/share.h"
#include "picture/write/image.h"
#include "reference/reference.h"
#include "scene/scene.h"
#include "scene/shape.h"
#include "tracer/render/render.h"

#include <math.h>
#include <stdlib.h>

enum {
    CELLS = 4600,             // pixels of the first look: if none is off, at most PRECISION_SHARE is, by RISK
    LEAST_PIXELS = 192,       // of a look, whatever they cost; and of a look that measures their cost
    ALL_RAYS = 800000,        // of all looks, about
    RAYS = 4096,              // of a sample at most, the heaviest rays
    SAMPLES_MOST = 8,         // of a pixel
    LOOKED_SAMPLES = 1 << 17, // of all looks at a small picture, at most
    LOOKED_PART = 16,         // and at a large one: this fraction of its own
};
static const double RISK = 0.01; // that a look is wrong about the share of all pixels

struct small {
    const struct precision_trial *trial;
    struct view view; // that of `reference`, too
    struct reference *reference;
    struct precision_gains device; // the scene in single precision, where there is a device
    uint32_t look;                 // how many looks there were before
    uint32_t width, height;        // of this look
    double apart;                  // this many of the picture's pixels lie between two of this look
    bool whole;                    // all of the picture's pixels are seen
    uint32_t samples, all_samples; // of a pixel: traced; in the picture
    double rays_each;              // of a sample, about
    uint32_t rare;                 // pixels that one sample of all could put off, of those seen
    double *exact, *rounded;
    float *shown[3];
};

// Shifts the camera by a fraction of a pixel, different for each look, and tilts it as much over the picture:
// if a scene is as symmetric as its view, whole columns of pixels would otherwise lie on edges and on the
// lines of checkers.
static void turn_camera(struct small *small) {
    struct view_camera *camera = &small->view.camera;
    const bool is_parallel = camera->projection == IR_PROJECTION_ORTHOGRAPHIC;
    const double height = is_parallel ? camera->half_height : camera->tan_half_fov;
    const double pixel = 2 * height / small->height;
    double x, y;
    view_sample_offset(small->look + 1, &x, &y);
    const vec3 aside =
        vec3_add(vec3_mul(camera->right, pixel * (x - 0.5)), vec3_mul(camera->up, pixel * (y - 0.5)));
    if (is_parallel)
        camera->position = vec3_add(camera->position, aside);
    else
        camera->forward = vec3_unit(vec3_add(camera->forward, aside));
    const vec3 askew = vec3_add(camera->right, vec3_mul(camera->up, 1.0 / small->width));
    const double along = vec3_dot(askew, camera->forward);
    camera->right = vec3_unit(vec3_sub(askew, vec3_mul(camera->forward, along)));
    camera->up = vec3_cross(camera->right, camera->forward);
}

// Chooses the size of the next look, at `cells` pixels after `seen` others: a grid of pixels that lie apart,
// but are as small as the picture's and have its samples, or the whole picture.
static void choose_size(struct small *small, double cells, double seen) {
    const double width = small->trial->width, height = small->trial->height;
    small->whole = width * height <= 2 * (seen + cells);
    small->width = small->trial->width;
    small->height = small->trial->height;
    small->apart = 1;
    small->view.camera = small->trial->input->view->camera;
    if (small->whole)
        return;
    small->width = (uint32_t)fmin(width, fmax(1, round(sqrt(cells * width / height))));
    small->height = (uint32_t)fmin(height, fmax(1, round(cells / small->width)));
    small->apart = height / small->height;
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
    settings.samples = small->samples;
    settings.planned = small->all_samples;
    settings.points_of = settings.footprint_of = 0;
    settings.apart = small->apart;
    settings.segments = RAYS;
    settings.as_file = false; // the heaviest rays first
    return reference_render(reference, &settings, rgb, NULL, statistics) == REFERENCE_DONE;
}

static struct render_settings device_settings(const struct small *small) {
    const struct flat_input *input = small->trial->input;
    struct render_settings settings = render_settings_of(input->scene, &small->device.flat, input->limits);
    settings.width = small->width;
    settings.height = small->height;
    settings.samples = small->samples;
    settings.whole_samples = small->all_samples;
    settings.apart = small->apart;
    settings.features |= small->trial->features;
    settings.background_later = small->trial->ready != NULL;
    settings.timeline = input->timeline;
    return settings;
}

// Prepares what needs no background pixels: the scene on the device, and its kernel. The size is not known
// yet.
static enum precision_status prepare_device(struct small *small) {
    struct flat_input input = *small->trial->input;
    input.is_double = false;
    small->device.has_flat = flatten(&input, &small->device.flat);
    if (!small->device.has_flat)
        return PRECISION_SCENE;
    choose_size(small, LEAST_PIXELS, 0);
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

static bool is_off(const struct small *small, int other, size_t pixel) {
    bool off = false;
    for (size_t k = 3 * pixel; k < 3 * pixel + 3; k++)
        off = off || !(fabs((double)small->shown[0][k] - (double)small->shown[other][k]) <= PRECISION_OFF);
    return off;
}

// For pictures with more samples than are traced: an error in one sample is a smaller part of the pixel, but
// more samples may be wrong.
static double weaker(const struct small *small, size_t i) {
    const double part = (double)small->samples / small->all_samples;
    return small->exact[i] + (small->rounded[i] - small->exact[i]) * part;
}

// Compares as displayed: how many pixels are off, and how many would be, given each sample's share of all.
static void compare(struct small *small, struct precision_choice *out) {
    const struct ir_image *image = &small->trial->input->scene->ir->image;
    const struct image_display display = image_display_of(image);
    const uint32_t pixels = small->width * small->height;
    for (size_t i = 0; i < values_of(small); i++) {
        small->shown[0][i] = (float)small->exact[i];
        small->shown[1][i] = (float)small->rounded[i];
        small->shown[2][i] = (float)weaker(small, i);
    }
    for (int k = 0; k < 3; k++)
        image_to_displayed(small->shown[k], pixels, display, small->shown[k]);
    out->traced = true;
    out->pixels = small->whole ? pixels : out->pixels + pixels;
    if (small->whole)
        out->off = small->rare = 0;
    for (size_t i = 0; i < pixels; i++) {
        const double *p = small->rounded + 3 * i;
        // Values that no float holds are not mended by a higher precision of places.
        if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2]))
            continue;
        out->off += is_off(small, 1, i);
        small->rare += is_off(small, 2, i);
    }
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

static enum precision_status look(struct small *small, struct precision_choice *out) {
    struct reference_statistics statistics;
    if (!draw_reference(small, small->reference, small->exact, &statistics))
        return PRECISION_MEMORY;
    // A device follows all rays, so what was cut here cannot be compared with it.
    if (small->trial->gpu && !statistics.cut_by_segments)
        return try_device(small, out);
    return forecast(small, out) ? PRECISION_DONE : PRECISION_MEMORY;
}

// Measures the cost of a sample with a very small picture.
static bool measure_rays(struct small *small) {
    struct reference_statistics statistics;
    choose_size(small, LEAST_PIXELS, 0);
    double *rgb = heap_array(values_of(small), sizeof *rgb);
    const bool good = rgb && draw_reference(small, small->reference, rgb, &statistics);
    free(rgb);
    if (!good)
        return false;
    const double rays =
        (double)(statistics.primary + statistics.reflected + statistics.refracted + statistics.shadow);
    small->rays_each = fmax(1, rays / ((double)small->width * small->height * small->samples));
    return true;
}

// For the first look: as many pixels and samples as can be afforded.
static double first_cells(struct small *small) {
    while (small->samples > 1 && CELLS * small->samples * small->rays_each > ALL_RAYS)
        small->samples /= 2;
    return fmax(LEAST_PIXELS, fmin(CELLS, ALL_RAYS / (small->samples * small->rays_each)));
}

static bool make_pictures(struct small *small) {
    small->exact = heap_array(values_of(small), sizeof *small->exact);
    small->rounded = heap_array(values_of(small), sizeof *small->rounded);
    for (int i = 0; i < 3; i++)
        small->shown[i] = heap_array(values_of(small), sizeof *small->shown[i]);
    return small->exact && small->rounded && small->shown[0] && small->shown[1] && small->shown[2];
}

static void drop_pictures(struct small *small) {
    free(small->exact);
    free(small->rounded);
    for (int i = 0; i < 3; i++)
        free(small->shown[i]);
    small->exact = small->rounded = NULL;
    small->shown[0] = small->shown[1] = small->shown[2] = NULL;
}

// ---- looks

// How many pixels are off, or would be if samples that were not traced were like those that were.
static uint32_t count_off(const struct small *small, const struct precision_choice *out) {
    const double rare = ceil((double)small->rare * small->all_samples / small->samples);
    return (uint32_t)fmin(out->pixels, fmax(out->off, rare));
}

// Whether the pixels seen so far decide. If not, the share seen must be enough, with a stricter limit.
static bool decides(const struct small *small, struct precision_choice *out) {
    const uint32_t off = count_off(small, out);
    out->share = (double)off / out->pixels;
    if (small->whole && small->samples == small->all_samples) {
        out->needs_double = out->share > PRECISION_SHARE;
        return true;
    }
    out->needs_double = out->share > PRECISION_SHARE * PRECISION_PART;
    return small->whole || (out->needs_double ? share_floor(off, out->pixels, RISK) > PRECISION_SHARE
                                              : share_bound(off, out->pixels, RISK) <= PRECISION_SHARE);
}

// Whether as many pixels again, or all pixels, may be looked at.
static bool may_go_on(const struct small *small, double seen) {
    const double all = (double)small->trial->width * small->trial->height;
    const double samples = small->samples * (all <= 4 * seen ? seen + all : 2 * seen);
    const double most = fmax(LOOKED_SAMPLES, all * small->all_samples / LOOKED_PART);
    return samples <= most && samples * small->rays_each <= ALL_RAYS;
}

static enum precision_status take_looks(struct small *small, struct precision_choice *out) {
    enum precision_status status = measure_rays(small) ? PRECISION_DONE : PRECISION_MEMORY;
    double cells = status == PRECISION_DONE ? first_cells(small) : 0;
    while (status == PRECISION_DONE) {
        choose_size(small, cells, out->pixels);
        status = make_pictures(small) ? look(small, out) : PRECISION_MEMORY;
        drop_pictures(small);
        if (status != PRECISION_DONE || decides(small, out) || !may_go_on(small, out->pixels))
            break;
        cells = out->pixels;
        small->look++;
    }
    return status;
}

// Prepares up to where pixels of the background are needed, and waits for them.
static enum precision_status prepare(struct small *small, struct precision_report *report) {
    const struct precision_trial *trial = small->trial;
    small->view = *trial->input->view;
    // First starts what runs in the driver's threads.
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
    drop_pictures(small);
}

static uint64_t size_of(const struct scene *scene) {
    uint64_t sum = 0;
    for (uint32_t i = 0; i < scene->body_count; i++)
        sum += shape_item_count(&scene->bodies[i]);
    return sum;
}

static enum precision_status try_traced(struct small *small, struct precision_choice *out) {
    enum precision_status status = prepare(small, &out->report);
    if (status != PRECISION_DONE)
        return status;
    const double start = clock_seconds();
    status = take_looks(small, out);
    timeline_add(small->trial->input->timeline, "trial", STR(""), start);
    return status;
}

enum precision_status precision_try(const struct precision_trial *trial, struct precision_choice *out,
                                    struct precision_gains *gains) {
    const uint32_t samples = trial->samples ? trial->samples : 1;
    struct small small = {
        .trial = trial, .samples = samples < SAMPLES_MOST ? samples : SAMPLES_MOST, .all_samples = samples};
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
