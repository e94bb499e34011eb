// The rows of a search, and what they are compared with.
//
// A picture's error by chance is estimated from its own samples: the mean of all of them and the mean of
// those added last differ by about as much as the first does from the truth. A small picture shows what no
// number of samples does: what the reference finds beyond the device at a few samples, rays that max_depth
// and min_weight cut, and rounding. Between two tracers of the same rays there is no sampling noise, so a few
// samples are enough.
#include "core/heap.h"
#include "measure/tradeoff/measure/measure.h"
#include "measure/tradeoff/plan/plan_search.h"
#include "picture/write/scale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PILOT_PIXELS = 1024,
    PILOT_VALUES = 3 * PILOT_PIXELS,
};
// The change that does not matter if there is no bound; else this share of the bound.
static const double BEARABLE = 0.001, BEARABLE_SHARE = 0.05;
// An estimate may be too low by this share: more so with few samples than with many.
static const double MARGIN = 0.1, MARGIN_OF_ONE = 0.6;
// One over the picture's width: how far the reference's additions are spread.
static const double SMOOTH_WIDTH = 64;

static size_t values_of(const struct measuring *s) {
    return heap_times(heap_times(3, s->base.width), s->base.height);
}

static size_t probe_values(const struct search_pictures *p) {
    return (size_t)3 * p->probe_width * p->probe_height;
}

// ---- what the reference may take

struct pilots {
    struct plan_search_pilot all[PLAN_PILOTS_MAX];
    uint32_t count;
    double *rgb;
    float *shown, *before; // displayed: the last one, and the one before it
};

static double mean_change(const float *a, const float *b, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += fabs((double)a[i] - (double)b[i]);
    return sum / (double)count;
}

static enum tradeoff_status run_pilot(struct measuring *s, struct reference_settings settings,
                                      struct pilots *pilots, struct plan_search_pilot *out,
                                      uint32_t *deepest) {
    struct reference_statistics taken;
    const struct reference_progress progress = measuring_reference_progress(s);
    const double scale = fmin(sqrt(PILOT_PIXELS / ((double)settings.width * settings.height)), 1);
    settings.width = (uint32_t)fmax(scale * settings.width, 1);
    settings.height = (uint32_t)fmax(scale * settings.height, 1);
    settings.samples = 1;
    const enum reference_result result =
        reference_source_render(&s->source[0], &settings, pilots->rgb, &progress, &taken);
    if (result != REFERENCE_DONE)
        return measuring_reference_status(result);
    const size_t pixels = (size_t)settings.width * settings.height;
    const uint64_t rays = taken.primary + taken.reflected + taken.refracted + taken.shadow;
    float *shown = pilots->before;
    pilots->before = pilots->shown;
    pilots->shown = shown;
    for (size_t i = 0; i < 3 * pixels; i++)
        shown[i] = (float)pilots->rgb[i];
    image_to_displayed(shown, pixels, s->display, shown);
    *out =
        (struct plan_search_pilot){settings.segments, (double)rays / (double)pixels,
                                   mean_change(shown, pilots->before, 3 * pixels), taken.cut_by_segments > 0};
    *deepest = taken.deepest;
    return TRADEOFF_DONE;
}

static bool is_mean_error(enum metric metric) {
    return metric == METRIC_MAE || metric == METRIC_RMSE || metric == METRIC_FLIP;
}

static enum tradeoff_status run_pilots(struct measuring *s, struct pilots *pilots) {
    const struct tradeoff_input *in = s->input;
    struct search_pictures *p = &s->search;
    struct plan_search_pilot own;
    uint32_t deepest;
    const struct tradeoff_options *options = &s->out->options;
    const bool has_bound = is_mean_error(options->metric) && !isnan(options->max_error);
    const double bearable = has_bound ? BEARABLE_SHARE * options->max_error : BEARABLE;
    const uint64_t most = s->full.segments;
    enum tradeoff_status status = run_pilot(
        s, reference_settings_of(in->scene->ir, in->image, in->limits, true), pilots, &own, &p->deepest);
    const double rays = plan_search_rays();
    while (status == TRADEOFF_DONE &&
           (s->full.segments = plan_search_pilot(pilots->all, pilots->count, rays, most, bearable)) > 0) {
        struct plan_search_pilot *pilot = &pilots->all[pilots->count];
        status = run_pilot(s, s->full, pilots, pilot, &deepest);
        // The first differs from the file's settings, not from a pilot with fewer rays.
        p->is_cut |= deepest > p->deepest || pilot->rays > own.rays;
        pilot->change = pilots->count++ ? pilot->change : (double)INFINITY;
    }
    if (status != TRADEOFF_DONE)
        return status;
    const struct plan_search_pilot *last = &pilots->all[pilots->count - 1];
    // If no sample of a pilot needed more, only few samples of the picture do.
    s->full.segments = last->cut ? last->segments : most;
    p->change = last->cut && last->segments < most ? fmin(last->change, 1) : 0;
    s->out->ground_truth_segments = s->full.segments;
    const struct plan_search_probe probe = plan_search_probe(&s->base, last->rays);
    p->probe_width = probe.width;
    p->probe_height = probe.height;
    p->probe_samples = s->out->ground_truth_samples = probe.samples;
    return status;
}

