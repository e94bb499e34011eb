// Numbers as colours, on a map of evenly increasing lightness: black, violet, red, orange, pale yellow.
//
// The map is a path through OKLab (Ottosson 2020): lightness is the value itself, the hue turns from violet
// to yellow, the chroma stays inside sRGB. Equal steps look equal, and the map is monotone in grey.
// Thread safety: pure.
#ifndef GLINT_PICTURE_METRICS_HEATMAP_H
#define GLINT_PICTURE_METRICS_HEATMAP_H

#include "core/strbuf.h"

#include <stdint.h>

// 0 black, 1 pale yellow; values beyond are clamped; NaN is cyan, which is not on the map.
void heatmap_color(double value, uint8_t rgb[3]);

enum heatmap_scale {
    HEATMAP_LINEAR,      // 0..1
    HEATMAP_LOGARITHMIC, // 0.001 and below are black, then three decades up to 1
};

// Appends a PNG of a map of `width` x `height` values, rows from the top. Sets out->failed when memory runs
// out.
void heatmap_png(uint32_t width, uint32_t height, const float *values, enum heatmap_scale scale,
                 struct strbuf *out);

#endif
