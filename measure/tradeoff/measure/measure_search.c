// The rows of a search, and the ground truth that grows with them.
//
// The ground truth is the device's own samples of the file's settings, several for one of a row and none of
// the row's, plus what the reference finds at a few of them beyond the device: rays that max_depth and
// min_weight cut, and rounding. Between two tracers of the same rays there is no noise of sampling, so that a
// few do.
#include "core/heap.h"
#include "measure/tradeoff/measure/measure.h"
#include "measure/tradeoff/plan/plan_search.h"
#include "picture/write/scale.h"

#include <math.h>
#include <stdlib.h>

enum {
    PILOT_PIXELS = 2048,
    PILOT_VALUES = 3 * PILOT_PIXELS,
    ADDED_MOST = 4, // samples of the reference, where they cost no more than what one may
};
// Change that does not matter where no bound says how little does; else this share of the bound.
static const double BEARABLE = 0.001, BEARABLE_SHARE = 0.05;
// An estimate from few samples may be too low by this share.
static const double MARGIN = 0.1;
// One over the picture's width: how far what the reference adds is spread.
static const double SMOOTH_WIDTH = 64;

static size_t values_of(const struct measuring *s) {
    return heap_times(heap_times(3, s->base.width), s->base.height);
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
    const double rays = plan_search_rays(&s->base, own.rays);
    while (status == TRADEOFF_DONE &&
           (s->full.segments = plan_search_pilot(pilots->all, pilots->count, rays, most, bearable)) > 0) {
        struct plan_search_pilot *pilot = &pilots->all[pilots->count];
        status = run_pilot(s, s->full, pilots, pilot, &deepest);
        // The first differs from the file's settings, not from one of fewer rays.
        p->is_cut |= deepest > p->deepest || pilot->rays > own.rays;
        pilot->change = pilots->count++ ? pilot->change : (double)INFINITY;
    }
    if (status != TRADEOFF_DONE)
        return status;
    const struct plan_search_pilot *last = &pilots->all[pilots->count - 1];
    // Where no sample of a pilot needed more, those of the picture that do are few.
    s->full.segments = last->cut ? last->segments : most;
    p->change = last->cut && last->segments < most ? fmin(last->change, 1) : 0;
    p->added_most = (uint32_t)fmin(fmax(rays / fmax(last->rays, 1), 1), ADDED_MOST);
    s->out->ground_truth_segments = s->full.segments;
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

enum tradeoff_status search_begin(struct measuring *s) {
    struct search_pictures *p = &s->search;
    const size_t values = values_of(s);
    s->full = reference_settings_of(s->input->scene->ir, s->input->image, s->input->limits, false);
    s->full.points_of = s->full.footprint_of = 0;
    s->ground_truth = heap_array(values, sizeof *s->ground_truth);
    s->shown = heap_array(values, sizeof *s->shown);
    s->picture = heap_array(values, sizeof *s->picture);
    p->smooth = heap_array(values, sizeof *p->smooth);
    p->truth = heap_zeroed(values, sizeof *p->truth);
    p->added = heap_zeroed(values, sizeof *p->added);
    p->column = heap_array(s->base.height, sizeof *p->column);
    p->row = heap_zeroed(values, sizeof *p->row);
    p->rgb = heap_array(values > PILOT_VALUES ? values : PILOT_VALUES, sizeof *p->rgb);
    if (!s->ground_truth || !s->shown || !s->picture || !p->truth || !p->added || !p->row || !p->rgb ||
        !p->smooth || !p->column)
        return TRADEOFF_MEMORY;
    return plan_truth(s);
}

void search_close(struct measuring *s) {
    struct search_pictures *p = &s->search;
    free(p->smooth);
    free(p->truth);
    free(p->added);
    free(p->row);
    free(p->rgb);
    free(p->column);
    *p = (struct search_pictures){0};
}

// ---- the ground truth

// Adds `count` times the mean in s->picture.
static void add_picture(const struct measuring *s, size_t values, double count, double *sum) {
    for (size_t i = 0; i < values; i++)
        sum[i] += count * (double)s->picture[i];
}

// What the reference finds at samples beyond what the device does.
static enum tradeoff_status add_reference(struct measuring *s, uint32_t samples) {
    struct search_pictures *p = &s->search;
    struct reference_settings settings = s->full;
    struct reference_statistics taken;
    double seconds;
    settings.first_sample = VIEW_OTHER_SAMPLES + p->added_samples;
    settings.samples = samples - p->added_samples;
    const struct reference_progress progress = measuring_reference_progress(s);
    enum tradeoff_status status = measuring_reference_status(
        reference_source_render(&s->source[0], &settings, p->rgb, &progress, &taken));
    if (status == TRADEOFF_DONE)
        status = device_samples(s, &s->base, settings.first_sample, settings.samples, &seconds, NULL);
    if (status != TRADEOFF_DONE)
        return status;
    for (size_t i = 0; i < values_of(s); i++)
        p->added[i] += settings.samples * (p->rgb[i] - (double)s->picture[i]);
    p->added_samples = samples;
    s->out->ground_truth_left_weight = fmax(s->out->ground_truth_left_weight, taken.left_weight_mean);
    return status;
}

static double finite_or_0(double value) {
    return isfinite(value) ? value : 0;
}

// Sums along lines become means over squares.
static void spread_columns(const struct measuring *s, double *sums, int64_t reach) {
    const int64_t width = s->base.width, height = s->base.height, side = 2 * reach + 1;
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

// What the reference adds to a pixel, spread over a square of its neighbours: rare and bright paths, of which
// few samples see one here and there, add a little everywhere. p->rgb gets the means.
static void spread_added(struct measuring *s) {
    const struct search_pictures *p = &s->search;
    const int64_t width = s->base.width, height = s->base.height;
    const int64_t reach = 1 + (int64_t)((double)width / SMOOTH_WIDTH);
    double *sums = p->rgb;
    for (int64_t y = 0; y < height; y++)
        for (int64_t k = 0; k < 3; k++) {
            double sum = 0;
            const double *line = p->added + 3 * y * width + k;
            for (int64_t x = -reach; x < width; x++) {
                sum += x + reach < width ? finite_or_0(line[3 * (x + reach)]) : 0;
                sum -= x - reach - 1 >= 0 ? finite_or_0(line[3 * (x - reach - 1)]) : 0;
                if (x >= 0)
                    sums[3 * (y * width + x) + k] = sum;
            }
        }
    spread_columns(s, sums, reach);
}

// Both ground truths, displayed.
static void show_truth(struct measuring *s) {
    struct search_pictures *p = &s->search;
    const size_t values = values_of(s);
    for (size_t i = 0; i < values; i++)
        s->ground_truth[i] = (float)(p->truth[i] / p->truth_samples + p->added[i] / p->added_samples);
    image_to_displayed(s->ground_truth, values / 3, s->display, s->ground_truth);
    spread_added(s);
    for (size_t i = 0; i < values; i++)
        p->smooth[i] = (float)(p->truth[i] / p->truth_samples + p->rgb[i] / p->added_samples);
    image_to_displayed(p->smooth, values / 3, s->display, p->smooth);
}

// The larger of the errors against the two ground truths, and what an estimate may be too low by.
static bool estimate(struct measuring *s, struct row *row) {
    const enum metric metric = s->out->options.metric;
    float *sharp = s->ground_truth;
    if (!errors_of_shown(s, row))
        return false;
    double value = row->value[metric];
    if (s->search.is_cut) {
        s->ground_truth = s->search.smooth;
        const bool good = errors_of_shown(s, row);
        s->ground_truth = sharp;
        if (!good)
            return false;
        if (metric_error(metric, row->value[metric]) > metric_error(metric, value))
            value = row->value[metric];
    }
    if (is_mean_error(metric))
        value += s->search.change;
    row->value[metric] = plan_search_safe(metric, value, MARGIN);
    return true;
}

// The error that remains of the file's settings, however many samples they have.
static enum tradeoff_status measure_floor(struct measuring *s) {
    struct search_pictures *p = &s->search;
    const enum metric metric = s->out->options.metric;
    struct row all = {.setting = s->base};
    for (size_t i = 0; i < values_of(s); i++)
        s->shown[i] = (float)(p->truth[i] / p->truth_samples);
    image_to_displayed(s->shown, values_of(s) / 3, s->display, s->shown);
    if (!estimate(s, &all))
        return TRADEOFF_MEMORY;
    p->floor = metric_error(metric, all.value[metric]);
    return TRADEOFF_DONE;
}

// At least as many samples as a row of `samples` is compared with.
static enum tradeoff_status grow_truth(struct measuring *s, uint32_t samples) {
    struct search_pictures *p = &s->search;
    const uint32_t wanted = plan_search_truth(samples);
    const uint32_t added = samples < p->added_most ? samples : p->added_most;
    enum tradeoff_status status = TRADEOFF_DONE;
    double seconds;
    if (p->truth_samples >= wanted)
        return status;
    if (!measuring_step(s, "the samples to compare with"))
        return TRADEOFF_CANCELLED;
    status = device_samples(s, &s->base, VIEW_OTHER_SAMPLES + p->truth_samples, wanted - p->truth_samples,
                            &seconds, NULL);
    if (status != TRADEOFF_DONE)
        return status;
    add_picture(s, values_of(s), wanted - p->truth_samples, p->truth);
    s->out->ground_truth_samples = p->truth_samples = wanted;
    if (p->added_samples < added)
        status = measuring_step(s, "the reference") ? add_reference(s, added) : TRADEOFF_CANCELLED;
    if (status != TRADEOFF_DONE)
        return status;
    show_truth(s);
    return measure_floor(s);
}

// ---- rows

static bool goes_on_from(const struct search_pictures *p, const struct setting *setting) {
    for (int knob = 0; knob < KNOB_COUNT; knob++)
        if (knob != KNOB_SAMPLES && plan_differs(&p->row_setting, setting, (enum knob)knob))
            return false;
    return p->row_samples > 0 && p->row_samples <= setting->samples;
}

static enum tradeoff_status begin_row(struct measuring *s, const struct setting *setting) {
    struct search_pictures *p = &s->search;
    double seconds;
    p->row_setting = *setting;
    p->row_samples = 0;
    p->row_seconds = 0;
    p->row_not_finite = 0;
    for (size_t i = 0; i < values_of(s); i++)
        p->row[i] = 0;
    // Another kernel is compiled with its first frame.
    const bool is_new = setting->is_double != s->base.is_double || setting->shadows != s->base.shadows;
    return is_new ? device_samples(s, setting, 0, 1, &seconds, NULL) : TRADEOFF_DONE;
}

static enum tradeoff_status row_picture(struct measuring *s, struct row *row) {
    struct search_pictures *p = &s->search;
    const struct setting *setting = &row->setting;
    const size_t values = (size_t)3 * setting->width * setting->height;
    enum tradeoff_status status = TRADEOFF_DONE;
    double seconds = 0;
    if (!goes_on_from(p, setting))
        status = begin_row(s, setting);
    const uint32_t more = setting->samples - p->row_samples;
    if (status == TRADEOFF_DONE && more)
        status = device_samples(s, setting, p->row_samples, more, &seconds, &p->row_not_finite);
    if (status != TRADEOFF_DONE) {
        p->row_samples = 0;
        return status;
    }
    if (more)
        add_picture(s, values, more, p->row);
    p->row_samples = setting->samples;
    p->row_seconds += seconds;
    row->time_ms = row->time_low_ms = row->time_high_ms = 1e3 * p->row_seconds;
    row->not_finite = p->row_not_finite;
    for (size_t i = 0; i < values; i++)
        s->picture[i] = (float)(p->row[i] / p->row_samples);
    return status;
}

enum tradeoff_status search_row(struct measuring *s, struct row *row) {
    const struct setting *setting = &row->setting;
    enum tradeoff_status status = grow_truth(s, setting->samples);
    if (status == TRADEOFF_DONE && !measuring_step(s, row->name))
        status = TRADEOFF_CANCELLED;
    if (status == TRADEOFF_DONE)
        status = row_picture(s, row);
    if (status != TRADEOFF_DONE)
        return status;
    // Scaled up as render does it: before it is displayed.
    scale_picture(s->picture, setting->width, setting->height, s->shown, s->base.width, s->base.height);
    image_to_displayed(s->shown, values_of(s) / 3, s->display, s->shown);
    if (!estimate(s, row))
        return TRADEOFF_MEMORY;
    // Of rows that take as long, the one of fewer samples.
    row->work.cost =
        (double)setting->width * setting->height * setting->samples * (setting->is_double ? 2 : 1);
    return status;
}