static enum tradeoff_status plan_truth(struct measuring *s) {
    float *shown = heap_zeroed(heap_times(6, PILOT_PIXELS), sizeof *shown);
    struct pilots pilots = {.rgb = s->search.rgb, .shown = shown};
    if (!shown)
        return TRADEOFF_MEMORY;
    pilots.before = shown + (size_t)3 * PILOT_PIXELS;
    const enum tradeoff_status status = run_pilots(s, &pilots);
    free(shown);
    return status;
}

// ---- the small picture

static enum tradeoff_status begin_probes(struct measuring *s) {
    struct search_pictures *p = &s->search;
    struct reference_settings settings = s->full;
    struct reference_statistics taken;
    if (!measuring_step(s, "the reference"))
        return TRADEOFF_CANCELLED;
    settings.width = p->probe_width;
    settings.height = p->probe_height;
    settings.first_sample = VIEW_OTHER_SAMPLES;
    settings.samples = p->probe_samples;
    const struct reference_progress progress = measuring_reference_progress(s);
    const enum tradeoff_status status = measuring_reference_status(
        reference_source_render(&s->source[0], &settings, p->rgb, &progress, &taken));
    if (status != TRADEOFF_DONE)
        return status;
    for (size_t i = 0; i < probe_values(p); i++)
        p->full[i] = (float)p->rgb[i];
    s->out->ground_truth_left_weight = taken.left_weight_mean;
    return TRADEOFF_DONE;
}

enum tradeoff_status search_begin(struct measuring *s) {
    struct search_pictures *p = &s->search;
    const size_t values = values_of(s), some = values > PILOT_VALUES ? values : PILOT_VALUES;
    s->full = measuring_all_paths(s, s->input->image);
    s->full.points_of = s->full.footprint_of = 0;
    float **const floats[] = {&s->ground_truth, &s->shown, &s->picture, &p->full,
                              &p->tried,        &p->bias,  &p->smooth,  &p->best};
    double **const doubles[] = {&p->older, &p->newer, &p->rgb};
    bool good = true;
    for (size_t i = 0; i < sizeof floats / sizeof *floats; i++)
        good = (*floats[i] = heap_array(values, sizeof(float))) != NULL && good;
    for (size_t i = 0; i < sizeof doubles / sizeof *doubles; i++)
        good = (*doubles[i] = heap_array(some, sizeof(double))) != NULL && good;
    p->column = heap_array(s->base.height, sizeof *p->column);
    enum tradeoff_status status = good && p->column ? plan_truth(s) : TRADEOFF_MEMORY;
    return status == TRADEOFF_DONE ? begin_probes(s) : status;
}

void search_close(struct measuring *s) {
    struct search_pictures *p = &s->search;
    free(p->full);
    free(p->tried);
    free(p->bias);
    free(p->smooth);
    free(p->best);
    free(p->older);
    free(p->newer);
    free(p->rgb);
    free(p->column);
    *p = (struct search_pictures){0};
}

static double finite_or_0(double value) {
    return isfinite(value) ? value : 0;
}

// Turns sums along lines into means over squares.
static void spread_columns(struct measuring *s, double *sums, int64_t reach) {
    const int64_t width = s->search.probe_width, height = s->search.probe_height, side = 2 * reach + 1;
    double *column = s->search.column;
    for (int64_t i = 0; i < 3 * width; i++) {
        double sum = 0;
        for (int64_t y = 0; y < height; y++)
            column[y] = sums[y * 3 * width + i];
        for (int64_t y = -reach; y < height; y++) {
            sum += y + reach < height ? column[y + reach] : 0;
            sum -= y - reach - 1 >= 0 ? column[y - reach - 1] : 0;
            if (y >= 0)
                sums[y * 3 * width + i] = sum / (double)(side * side);
        }
    }
}

