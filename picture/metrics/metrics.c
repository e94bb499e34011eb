#include "picture/metrics/metrics.h"

#include "core/heap.h"
#include "core/parallel.h"
#include "picture/metrics/metrics_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum bound {
    MOST,
    LEAST, // higher is better
};

const struct metric_info metric_infos[METRIC_COUNT] = {
#define X(NAME, name, title, of_displayed, least, most, bound, ...)                                          \
    {name, title, bound == LEAST, of_displayed},
#include "picture/metrics/metrics.def"
#undef X
};

enum metric metric_find(str name) {
    int metric = 0;
    while (metric < METRIC_COUNT && !str_equal_cstr(name, metric_infos[metric].name))
        metric++;
    return (enum metric)metric;
}

double metric_error(enum metric metric, double value) {
    return metric_infos[metric].higher_is_better ? -value : value;
}

struct measure_options measure_options_default(void) {
    return (struct measure_options){.threshold = 1.0 / 255, .pixels_per_degree = 67};
}

// ---- sums over pixels

struct row_sums {
    double absolute, square, relative;
    uint64_t over, not_finite[2], not_finite_together;
    struct measure_place largest;
    double largest_difference; // -1: no finite pixel
};

struct summing {
    uint32_t width;
    const float *picture, *reference;
    double threshold;
    struct row_sums *rows;
    float *difference; // may be NULL
};

static bool finite_pixel(const float *c) {
    return isfinite(c[0]) && isfinite(c[1]) && isfinite(c[2]);
}

// Bytes are floats here, each rounded by half a unit in the last place: the difference of adjacent levels
// must not be above 1/255 for some values and below it for others.
static bool is_over(const struct summing *s, double value, double reference) {
    return fabs(value - reference) > s->threshold + 0x1p-24 * (fabs(value) + fabs(reference));
}

static void sum_pixel(const struct summing *s, struct row_sums *row, uint32_t x, uint32_t y) {
    const size_t at = (size_t)y * s->width + x;
    const float *a = s->picture + 3 * at, *b = s->reference + 3 * at;
    const bool finite_a = finite_pixel(a), finite_b = finite_pixel(b);
    double most = finite_a && finite_b ? 0 : (double)INFINITY;
    bool over = false;
    row->not_finite[0] += !finite_a;
    row->not_finite[1] += !finite_b;
    row->not_finite_together += !(finite_a && finite_b);
    for (uint32_t k = 0; finite_a && finite_b && k < 3; k++) {
        const double value = (double)a[k], reference = (double)b[k], d = fabs(value - reference);
        row->absolute += d;
        row->square += d * d;
        row->relative += d * d / (reference * reference + 0.01);
        if (d > row->largest_difference) {
            row->largest_difference = d;
            row->largest = (struct measure_place){x, y, k, value, reference};
        }
        most = d > most ? d : most;
        over = over || is_over(s, value, reference);
    }
    row->over += over;
    if (s->difference)
        s->difference[at] = (float)most;
}

static void sum_rows(void *context, size_t begin, size_t end) {
    const struct summing *s = context;
    for (size_t y = begin; y < end; y++) {
        s->rows[y] = (struct row_sums){.largest_difference = -1};
        for (uint32_t x = 0; x < s->width; x++)
            sum_pixel(s, &s->rows[y], x, (uint32_t)y);
    }
}

static struct row_sums total_of(const struct row_sums *rows, uint32_t height) {
    struct row_sums total = {.largest_difference = -1};
    for (uint32_t y = 0; y < height; y++) {
        const struct row_sums *row = &rows[y];
        total.absolute += row->absolute;
        total.square += row->square;
        total.relative += row->relative;
        total.over += row->over;
        total.not_finite[0] += row->not_finite[0];
        total.not_finite[1] += row->not_finite[1];
        total.not_finite_together += row->not_finite_together;
        if (row->largest_difference > total.largest_difference) {
            total.largest_difference = row->largest_difference;
            total.largest = row->largest;
        }
    }
    return total;
}

static void fill(struct measure_result *r, const struct row_sums *total, uint64_t pixels) {
    const double finite = (double)(pixels - total->not_finite_together), channels = 3 * finite;
    r->pixels = pixels;
    r->over = total->over;
    memcpy(r->not_finite, total->not_finite, sizeof r->not_finite);
    r->not_finite_together = total->not_finite_together;
    r->largest = total->largest;
    if (finite == 0)
        return;
    const double mse = total->square / channels;
    r->value[METRIC_MAE] = total->absolute / channels;
    r->value[METRIC_RMSE] = sqrt(mse);
    r->value[METRIC_RELMSE] = total->relative / channels;
    r->value[METRIC_LARGEST] = total->largest_difference;
    r->value[METRIC_PSNR] = mse > 0 ? -10 * log10(mse) : (double)INFINITY;
    r->value[METRIC_SHARE] = (double)total->over / finite;
}

static bool sum_pixels(struct plane_size size, const float *picture, const float *reference, double threshold,
                       struct measure_result *result, float *difference) {
    struct row_sums *rows = heap_array(size.height, sizeof *rows);
    if (!rows)
        return false;
    struct summing context = {size.width, picture, reference, threshold, rows, difference};
    parallel_for(size.height, ROWS_A_PIECE, sum_rows, &context);
    struct row_sums total = total_of(rows, size.height);
    free(rows);
    fill(result, &total, (uint64_t)size.width * size.height);
    return true;
}

// ---- the metrics of displayed values

static float *displayed_copy(const float *picture, size_t pixels, const struct measure_options *options) {
    float *copy = heap_array(heap_times(3, pixels), sizeof *copy);
    // In displayed values only NaN changes.
    const struct image_display none = {.tone = IR_TONE_CLIP, .transfer = IR_TRANSFER_NONE};
    if (copy)
        image_to_displayed(picture, pixels, options->space == MEASURE_LINEAR ? options->display : none, copy);
    return copy;
}

bool measure_pictures(uint32_t width, uint32_t height, const float *picture, const float *reference,
                      const struct measure_options *options, struct measure_result *result, float *difference,
                      float *flip) {
    const struct plane_size size = {width, height};
    const size_t pixels = heap_times(width, height);
    const bool ssim = !options->metrics || options->metrics & 1u << METRIC_SSIM;
    const bool wants_flip = flip || !options->metrics || options->metrics & 1u << METRIC_FLIP;
    *result = (struct measure_result){0};
    for (int i = 0; i < METRIC_COUNT; i++)
        result->value[i] = (double)NAN;
    bool good = sum_pixels(size, picture, reference, options->threshold, result, difference);
    if (!good || !(ssim || wants_flip))
        return good;
    float *a = displayed_copy(picture, pixels, options), *b = displayed_copy(reference, pixels, options);
    float *map = flip || !wants_flip ? flip : heap_array(pixels, sizeof *map);
    good = a && b && (map || !wants_flip);
    if (good && ssim)
        good = ssim_measure(size, a, b, &result->value[METRIC_SSIM]);
    if (good && wants_flip)
        good = flip_measure(size, a, b, options->pixels_per_degree, &result->value[METRIC_FLIP], map);
    if (map != flip)
        free(map);
    free(a);
    free(b);
    return good;
}
