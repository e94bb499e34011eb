// Radiance pictures: three mantissas and a shared exponent per pixel (Ward 1991, "Real Pixels"), each row
// as four run-length coded planes if its width allows.
#include "core/heap.h"
#include "picture/write/encode_internal.h"
#include "picture/write/image.h"

#include <math.h>
#include <stdlib.h>

enum {
    RLE_WIDTH_MIN = 8,
    RLE_WIDTH_MAX = 32767,
    RUN_MIN = 4,
    RUN_MAX = 127,
    LITERAL_MAX = 128,
};

// Negative values cannot be written; infinity becomes the greatest writable value.
static float storable(float c) {
    return c > 0 ? fminf(c, 0x1.fep126f) : 0;
}

static void put_pixel(const float *rgb, uint8_t rgbe[4]) {
    const bool marked = image_is_marked(rgb);
    float c[3] = {marked ? 1 : storable(rgb[0]), marked ? 0 : storable(rgb[1]),
                  marked ? 1 : storable(rgb[2])};
    float largest = fmaxf(c[0], fmaxf(c[1], c[2]));
    int exponent;
    frexpf(largest, &exponent);
    if (largest == 0 || exponent < -127) {
        rgbe[0] = rgbe[1] = rgbe[2] = rgbe[3] = 0;
        return;
    }
    for (int k = 0; k < 3; k++)
        rgbe[k] = (uint8_t)fmin(floor(ldexp(c[k], 8 - exponent) + 0.5), 255);
    rgbe[3] = (uint8_t)(exponent + 128);
}

static size_t run_at(const uint8_t *plane, size_t at, size_t width) {
    size_t end = at + 1;
    while (end < width && end - at < RUN_MAX && plane[end] == plane[at])
        end++;
    return end - at;
}

static void put_plane(const uint8_t *plane, size_t width, struct strbuf *out) {
    for (size_t at = 0; at < width;) {
        size_t run = run_at(plane, at, width);
        if (run >= RUN_MIN) {
            strbuf_char(out, (char)(128 + run));
            strbuf_char(out, (char)plane[at]);
            at += run;
            continue;
        }
        size_t end = at;
        while (end < width && end - at < LITERAL_MAX && (run = run_at(plane, end, width)) < RUN_MIN)
            end += run;
        if (end - at > LITERAL_MAX)
            end = at + LITERAL_MAX;
        strbuf_char(out, (char)(end - at));
        strbuf_add(out, plane + at, end - at);
        at = end;
    }
}

void encode_hdr_head(uint32_t width, uint32_t height, const struct image_texts *texts, struct strbuf *out) {
    strbuf_cstr(out, "#?RADIANCE\n");
    for (uint32_t i = 0; texts && i < texts->count; i++)
        strbuf_format(out, "# %s: %s\n", texts->items[i].keyword, texts->items[i].text);
    strbuf_format(out, "FORMAT=32-bit_rle_rgbe\n\n-Y %u +X %u\n", height, width);
}

void encode_hdr_rows(uint32_t width, uint32_t rows, const float *rgb, struct strbuf *out) {
    uint8_t *planes = heap_array(4, width);
    if (!planes) {
        out->failed = true;
        return;
    }
    bool is_coded = width >= RLE_WIDTH_MIN && width <= RLE_WIDTH_MAX;
    for (uint32_t y = 0; y < rows; y++) {
        if (is_coded)
            strbuf_add(out, (uint8_t[4]){2, 2, (uint8_t)(width >> 8), (uint8_t)width}, 4);
        for (uint32_t x = 0; x < width; x++) {
            uint8_t rgbe[4];
            put_pixel(rgb + 3 * ((size_t)y * width + x), rgbe);
            for (uint32_t k = 0; k < 4; k++)
                planes[(size_t)k * width + x] = rgbe[k];
            if (!is_coded)
                strbuf_add(out, rgbe, 4);
        }
        for (uint32_t k = 0; is_coded && k < 4; k++)
            put_plane(planes + (size_t)k * width, width, out);
    }
    free(planes);
}

void encode_hdr(uint32_t width, uint32_t height, const float *rgb, const struct image_texts *texts,
                struct strbuf *out) {
    encode_hdr_head(width, height, texts, out);
    encode_hdr_rows(width, height, rgb, out);
}