// A small picture, each value spread over a square of its neighbours: rare and bright paths, of which few
// samples see one here and there, add a little everywhere.
static void spread(struct measuring *s, float *values) {
    const struct search_pictures *p = &s->search;
    const int64_t width = p->probe_width, height = p->probe_height;
    const int64_t reach = 1 + (int64_t)((double)width / SMOOTH_WIDTH);
    double *sums = p->rgb;
    for (int64_t y = 0; y < height; y++)
        for (int64_t k = 0; k < 3; k++) {
            double sum = 0;
            const float *line = values + 3 * y * width + k;
            for (int64_t x = -reach; x < width; x++) {
                sum += x + reach < width ? finite_or_0((double)line[3 * (x + reach)]) : 0;
                sum -= x - reach - 1 >= 0 ? finite_or_0((double)line[3 * (x - reach - 1)]) : 0;
                if (x >= 0)
                    sums[3 * (y * width + x) + k] = sum;
            }
        }
    spread_columns(s, sums, reach);
    for (size_t i = 0; i < probe_values(p); i++)
        values[i] = (float)sums[i];
}

// The metric of two displayed pictures; NaN: no memory.
static double distance(const struct measuring *s, uint32_t width, uint32_t height, const float *a,
                       const float *b) {
    struct measure_options options = measure_options_default();
    struct measure_result result;
    options.threshold = s->out->options.threshold;
    options.pixels_per_degree = s->out->options.ppd;
    options.metrics = 1u << s->out->options.metric;
    return measure_pictures(width, height, a, b, &options, &result, NULL, NULL)
               ? result.value[s->out->options.metric]
               : (double)NAN;
}

static double worse(enum metric metric, double a, double b) {
    return metric_error(metric, a) >= metric_error(metric, b) ? a : b;
}

// The distance of s->shown from `linear` + `bias` and from `linear` + `smooth`, the larger one; the first in
// s->ground_truth, displayed.
static double distance_from(struct measuring *s, uint32_t width, uint32_t height, const float *linear) {
    const struct search_pictures *p = &s->search;
    const enum metric metric = s->out->options.metric;
    const size_t values = (size_t)3 * width * height;
    double value = 0;
    for (int i = p->is_cut ? 0 : 1; i < 2; i++) {
        const float *bias = i ? p->bias : p->smooth;
        for (size_t k = 0; k < values; k++)
            s->ground_truth[k] = linear[k] + bias[k];
        image_to_displayed(s->ground_truth, values / 3, s->display, s->ground_truth);
        const double one = distance(s, width, height, s->shown, s->ground_truth);
        value = i && p->is_cut ? worse(metric, value, one) : one;
    }
    return is_mean_error(metric) ? value + p->change : value;
}

static void find_bias(struct measuring *s) {
    struct search_pictures *p = &s->search;
    for (size_t i = 0; i < probe_values(p); i++)
        p->smooth[i] = p->bias[i] = (float)finite_or_0((double)p->full[i] - (double)p->tried[i]);
    if (p->is_cut)
        spread(s, p->smooth);
}

static bool is_same_but_samples(const struct setting *a, const struct setting *b) {
    for (int knob = 0; knob < KNOB_COUNT; knob++)
        if (knob != KNOB_SAMPLES && plan_differs(a, b, (enum knob)knob))
            return false;
    return true;
}

// p->tried, and the bias at its size.
static enum tradeoff_status try_probe(struct measuring *s, const struct setting *setting) {
    struct search_pictures *p = &s->search;
    struct setting small = *setting;
    double seconds;
    small.width = p->probe_width;
    small.height = p->probe_height;
    const enum tradeoff_status status =
        device_samples(s, &small, VIEW_OTHER_SAMPLES, p->probe_samples, &seconds, NULL);
    if (status != TRADEOFF_DONE)
        return status;
    memcpy(p->tried, s->picture, probe_values(p) * sizeof *p->tried);
    p->tried_setting = *setting;
    find_bias(s);
    return status;
}

// Rounds to the file's format.
static void round_shown(const struct measuring *s, size_t values) {
    const double levels = s->out->options.levels;
    for (size_t i = 0; levels > 0 && i < values; i++)
        s->shown[i] = (float)(floor(levels * (double)s->shown[i] + 0.5) / levels);
}

