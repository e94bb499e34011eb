#include "picture/write/scale.h"

#include "core/parallel.h"

#include <math.h>
#include <stddef.h>

struct scaling {
    const float *in;
    uint32_t width, height;
    float *out;
    uint32_t to_width, to_height;
};

double scale_around(uint32_t at, uint32_t from, uint32_t to, uint32_t places[2]) {
    const double x = fmin(fmax((at + 0.5) * from / to - 0.5, 0), from - 1);
    places[0] = (uint32_t)x;
    places[1] = places[0] + 1 < from ? places[0] + 1 : places[0];
    return x - places[0];
}

static void scale_rows(void *context, size_t begin, size_t end) {
    const struct scaling *j = context;
    for (size_t y = begin; y < end; y++) {
        uint32_t ys[2], xs[2];
        const double v = scale_around((uint32_t)y, j->height, j->to_height, ys);
        for (uint32_t x = 0; x < j->to_width; x++) {
            const double u = scale_around(x, j->width, j->to_width, xs);
            for (size_t k = 0; k < 3; k++) {
                const float *a = j->in + 3 * (size_t)ys[0] * j->width + k;
                const float *b = j->in + 3 * (size_t)ys[1] * j->width + k;
                const double top = (1 - u) * (double)a[3 * xs[0]] + u * (double)a[3 * xs[1]];
                const double bottom = (1 - u) * (double)b[3 * xs[0]] + u * (double)b[3 * xs[1]];
                j->out[3 * (y * j->to_width + x) + k] = (float)((1 - v) * top + v * bottom);
            }
        }
    }
}

void scale_picture(const float *in, uint32_t width, uint32_t height, float *out, uint32_t to_width,
                   uint32_t to_height) {
    enum {
        ROWS = 8
    };
    struct scaling job = {in, width, height, out, to_width, to_height};
    parallel_for(to_height, ROWS, scale_rows, &job);
}
