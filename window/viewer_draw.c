// Pictures of the viewer: few pixels at once, then all of them, then more samples.
#include "core/clock.h"
#include "core/heap.h"
#include "grammar/ir.h"
#include "window/viewer_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    SHRINK_MOST = 8,
    SAMPLES_MOST = 256,   // at which the viewer stops by itself
    SAMPLES_FACTOR = 4,   // from one number of samples to the next
    MOST_RAYS_KNOWN = 16, // least samples for which a further picture is worth it
};
#define COARSE_SECONDS 0.035 // that a picture while moving may take
#define SHOW_SECONDS   0.1   // between two updates of a picture that is getting samples

static bool fit(struct viewer_picture *picture, uint32_t width, uint32_t height) {
    picture->samples = 0;
    return image_fit(&picture->image, width, height);
}

void viewer_drop_pictures(struct viewer *v) {
    image_finish(&v->shown.image);
    image_finish(&v->next.image);
    free(v->squares);
    free(v->before);
    free(v->hits);
    v->squares = NULL;
    v->before = NULL;
    v->hits = NULL;
    v->has_hits = false;
    v->shown.samples = v->next.samples = 0;
}

static void swap_pictures(struct viewer *v) {
    const struct viewer_picture picture = v->shown;
    v->shown = v->next;
    v->next = picture;
}

// ---- few pixels

// Shrinks so that the picture is done soon, judged by what pixels took before.
static uint32_t choose_shrink(const struct viewer *v) {
    const double seconds = v->pixel_seconds * v->width * v->height;
    uint32_t shrink = 2;
    while (shrink < SHRINK_MOST && seconds / (shrink * shrink) > COARSE_SECONDS)
        shrink *= 2;
    return seconds < COARSE_SECONDS && v->pixel_seconds > 0 ? 1 : shrink;
}

static uint32_t part_of(uint32_t size, uint32_t shrink) {
    return size < shrink ? 1 : size / shrink;
}

bool viewer_draw_coarse(struct viewer *v) {
    const uint32_t shrink = choose_shrink(v);
    const uint32_t width = part_of(v->width, shrink), height = part_of(v->height, shrink);
    struct shot *shot = &v->live->shot;
    if (!fit(&v->next, width, height) || !viewer_set_up(v, width, height, 1))
        return false;
    const enum render_result result =
        renderer_render(shot->renderer, &v->eye, v->next.image.rgb, NULL, &v->next.statistics);
    if (result != RENDER_DONE)
        return false;
    v->next.samples = 1;
    v->next.seconds = v->next.statistics.wall_seconds;
    v->pixel_seconds = v->next.seconds / ((double)width * height);
    swap_pictures(v);
    v->is_stale = false;
    v->is_coarse = shrink > 1;
    v->has_hits = false;
    return true;
}

// ---- all pixels

static uint32_t scene_samples(const struct viewer *v) {
    return (uint32_t)v->live->session->image->samples;
}

// The number of samples of the next picture; 0: there is none to be made.
static uint32_t next_samples(const struct viewer *v) {
    const uint32_t made = v->is_coarse ? 0 : v->shown.samples, own = scene_samples(v);
    if (made < own)
        return own;
    const uint32_t more = made * SAMPLES_FACTOR < MOST_RAYS_KNOWN ? MOST_RAYS_KNOWN : made * SAMPLES_FACTOR;
    return made >= SAMPLES_MOST ? 0 : more < SAMPLES_MOST ? more : SAMPLES_MOST;
}

bool viewer_is_finished(const struct viewer *v) {
    return !v->is_stale && next_samples(v) == 0;
}

struct drawing {
    struct viewer *v;
    double begun, shown;
    bool failed;
};

static bool make_room_for_error(struct viewer *v) {
    const size_t pixels = heap_times(v->width, v->height);
    free(v->squares);
    free(v->before);
    v->squares = heap_zeroed(pixels, sizeof *v->squares);
    v->before = heap_zeroed(heap_times(3, pixels), sizeof *v->before);
    return v->squares && v->before;
}

// Adds the squared differences between a sample and the mean (Welford 1962), for the mean of its three
// channels.
static void add_squares(struct viewer *v, uint32_t samples, const float *mean) {
    const size_t pixels = (size_t)v->width * v->height;
    for (size_t i = 0; i < pixels; i++) {
        double now = 0, old = 0;
        for (size_t c = 3 * i; c < 3 * i + 3; c++) {
            now += (double)mean[c] / 3;
            old += (double)v->before[c] / 3;
        }
        const double sample = samples * now - (samples - 1) * old;
        if (samples > 1)
            v->squares[i] += (sample - old) * (sample - now);
    }
    memcpy(v->before, mean, 3 * pixels * sizeof *mean);
}

static void take(struct viewer *v, uint32_t samples, const float *rgb, double seconds) {
    struct viewer_picture *shown = &v->shown;
    if (!fit(shown, v->width, v->height))
        return;
    memcpy(shown->image.rgb, rgb, (size_t)3 * v->width * v->height * sizeof *rgb);
    shown->samples = samples;
    shown->seconds = seconds / samples;
    v->pixel_seconds = shown->seconds / ((double)v->width * v->height);
    v->is_stale = v->is_coarse = false;
}

// All pixels have one more sample. It is shown unless something better is.
static bool goes_on(void *context, uint32_t samples, const float *rgb) {
    struct drawing *d = context;
    struct viewer *v = d->v;
    const double now = clock_seconds();
    const bool is_better = v->is_stale || v->is_coarse || samples > v->shown.samples;
    add_squares(v, samples, rgb);
    if (is_better && (samples == 1 || now - d->shown > SHOW_SECONDS)) {
        take(v, samples, rgb, now - d->begun);
        d->shown = now;
        d->failed = !viewer_show(v);
    }
    return !d->failed && !viewer_is_disturbed(v);
}

static bool is_over(void *context) {
    const struct drawing *d = context;
    return viewer_is_disturbed(d->v);
}

static bool report(void *context, double fraction) {
    (void)fraction;
    const struct drawing *d = context;
    return !viewer_is_disturbed(d->v);
}

bool viewer_draw_more(struct viewer *v) {
    const uint32_t samples = next_samples(v);
    struct shot *shot = &v->live->shot;
    struct drawing d = {.v = v, .begun = clock_seconds()};
    const struct render_limit limit = {
        .goes_on = goes_on, .is_over = is_over, .context = &d, .shows_each = true};
    const struct render_progress progress = {report, &d};
    if (samples == 0)
        return true;
    if (!fit(&v->next, v->width, v->height) || !make_room_for_error(v) ||
        !viewer_set_up(v, v->width, v->height, samples))
        return false;
    struct viewer_picture *next = &v->next;
    const enum render_result result =
        renderer_render_until(shot->renderer, &v->eye, next->image.rgb, &progress, &limit, &next->statistics);
    if (result == RENDER_FAILED || d.failed)
        return false;
    const uint32_t made = next->statistics.samples;
    if (result == RENDER_CANCELLED || made == 0)
        return true;
    if (!v->is_stale && !v->is_coarse && made <= v->shown.samples)
        return true;
    if (made == samples)
        add_squares(v, made, next->image.rgb);
    v->shown.statistics = next->statistics;
    take(v, made, next->image.rgb, clock_seconds() - d.begun);
    v->has_hits = false;
    return viewer_show(v);
}