static enum tradeoff_status probe_row(struct measuring *s, struct row *row) {
    struct search_pictures *p = &s->search;
    const enum metric metric = s->out->options.metric;
    const enum tradeoff_status status = try_probe(s, &row->setting);
    if (status != TRADEOFF_DONE)
        return status;
    image_to_displayed(p->tried, probe_values(p) / 3, s->display, s->shown);
    round_shown(s, probe_values(p));
    const double remains = distance_from(s, p->probe_width, p->probe_height, p->tried);
    row->floor = metric_error(metric, plan_search_safe(metric, remains, MARGIN));
    for (int i = 0; i < METRIC_COUNT; i++)
        row->value[i] = (double)NAN;
    return isnan(row->floor) ? TRADEOFF_MEMORY : TRADEOFF_DONE;
}

// ---- rows

// The bias of the row's setting, at the file's size.
static enum tradeoff_status take_bias(struct measuring *s, const struct setting *setting) {
    struct search_pictures *p = &s->search;
    if (p->tried_setting.samples != SEARCH_PROBE && p->tried_setting.width &&
        is_same_but_samples(setting, &p->tried_setting))
        return TRADEOFF_DONE;
    const enum tradeoff_status status = try_probe(s, setting);
    if (status != TRADEOFF_DONE)
        return status;
    p->tried_setting.samples = setting->samples; // no probe's, which is of the small size
    float *const pictures[] = {p->bias, p->smooth};
    for (size_t i = 0; i < 2; i++) {
        scale_picture(pictures[i], p->probe_width, p->probe_height, s->shown, s->base.width, s->base.height);
        memcpy(pictures[i], s->shown, values_of(s) * sizeof(float));
    }
    return TRADEOFF_DONE;
}

static void begin_row(struct search_pictures *p, const struct setting *setting, size_t values) {
    p->row_setting = *setting;
    p->older_samples = p->newer_samples = 0;
    p->row_seconds = 0;
    p->row_not_finite = 0;
    memset(p->older, 0, values * sizeof *p->older);
    memset(p->newer, 0, values * sizeof *p->newer);
}

static enum tradeoff_status add_samples(struct measuring *s, const struct setting *setting, size_t values,
                                        uint32_t more) {
    struct search_pictures *p = &s->search;
    const uint32_t before = p->older_samples + p->newer_samples;
    double seconds;
    const enum tradeoff_status status =
        device_samples(s, setting, before, more, &seconds, &p->row_not_finite);
    if (status != TRADEOFF_DONE)
        return status;
    for (size_t i = 0; i < values; i++) {
        p->older[i] += p->newer[i];
        p->newer[i] = more * (double)s->picture[i];
    }
    p->older_samples = before;
    p->newer_samples = more;
    p->row_seconds += seconds;
    return status;
}

// Draws the samples of a row, and one more if it has only one, in two parts.
static enum tradeoff_status draw_row(struct measuring *s, const struct setting *setting) {
    struct search_pictures *p = &s->search;
    const size_t values = (size_t)3 * setting->width * setting->height;
    const uint32_t wanted = setting->samples > 1 ? setting->samples : 2;
    enum tradeoff_status status = TRADEOFF_DONE;
    if (!is_same_but_samples(&p->row_setting, setting) || p->older_samples + p->newer_samples > wanted)
        begin_row(p, setting, values);
    while (status == TRADEOFF_DONE && p->older_samples + p->newer_samples < wanted) {
        const uint32_t has = p->older_samples + p->newer_samples;
        status = add_samples(s, setting, values, has ? wanted - has : (wanted + 1) / 2);
    }
    if (status != TRADEOFF_DONE)
        p->row_setting = (struct setting){0};
    return status;
}

// Fills s->picture with the row's picture, linear, and p->best with one that is as far from it as it is from
// the truth, judging by its own samples.
static void row_pictures(struct measuring *s, const struct setting *setting) {
    struct search_pictures *p = &s->search;
    const size_t values = (size_t)3 * setting->width * setting->height;
    const double o = p->older_samples, n = p->newer_samples;
    const bool is_one = setting->samples < o + n;
    const double reach = plan_search_reach(setting->samples, p->older_samples, p->newer_samples);
    for (size_t i = 0; i < values; i++) {
        const double mean = is_one ? p->older[i] / o : (p->older[i] + p->newer[i]) / (o + n);
        s->picture[i] = (float)mean;
        p->best[i] = (float)(mean + reach * (p->newer[i] / n - mean));
    }
}

