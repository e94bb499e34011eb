#include "core/heap.h"
#include "measure/tradeoff/measure/measure.h"

#include "picture/metrics/heatmap.h"
#include "picture/write/encode_internal.h"
#include "picture/write/scale.h"

#include <math.h>
#include <stdlib.h>

// ---- thumbnails

struct box {
    uint32_t x0, x1, y0, y1;
};

static struct box box_of(uint32_t x, uint32_t y, uint32_t width, uint32_t height, uint32_t to_width,
                         uint32_t to_height) {
    return (struct box){x * width / to_width, (x + 1) * width / to_width, y * height / to_height,
                        (y + 1) * height / to_height};
}

static uint32_t thumbnail_height(uint32_t width, uint32_t height, uint32_t to_width) {
    const uint32_t wanted = (uint32_t)((uint64_t)height * to_width / width);
    return wanted ? wanted : 1;
}

static void picture_thumbnail(const float *shown, uint32_t width, uint32_t height, struct strbuf *out) {
    const uint32_t w = width < THUMBNAIL_WIDTH ? width : THUMBNAIL_WIDTH,
                   h = thumbnail_height(width, height, w);
    uint8_t *bytes = heap_array(heap_times(3, w), h);
    for (uint32_t i = 0; bytes && i < w * h; i++) {
        const struct box b = box_of(i % w, i / w, width, height, w, h);
        for (size_t k = 0; k < 3; k++) {
            double sum = 0;
            for (uint32_t y = b.y0; y < b.y1; y++)
                for (uint32_t x = b.x0; x < b.x1; x++)
                    sum += (double)shown[3 * ((size_t)y * width + x) + k];
            const double mean = sum / fmax((double)(b.x1 - b.x0) * (b.y1 - b.y0), 1);
            bytes[3 * (size_t)i + k] = (uint8_t)floor(255 * fmin(fmax(mean, 0), 1) + 0.5);
        }
    }
    if (bytes)
        encode_png(w, h, bytes, NULL, out);
    out->failed |= !bytes;
    free(bytes);
}

// The largest difference in each box, so that single wrong pixels stay visible.
static void difference_thumbnail(const float *difference, uint32_t width, uint32_t height,
                                 struct strbuf *out) {
    const uint32_t w = width < THUMBNAIL_WIDTH ? width : THUMBNAIL_WIDTH,
                   h = thumbnail_height(width, height, w);
    float *values = heap_array(heap_times(w, h), sizeof *values);
    for (uint32_t i = 0; values && i < w * h; i++) {
        const struct box b = box_of(i % w, i / w, width, height, w, h);
        values[i] = 0;
        for (uint32_t y = b.y0; y < b.y1; y++)
            for (uint32_t x = b.x0; x < b.x1; x++)
                values[i] = fmaxf(values[i], difference[(size_t)y * width + x]);
    }
    if (values)
        heatmap_png(w, h, values, HEATMAP_LOGARITHMIC, out);
    out->failed |= !values;
    free(values);
}

// ---- a row

static bool errors_of_shown(struct measuring *s, struct row *row) {
    const uint32_t width = s->base.width, height = s->base.height;
    struct measure_options options = measure_options_default();
    struct measure_result result;
    float *difference =
        s->out->options.thumbnails ? heap_array(heap_times(width, height), sizeof *difference) : NULL;
    options.threshold = s->out->options.threshold;
    options.pixels_per_degree = s->out->options.ppd;
    bool good =
        (difference || !s->out->options.thumbnails) &&
        measure_pictures(width, height, s->shown, s->ground_truth, &options, &result, difference, NULL);
    if (good)
        for (int i = 0; i < METRIC_COUNT; i++)
            row->value[i] = result.value[i];
    if (good && difference) {
        picture_thumbnail(s->shown, width, height, &row->thumbnail);
        difference_thumbnail(difference, width, height, &row->difference);
        good = !row->thumbnail.failed && !row->difference.failed;
    }
    free(difference);
    return good;
}

enum tradeoff_status errors_measure(struct measuring *s, struct row *row) {
    const struct setting *setting = &row->setting;
    enum tradeoff_status status = device_picture(s, row, s->picture);
    if (status != TRADEOFF_DONE)
        return status;
    // NaN is what the device reports; it is shown as black, as the writers do.
    image_to_displayed(s->picture, (size_t)setting->width * setting->height, s->display, s->picture);
    scale_picture(s->picture, setting->width, setting->height, s->shown, s->base.width, s->base.height);
    return errors_of_shown(s, row) ? TRADEOFF_DONE : TRADEOFF_MEMORY;
}
