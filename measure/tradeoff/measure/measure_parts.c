// The error of a picture, split: numeric, truncation, sampling, resolution.
//
// Whitted pictures are deterministic: between the device's picture and the ground truth lie pictures that the
// reference can make, each different from the one before by one cause. They are made only at some pixels,
// spread evenly.
#include "core/heap.h"
#include "measure/tradeoff/measure/measure.h"

#include "core/parallel.h"
#include "picture/write/scale.h"

#include <math.h>
#include <stdlib.h>

enum {
    PROBES_A_PIECE = 64,
    CORNERS = 4,
};

static uint32_t probe_count(const struct measuring *s) {
    const uint64_t pixels = (uint64_t)s->base.width * s->base.height;
    return pixels < PROBE_PIXELS ? (uint32_t)pixels : PROBE_PIXELS;
}

// Pixel of a probe: all of a small picture, else Roberts' R2 sequence.
static void probe_place(const struct measuring *s, uint32_t probe, uint32_t *x, uint32_t *y) {
    if ((uint64_t)s->base.width * s->base.height <= PROBE_PIXELS) {
        *x = probe % s->base.width;
        *y = probe / s->base.width;
        return;
    }
    double a, b;
    view_sample_offset(probe + 1, &a, &b);
    *x = (uint32_t)(a * s->base.width);
    *y = (uint32_t)(b * s->base.height);
}

struct probing {
    struct measuring *s;
    const struct reference *reference;
    struct reference_settings settings;
    const uint32_t *taken; // by pixel, if pixels end by their error; NULL: all samples
    float *values;
};

// The mean of a pixel's samples, displayed.
static void pixel_value(const struct probing *p, uint32_t x, uint32_t y, float out[3]) {
    const uint32_t samples = p->taken ? p->taken[(size_t)y * p->settings.width + x] : p->settings.samples;
    double sum[3] = {0};
    for (uint32_t n = 0; n < samples; n++) {
        vec3 radiance = {0};
        reference_log(p->reference, &p->settings, x, y, p->settings.first_sample + n, NULL, 0, &radiance);
        sum[0] += radiance.x;
        sum[1] += radiance.y;
        sum[2] += radiance.z;
    }
    for (int k = 0; k < 3; k++)
        out[k] = (float)(sum[k] / samples);
    image_to_displayed(out, 1, p->s->display, out);
}

// As scale_picture does it for whole pictures.
static void probe_value(const struct probing *p, uint32_t x, uint32_t y, float out[3]) {
    const struct setting *base = &p->s->base;
    const uint32_t width = p->settings.width, height = p->settings.height;
    uint32_t xs[2], ys[2];
    if (width == base->width && height == base->height) {
        pixel_value(p, x, y, out);
        return;
    }
    const double u = scale_around(x, width, base->width, xs), v = scale_around(y, height, base->height, ys);
    double sum[3] = {0};
    for (int i = 0; i < CORNERS; i++) {
        const double weight = (i & 1 ? u : 1 - u) * (i & 2 ? v : 1 - v);
        float value[3];
        if (weight <= 0)
            continue;
        pixel_value(p, xs[i & 1], ys[i >> 1], value);
        for (int k = 0; k < 3; k++)
            sum[k] += weight * (double)value[k];
    }
    for (int k = 0; k < 3; k++)
        out[k] = (float)sum[k];
}

static void probe_piece(void *context, size_t begin, size_t end) {
    const struct probing *p = context;
    for (size_t i = begin; i < end; i++) {
        uint32_t x, y;
        probe_place(p->s, (uint32_t)i, &x, &y);
        probe_value(p, x, y, p->values + 3 * i);
    }
}

static bool is_set(const struct probe_set *a, const struct probe_set *b) {
    const bool paths = a->full || (a->max_depth == b->max_depth &&
                                   !(a->min_weight < b->min_weight || a->min_weight > b->min_weight));
    return a->width == b->width && a->height == b->height && a->samples == b->samples &&
           a->first_sample == b->first_sample && a->without == b->without && a->shadows == b->shadows &&
           a->full == b->full && paths;
}