// For the file's size: s->picture and p->best are as row_pictures leaves them.
static void measure_whole(struct measuring *s, struct row *row) {
    struct search_pictures *p = &s->search;
    const enum metric metric = s->out->options.metric;
    const uint32_t width = s->base.width, height = s->base.height;
    image_to_displayed(s->picture, values_of(s) / 3, s->display, s->shown);
    memcpy(s->ground_truth, s->shown, values_of(s) * sizeof(float));
    round_shown(s, values_of(s));
    row->rounding = metric_error(metric, distance(s, width, height, s->shown, s->ground_truth));
    row->value[metric] = distance_from(s, width, height, p->best);
    for (size_t i = 0; i < values_of(s); i++)
        p->best[i] = s->picture[i] + p->bias[i];
    image_to_displayed(p->best, values_of(s) / 3, s->display, p->best);
}

// Smaller pictures are compared with the last one of the file's size. They are scaled up as render does:
// before they are displayed.
static void measure_small(struct measuring *s, struct row *row) {
    const uint32_t width = s->base.width, height = s->base.height;
    scale_picture(s->picture, row->setting.width, row->setting.height, s->shown, width, height);
    image_to_displayed(s->shown, values_of(s) / 3, s->display, s->shown);
    round_shown(s, values_of(s));
    row->value[s->out->options.metric] = distance(s, width, height, s->shown, s->search.best);
}

// The row's value, which may be too good by some share.
static double safe_value(const struct measuring *s, const struct row *row) {
    const enum metric metric = s->out->options.metric;
    return plan_search_safe(metric, row->value[metric], MARGIN + MARGIN_OF_ONE / row->setting.samples);
}

// What is small and bright, a few samples may all have missed: if they seem to keep the bound, more of them
// are drawn, with which they are compared.
static enum tradeoff_status look_again(struct measuring *s, struct row *row) {
    struct search_pictures *p = &s->search;
    const enum metric metric = s->out->options.metric;
    const uint32_t samples = row->setting.samples;
    const uint32_t more = plan_search_more(&row->setting);
    const double value = row->value[metric];
    enum tradeoff_status status = TRADEOFF_DONE;
    if (more == 0 ||
        !(metric_error(metric, safe_value(s, row)) <= metric_error(metric, s->out->options.max_error)))
        return status;
    if (p->older_samples + p->newer_samples != samples) {
        begin_row(p, &row->setting, values_of(s));
        status = add_samples(s, &row->setting, values_of(s), samples);
    }
    if (status == TRADEOFF_DONE)
        status = add_samples(s, &row->setting, values_of(s), more);
    if (status != TRADEOFF_DONE)
        return status;
    row_pictures(s, &row->setting);
    measure_whole(s, row);
    row->value[metric] = worse(metric, value, row->value[metric]);
    return status;
}

static void fill_row(struct measuring *s, struct row *row) {
    const struct search_pictures *p = &s->search;
    const struct setting *setting = &row->setting;
    const enum metric metric = s->out->options.metric;
    const double drawn = p->older_samples + p->newer_samples;
    row->value[metric] = safe_value(s, row);
    row->time_ms = row->time_low_ms = row->time_high_ms = 1e3 * p->row_seconds * setting->samples / drawn;
    row->not_finite = p->row_not_finite;
    // Among rows that take equally long, the one with fewer samples.
    row->work.cost =
        (double)setting->width * setting->height * setting->samples * (setting->is_double ? 2 : 1);
}

enum tradeoff_status search_row(struct measuring *s, struct row *row) {
    const struct setting *setting = &row->setting;
    const bool is_whole = setting->width == s->base.width && setting->height == s->base.height;
    if (!measuring_step(s, row->name))
        return TRADEOFF_CANCELLED;
    if (setting->samples == SEARCH_PROBE)
        return probe_row(s, row);
    enum tradeoff_status status = is_whole ? take_bias(s, setting) : TRADEOFF_DONE;
    if (status == TRADEOFF_DONE)
        status = draw_row(s, setting);
    if (status != TRADEOFF_DONE)
        return status;
    for (int i = 0; i < METRIC_COUNT; i++)
        row->value[i] = (double)NAN;
    if (is_whole) {
        row_pictures(s, setting);
        measure_whole(s, row);
        status = look_again(s, row);
    } else {
        float *best = s->search.best;
        s->search.best = s->search.tried; // of no use for this row
        row_pictures(s, setting);
        s->search.best = best;
        measure_small(s, row);
    }
    if (status != TRADEOFF_DONE) {
        s->search.row_setting = (struct setting){0};
        return status;
    }
    if (isnan(row->value[s->out->options.metric]) && !s->search.row_not_finite)
        return TRADEOFF_MEMORY;
    fill_row(s, row);
    return status;
}
