// Structural similarity: Wang, Bovik, Sheikh, Simoncelli 2004, "Image Quality Assessment: From Error
// Visibility to Structural Similarity", equations 12 and 13 with the window and constants of section III-C.
#include "core/heap.h"
#include "picture/metrics/metrics_internal.h"

#include <math.h>
#include <stdlib.h>

enum {
    RADIUS = 5, // 11 x 11
    PLANES = 6, // five means and scratch
};

static const double SIGMA = 1.5, C1 = 0.01 * 0.01, C2 = 0.03 * 0.03;

static void window(struct filter *filter) {
    double sum = 0;
    filter->radius = RADIUS;
    for (int k = -RADIUS; k <= RADIUS; k++)
        sum += filter->weight[k + RADIUS] = exp(-k * k / (2 * SIGMA * SIGMA));
    for (int k = 0; k <= 2 * RADIUS; k++)
        filter->weight[k] /= sum;
}

static double luma(const float *c) {
    return 0.299 * (double)c[0] + 0.587 * (double)c[1] + 0.114 * (double)c[2];
}

static void smooth(struct plane_size size, const struct filter *filter, float *planes) {
    const size_t count = (size_t)size.width * size.height;
    for (size_t k = 0; k + 1 < PLANES; k++)
        filter_plane(size, planes + k * count, filter, filter, planes + (PLANES - 1) * count,
                     planes + k * count);
}

// Over the windows inside the picture, as the authors define it; for a picture smaller than a window, over
// all pixels with repeated edges.
static double mean_over_windows(struct plane_size size, const float *planes) {
    const size_t count = (size_t)size.width * size.height;
    const bool inside = size.width > 2 * RADIUS && size.height > 2 * RADIUS;
    const size_t margin = inside ? RADIUS : 0;
    double sum = 0;
    for (size_t y = margin; y < size.height - margin; y++)
        for (size_t x = margin; x < size.width - margin; x++) {
            const float *p = planes + y * size.width + x;
            const double a = (double)p[0], b = (double)p[count];
            const double aa = (double)p[2 * count] - a * a, bb = (double)p[3 * count] - b * b;
            const double ab = (double)p[4 * count] - a * b;
            sum += (2 * a * b + C1) * (2 * ab + C2) / ((a * a + b * b + C1) * (aa + bb + C2));
        }
    return sum / ((double)(size.width - 2 * margin) * (double)(size.height - 2 * margin));
}

bool ssim_measure(struct plane_size size, const float *picture, const float *reference, double *mean) {
    const size_t count = heap_times(size.width, size.height);
    float *planes = heap_array(heap_times(count, PLANES), sizeof *planes);
    struct filter *filter = heap_alloc(sizeof *filter);
    if (planes && filter) {
        for (size_t i = 0; i < count; i++) {
            const double a = luma(picture + 3 * i), b = luma(reference + 3 * i);
            planes[i] = (float)a;
            planes[count + i] = (float)b;
            planes[2 * count + i] = (float)(a * a);
            planes[3 * count + i] = (float)(b * b);
            planes[4 * count + i] = (float)(a * b);
        }
        window(filter);
        smooth(size, filter, planes);
        *mean = mean_over_windows(size, planes);
    }
    const bool good = planes && filter;
    free(planes);
    free(filter);
    return good;
}
