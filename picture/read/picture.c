#include "core/heap.h"
#include "picture/read/picture_read.h"

#include "picture/read/read_hdr.h"
#include "picture/read/read_jpeg.h"
#include "picture/read/read_png.h"

#include <stdlib.h>

void picture_finish(struct picture *picture) {
    if (!picture)
        return;
    free(picture->pixels);
    *picture = (struct picture){0};
}

const char *picture_read_header(str bytes, struct picture_header *out) {
    *out = (struct picture_header){0};
    if (str_starts_with(bytes, STR("\x89PNG\r\n\x1A\n"))) {
        out->kind = PICTURE_KIND_PNG;
        return picture_png_header(bytes, out);
    }
    if (str_starts_with(bytes, STR("\xFF\xD8\xFF"))) {
        out->kind = PICTURE_KIND_JPEG;
        return picture_jpeg_header(bytes, out);
    }
    if (str_starts_with(bytes, STR("#?"))) {
        out->kind = PICTURE_KIND_HDR;
        return hdr_read_header(bytes, out);
    }
    return NULL;
}

static const char *read_pixels(str bytes, const struct picture_header *header, void *pixels) {
    if (header->kind == PICTURE_KIND_PNG)
        return picture_png_pixels(bytes, header, pixels);
    if (header->kind == PICTURE_KIND_JPEG)
        return picture_jpeg_pixels(bytes, header, pixels);
    return hdr_read_pixels(bytes, header, pixels);
}

const char *picture_decode(str bytes, const struct picture_header *header, struct picture *out) {
    enum picture_depth depth = header->kind == PICTURE_KIND_HDR ? PICTURE_FLOAT
                               : header->is_16_bit              ? PICTURE_16
                                                                : PICTURE_8;
    unsigned channel_bytes = depth == PICTURE_FLOAT ? 4 : depth == PICTURE_16 ? 2 : 1;
    *out = (struct picture){.width = header->width,
                            .height = header->height,
                            .depth = depth,
                            .size_bytes = (uint64_t)header->width * header->height * 4 * channel_bytes,
                            .ignored = header->ignored};
    // Zeroed, so that no file can show old contents of memory.
    void *pixels = heap_zeroed(1, (size_t)out->size_bytes);
    if (!pixels)
        return "there is not enough memory";
    const char *fault = read_pixels(bytes, header, pixels);
    if (fault)
        free(pixels);
    else
        out->pixels = pixels;
    return fault;
}
