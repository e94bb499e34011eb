#include "picture/metrics/heatmap.h"

#include "core/angle.h"
#include "core/heap.h"
#include "core/srgb.h"
#include "picture/write/encode_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint8_t srgb_byte(double linear) {
    const double c = linear > 0 ? (linear < 1 ? linear : 1) : 0;
    return (uint8_t)floor(255 * srgb_encode(c) + 0.5);
}

// OKLab to linear sRGB, the matrices of its definition.
static void from_oklab(double lightness, double a, double b, uint8_t rgb[3]) {
    const double l = pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    rgb[0] = srgb_byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s);
    rgb[1] = srgb_byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s);
    rgb[2] = srgb_byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s);
}

void heatmap_color(double value, uint8_t rgb[3]) {
    if (isnan(value)) {
        static const uint8_t cyan[3] = {0, 255, 255};
        memcpy(rgb, cyan, sizeof cyan);
        return;
    }
    const double t = value > 0 ? (value < 1 ? value : 1) : 0;
    // From violet (290 degrees) through red (30) to yellow (100), inside what sRGB can show.
    const double hue = (290 + 170 * t) * PI / 180, chroma = 0.37 * t * (1 - t * t * t);
    from_oklab(0.97 * t, chroma * cos(hue), chroma * sin(hue), rgb);
}

void heatmap_png(uint32_t width, uint32_t height, const float *values, enum heatmap_scale scale,
                 struct strbuf *out) {
    const size_t pixels = heap_times(width, height);
    uint8_t *bytes = heap_array(pixels, 3);
    if (!bytes) {
        out->failed = true;
        return;
    }
    for (size_t i = 0; i < pixels; i++) {
        const double v = (double)values[i];
        heatmap_color(scale == HEATMAP_LINEAR ? v
                      : v > 0                 ? 1 + log10(v) / 3
                      : isnan(v)              ? v
                                              : 0,
                      bytes + 3 * i);
    }
    encode_png(width, height, bytes, NULL, out);
    free(bytes);
}
