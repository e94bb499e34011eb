// What the metrics share: separable filters over planes, and the two metrics that need them. Private to
// picture/metrics.
//
// Thread safety: pure; planes are the caller's. Errors: false when memory runs out.
#ifndef GLINT_PICTURE_METRICS_METRICS_INTERNAL_H
#define GLINT_PICTURE_METRICS_METRICS_INTERNAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    FILTER_RADIUS_MAX = 512,
    ROWS_A_PIECE = 8,
};

// Weights at -radius..radius.
struct filter {
    int radius;
    double weight[2 * FILTER_RADIUS_MAX + 1];
};

struct plane_size {
    uint32_t width, height;
};

// out = in filtered with `across` along rows and `down` along columns; beyond the edge its values repeat.
// `scratch` holds a plane; `out` may be `in`.
void filter_plane(struct plane_size size, const float *in, const struct filter *across,
                  const struct filter *down, float *scratch, float *out);

// Both take displayed values, three per pixel, finite and in 0..1.
bool ssim_measure(struct plane_size size, const float *picture, const float *reference, double *mean);
// `map` gets one value per pixel.
bool flip_measure(struct plane_size size, const float *picture, const float *reference,
                  double pixels_per_degree, double *mean, float *map);

#endif
