// How much one picture differs from another: the metrics of `glint compare` and `glint tradeoff`.
//
// Two pictures of the same size, three floats per pixel, rows from the top, in the same space: displayed
// values (0..1, as written to an 8-bit file, before rounding) or linear ones (as in the float formats). The
// second picture is the reference; only relMSE is not symmetric. MAE, RMSE, relMSE, the largest difference,
// PSNR (peak 1) and the share over the threshold are computed in the given space; SSIM and FLIP are defined
// on displayed values: linear ones are clamped and encoded for them. Means are over pixels that are finite in
// both pictures, and the others are counted; for SSIM and FLIP, NaN counts as 0. Ownership: the caller's
// arrays. Errors: false when memory runs out. Thread safety: pure; uses all processors, and the result does
// not depend on how many there are.
#ifndef GLINT_PICTURE_METRICS_METRICS_H
#define GLINT_PICTURE_METRICS_METRICS_H

#include "core/str.h"
#include "picture/write/image.h"

enum metric {
#define X(NAME, ...) METRIC_##NAME,
#include "picture/metrics/metrics.def"
#undef X
    METRIC_COUNT,
};

struct metric_info {
    const char *name; // "mae"
    const char *title;
    bool higher_is_better;
    bool of_displayed; // always of displayed values; the others: of the values compared
};

enum measure_space {
    MEASURE_DISPLAYED,
    MEASURE_LINEAR,
};

struct measure_options {
    enum measure_space space;
    double threshold;             // for METRIC_SHARE, usually 1/255
    double pixels_per_degree;     // for METRIC_FLIP, usually 67
    struct image_display display; // for linear values
    uint32_t metrics;             // bit 1 << METRIC_...: the wanted metrics; 0: all
};

struct measure_place {
    uint32_t x, y, channel;
    double value, reference;
};

struct measure_result {
    double value[METRIC_COUNT]; // NaN if not asked for, or if no pixel is finite
    struct measure_place largest;
    uint64_t pixels;
    uint64_t over;          // pixels over the threshold
    uint64_t not_finite[2]; // pixels with a channel that is infinite or not a number: picture, reference
    uint64_t not_finite_together; // in either
};

extern const struct metric_info metric_infos[METRIC_COUNT];
// METRIC_COUNT if there is none.
enum metric metric_find(str name);
// The metric's value as an error: lower is better.
double metric_error(enum metric metric, double value);

struct measure_options measure_options_default(void);

// `difference` and `flip`, if not NULL, get one value per pixel: the largest |a - b| of its channels
// (infinite if not finite), and FLIP's error.
bool measure_pictures(uint32_t width, uint32_t height, const float *picture, const float *reference,
                      const struct measure_options *options, struct measure_result *result, float *difference,
                      float *flip);

#endif
