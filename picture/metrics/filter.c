#include "picture/metrics/metrics_internal.h"

#include "core/parallel.h"

struct pass {
    struct plane_size size;
    const float *in;
    float *out;
    const struct filter *filter;
};

static void filter_rows(void *context, size_t begin, size_t end) {
    const struct pass *p = context;
    const int width = (int)p->size.width, radius = p->filter->radius;
    for (size_t y = begin; y < end; y++) {
        const float *row = p->in + y * p->size.width;
        for (int x = 0; x < width; x++) {
            double sum = 0;
            for (int k = -radius; k <= radius; k++) {
                const int at = x + k < 0 ? 0 : x + k < width ? x + k : width - 1;
                sum += p->filter->weight[k + radius] * (double)row[at];
            }
            p->out[y * p->size.width + (size_t)x] = (float)sum;
        }
    }
}

static void filter_columns(void *context, size_t begin, size_t end) {
    const struct pass *p = context;
    const int height = (int)p->size.height, radius = p->filter->radius;
    for (size_t y = begin; y < end; y++) {
        for (uint32_t x = 0; x < p->size.width; x++) {
            double sum = 0;
            for (int k = -radius; k <= radius; k++) {
                int at = (int)y + k;
                at = at < 0 ? 0 : at < height ? at : height - 1;
                sum += p->filter->weight[k + radius] * (double)p->in[(size_t)at * p->size.width + x];
            }
            p->out[y * p->size.width + x] = (float)sum;
        }
    }
}

void filter_plane(struct plane_size size, const float *in, const struct filter *across,
                  const struct filter *down, float *scratch, float *out) {
    struct pass rows = {size, in, scratch, across};
    parallel_for(size.height, ROWS_A_PIECE, filter_rows, &rows);
    struct pass columns = {size, scratch, out, down};
    parallel_for(size.height, ROWS_A_PIECE, filter_columns, &columns);
}
