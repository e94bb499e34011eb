// The ground truth of a study, and how much of the reference the budget allows.
#include "core/heap.h"
#include "measure/tradeoff/measure/measure.h"

#include "core/clock.h"
#include "core/parallel.h"
#include "measure/tradeoff/plan/plan.h"

#include <math.h>
#include <stdlib.h>

enum {
    PILOT_PIXELS = 2048, // approximate; for a small picture a sixteenth
    PILOT_PIXELS_LEAST = 64,
    PILOT_PART = 16,
};
// Rays per second and processor that the reference is assumed to trace when the ground truth is planned;
// fixed, so that the plan does not depend on the load of the machine.
static const double REFERENCE_RAYS = 1e6;
// Share of the budget for the ground truth.
static const double GROUND_TRUTH_SHARE = 0.3;

static uint64_t rays_of(const struct reference_statistics *r) {
    return r->primary + r->reflected + r->refracted + r->shadow;
}

enum tradeoff_status ground_truth_picture(struct measuring *s, const struct reference_settings *settings,
                                          float *shown, struct reference_statistics *statistics) {
    const size_t pixels = heap_times(s->base.width, s->base.height);
    double *rgb = heap_array(heap_times(3, pixels), sizeof *rgb);
    if (!rgb)
        return TRADEOFF_MEMORY;
    const struct reference_progress progress = measuring_reference_progress(s);
    const enum reference_result result =
        reference_source_render(&s->source[0], settings, rgb, &progress, statistics);
    if (result == REFERENCE_DONE) {
        for (size_t i = 0; i < 3 * pixels; i++)
            shown[i] = (float)rgb[i];
        image_to_displayed(shown, pixels, s->display, shown);
    }
    free(rgb);
    return measuring_reference_status(result);
}

// ---- what it would take

// The whole picture, smaller, one sample per pixel.
static struct reference_settings pilot_settings(const struct measuring *s) {
    const double pixels = (double)s->base.width * s->base.height;
    const double wanted = fmin(fmax(pixels / PILOT_PART, PILOT_PIXELS_LEAST), PILOT_PIXELS);
    const double scale = fmin(sqrt(wanted / pixels), 1);
    struct reference_settings settings = s->full;
    settings.width = (uint32_t)fmax(scale * s->base.width, 1);
    settings.height = (uint32_t)fmax(scale * s->base.height, 1);
    settings.samples = 1;
    return settings;
}

static enum tradeoff_status run_pilots(struct measuring *s, struct plan_ground_truth_input *in,
                                       struct plan_pilot pilots[PLAN_PILOTS_MAX]) {
    struct reference_settings settings = pilot_settings(s);
    struct reference_statistics taken;
    enum reference_result result = REFERENCE_DONE;
    in->pilot_pixels = (uint64_t)settings.width * settings.height;
    double *rgb = heap_array(heap_times(3, in->pilot_pixels), sizeof *rgb);
    if (!rgb)
        return TRADEOFF_MEMORY;
    const struct reference_progress progress = measuring_reference_progress(s);
    while (result == REFERENCE_DONE && (settings.segments = plan_next_pilot(in)) > 0) {
        result = reference_source_render(&s->source[0], &settings, rgb, &progress, &taken);
        if (result == REFERENCE_DONE)
            pilots[in->pilot_count++] =
                (struct plan_pilot){settings.segments, (double)rays_of(&taken) / (double)in->pilot_pixels,
                                    taken.cut_by_segments > 0};
    }
    free(rgb);
    return measuring_reference_status(result);
}

// If nothing is reflected or refracted, the file's own rays tell those of the ground truth.
static enum tradeoff_status plan(struct measuring *s, const struct work *own, bool bounces,
                                 struct plan_ground_truth *out) {
    const uint64_t pixels = (uint64_t)s->base.width * s->base.height;
    const double budget = s->out->options.budget_s;
    struct plan_pilot pilots[PLAN_PILOTS_MAX];
    // The parts are measured by up to two more sets of probes before any other row.
    const uint64_t probes = pixels < PROBE_PIXELS ? pixels : PROBE_PIXELS;
    struct plan_ground_truth_input in = {.file_samples = (uint32_t)ceil(own->samples),
                                         .pixels = pixels + 2 * probes,
                                         .rays_most = budget > 0 ? GROUND_TRUTH_SHARE * budget *
                                                                       REFERENCE_RAYS * parallel_processors()
                                                                 : (double)INFINITY,
                                         .segments_most = s->full.segments,
                                         .pilots = pilots};
    enum tradeoff_status status = TRADEOFF_DONE;
    if (budget > 0 && !bounces) {
        in.pilot_pixels = pixels;
        pilots[in.pilot_count++] =
            (struct plan_pilot){s->full.segments, (double)own->rays / ((double)pixels * own->samples), false};
    } else {
        status = run_pilots(s, &in, pilots);
    }
    *out = plan_ground_truth(&in);
    return status;
}

// ---- making

enum tradeoff_status ground_truth_make(struct measuring *s, const struct work *own, bool bounces) {
    const size_t values = heap_times(heap_times(3, s->base.width), s->base.height);
    struct tradeoff *t = s->out;
    struct reference_statistics taken;
    struct plan_ground_truth planned;
    const double start = clock_seconds();
    s->full = measuring_all_paths(s, s->input->image);
    // Samples that no row has: errors that two pictures share would not count.
    s->full.first_sample = VIEW_OTHER_SAMPLES;
    s->full.points_of = s->full.footprint_of = 0; // all pixels of a row have all its samples
    enum tradeoff_status status = plan(s, own, bounces, &planned);
    if (status != TRADEOFF_DONE)
        return status;
    const bool lowered = planned.segments < s->full.segments;
    t->ground_truth_samples = s->full.samples = planned.samples;
    t->ground_truth_segments = s->full.segments = planned.segments;
    s->ground_truth = heap_array(values, sizeof *s->ground_truth);
    s->shown = heap_array(values, sizeof *s->shown);
    s->picture = heap_array(values, sizeof *s->picture);
    if (!s->ground_truth || !s->shown || !s->picture)
        return TRADEOFF_MEMORY;
    status = ground_truth_picture(s, &s->full, s->ground_truth, &taken);
    if (status != TRADEOFF_DONE)
        return status;
    t->reference_seconds = clock_seconds() - start;
    t->ground_truth_cut = lowered && taken.cut_by_segments > 0;
    t->ground_truth_left_weight = taken.left_weight_mean;
    s->ground_truth_rays = (double)rays_of(&taken) / ((double)values / 3 * planned.samples);
    s->reference_rate = taken.seconds > 0 ? (double)rays_of(&taken) / taken.seconds : REFERENCE_RAYS;
    return status;
}

bool ground_truth_affords(const struct measuring *s, double rays) {
    const double budget = s->out->options.budget_s;
    return !(budget > 0) ||
           clock_seconds() - s->begun + rays / s->reference_rate <= MEASURE_ROWS_SHARE * budget;
}
