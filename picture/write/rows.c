#include "picture/write/rows.h"

#include "core/heap.h"
#include "picture/write/encode_internal.h"

#include <stdlib.h>

bool image_rows_can(enum image_format format) {
    return format == IMAGE_PNG || format == IMAGE_PFM || format == IMAGE_HDR || format == IMAGE_EXR;
}

// Writes some rows as bytes of the file.
typedef void rows_encoder(uint32_t width, uint32_t rows, const float *rgb, struct strbuf *out);

static bool put(const struct image_sink *sink, struct strbuf *out) {
    const bool good = !out->failed && sink->put(sink->context, out->data, out->len);
    strbuf_clear(out);
    return good;
}

// Rows one after the other, from the top or from the bottom; `out` has the head already.
static bool write_rows(const struct image_rows *rows, bool from_bottom, rows_encoder *encoder,
                       struct strbuf *out, const struct image_sink *sink) {
    const uint32_t most = image_rows_at_once(rows);
    float *rgb = heap_array(heap_times(rows->width, most), 3 * sizeof *rgb);
    bool good = rgb != NULL;
    for (uint32_t done = 0; good && done < rows->height;) {
        const uint32_t left = rows->height - done, count = left < most ? left : most;
        good = rows->take(rows->context, from_bottom ? left - count : done, count, rgb);
        if (good)
            encoder(rows->width, count, rgb, out);
        good = good && put(sink, out);
        done += count;
    }
    free(rgb);
    return good;
}

bool image_rows_write(const struct image_rows *rows, enum image_format format, struct image_display display,
                      const struct image_sink *sink) {
    struct strbuf out;
    bool good = false;
    if (format == IMAGE_PNG)
        return encode_png_rows(rows, display, sink);
    if (format == IMAGE_EXR)
        return encode_exr_rows(rows, sink);
    strbuf_init(&out);
    if (format == IMAGE_PFM) {
        encode_pfm_head(rows->width, rows->height, &out);
        good = write_rows(rows, true, encode_pfm_rows, &out, sink);
    } else if (format == IMAGE_HDR) {
        encode_hdr_head(rows->width, rows->height, &rows->texts, &out);
        good = write_rows(rows, false, encode_hdr_rows, &out, sink);
    }
    strbuf_finish(&out);
    return good;
}