// NULL: no memory.
static const float *probe(struct measuring *s, struct probe_set wanted) {
    // Each row takes samples of its own.
    for (uint32_t i = 0; i < s->set_count && !wanted.taken; i++)
        if (!s->sets[i].taken && is_set(&s->sets[i], &wanted))
            return s->sets[i].values;
    const uint32_t count = probe_count(s);
    struct reference_source *source = without_source(s, wanted.shadows, wanted.without);
    const struct reference *reference = source ? reference_source_get(source) : NULL;
    float *values = heap_array(heap_times(3, count), sizeof *values);
    if (!values || !reference || s->set_count == PROBE_SETS_MAX) {
        free(values);
        return NULL;
    }
    struct ir_image image = *s->input->image;
    image.width = (int32_t)wanted.width;
    image.height = (int32_t)wanted.height;
    image.samples = (int32_t)wanted.samples;
    struct probing context = {
        s, reference,
        wanted.full ? measuring_all_paths(s, &image)
                    : reference_settings_of(s->input->scene->ir, &image, s->input->limits, true),
        wanted.taken, values};
    context.settings.points_of = wanted.taken ? wanted.samples : 0;
    context.settings.footprint_of = wanted.taken ? wanted.min_samples : 0;
    if (!wanted.full) {
        context.settings.max_depth = wanted.max_depth;
        context.settings.min_weight = wanted.min_weight;
    } else {
        context.settings.segments = s->full.segments;
    }
    context.settings.first_sample = wanted.first_sample;
    parallel_for(count, PROBES_A_PIECE, probe_piece, &context);
    wanted.values = values;
    s->sets[s->set_count++] = wanted;
    return values;
}

static double mean_difference(const float *a, const float *b, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < 3 * count; i++)
        sum += fabs((double)a[i] - (double)b[i]);
    return sum / (3 * (double)count);
}

// Differences only in how pixels are computed are rare and far apart: they are measured over the whole
// picture.
static enum tradeoff_status whole_numeric(struct measuring *s, double *numeric) {
    const size_t pixels = heap_times(s->base.width, s->base.height);
    if (!s->as_file && !s->only_probes)
        s->only_probes = s->out->numeric_probed = !ground_truth_affords(s, (double)s->out->rows[0].work.rays);
    // The reference's picture has all samples of all pixels.
    if (s->only_probes || setting_ends_pixels(&s->base))
        return TRADEOFF_DONE;
    if (!s->as_file) {
        const struct reference_settings settings =
            reference_settings_of(s->input->scene->ir, s->input->image, s->input->limits, true);
        float *shown = heap_array(heap_times(3, pixels), sizeof *shown);
        const enum tradeoff_status status =
            shown ? ground_truth_picture(s, &settings, shown, NULL) : TRADEOFF_MEMORY;
        if (status != TRADEOFF_DONE) {
            free(shown);
            return status;
        }
        s->as_file = shown;
    }
    *numeric = mean_difference(s->shown, s->as_file, pixels);
    return TRADEOFF_DONE;
}

enum tradeoff_status parts_measure(struct measuring *s, struct row *row) {
    const struct setting *t = &row->setting;
    const uint32_t count = probe_count(s);
    if (!ground_truth_affords(s,
                              count * s->ground_truth_rays * (s->out->ground_truth_samples + t->samples))) {
        s->out->parts_out++;
        return TRADEOFF_DONE;
    }
    const struct probe_set as_file = {.width = t->width,
                                      .height = t->height,
                                      .samples = t->samples,
                                      .max_depth = t->max_depth,
                                      .min_weight = t->min_weight,
                                      .without = t->without,
                                      .taken = setting_ends_pixels(t) ? s->taken : NULL,
                                      .min_samples = t->min_samples,
                                      .shadows = t->shadows};
    struct probe_set full = {.width = t->width,
                             .height = t->height,
                             .samples = t->samples,
                             .taken = as_file.taken,
                             .min_samples = t->min_samples,
                             .shadows = s->base.shadows,
                             .full = true};
    const float *settings = probe(s, as_file), *paths = settings ? probe(s, full) : NULL;
    full.samples = s->out->ground_truth_samples;
    full.first_sample = s->full.first_sample;
    full.taken = NULL;
    const float *samples = paths ? probe(s, full) : NULL;
    float *own = heap_array(heap_times(6, count), sizeof *own);
    if (!samples || !own) {
        free(own);
        return TRADEOFF_MEMORY;
    }
    float *ground_truth = own + (size_t)3 * count;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t x, y;
        probe_place(s, i, &x, &y);
        const size_t at = 3 * ((size_t)y * s->base.width + x);
        for (size_t k = 0; k < 3; k++) {
            own[3 * (size_t)i + k] = s->shown[at + k];
            ground_truth[3 * (size_t)i + k] = s->ground_truth[at + k];
        }
    }
    row->parts = (struct error_parts){.known = true,
                                      .numeric = mean_difference(own, settings, count),
                                      .truncation = mean_difference(settings, paths, count),
                                      .sampling = mean_difference(paths, samples, count),
                                      .resolution = mean_difference(samples, ground_truth, count)};
    s->out->part_pixels = count;
    free(own);
    return measuring_traces_as_file(row) ? whole_numeric(s, &row->parts.numeric) : TRADEOFF_DONE;
}

void parts_close(struct measuring *s) {
    for (uint32_t i = 0; i < s->set_count; i++)
        free(s->sets[i].values);
    free(s->as_file);
    s->set_count = 0;
}
