#include "picture/read/picture_read.h"

#include "core/heap.h"

#include "picture/read/read_exr.h"
#include "picture/read/read_hdr.h"
#include "picture/read/read_jpeg.h"
#include "picture/read/read_png.h"

#include <stdlib.h>

const char *picture_read_header(str bytes, struct picture_header *out) {
    *out = (struct picture_header){0};
    if (str_starts_with(bytes, STR("\x89PNG\r\n\x1A\n"))) {
        out->kind = IMAGE_PNG;
        return picture_png_header(bytes, out);
    }
    if (str_starts_with(bytes, STR("\xFF\xD8\xFF"))) {
        out->kind = IMAGE_JPEG;
        return picture_jpeg_header(bytes, out);
    }
    if (str_starts_with(bytes, STR("#?"))) {
        out->kind = IMAGE_HDR;
        return hdr_read_header(bytes, out);
    }
    if (str_starts_with(bytes, STR("v/1\x01"))) {
        out->kind = IMAGE_EXR;
        return picture_exr_header(bytes, out);
    }
    return NULL;
}

static const char *read_rows(str bytes, struct picture_header *header, struct picture_rows rows) {
    if (header->kind == IMAGE_PNG)
        return picture_png_rows(bytes, header, rows);
    if (header->kind == IMAGE_JPEG)
        return picture_jpeg_rows(bytes, header, rows);
    if (header->kind == IMAGE_EXR)
        return picture_exr_rows(bytes, header, rows);
    return hdr_read_rows(bytes, header, rows);
}

// Memory for the rows, each `stride` bytes after the one before; NULL with *fault set if that fails. It is
// zeroed, so that no file can show old contents of memory.
static void *make_rows(str bytes, struct picture_header *header, uint64_t size, size_t stride,
                       const char **fault) {
    void *memory = heap_zeroed(size, 1);
    *fault = memory ? read_rows(bytes, header, (struct picture_rows){memory, stride}) : picture_no_memory;
    if (!*fault)
        return memory;
    free(memory);
    return NULL;
}

const char *picture_check(str bytes, struct picture_header *header) {
    const char *fault;
    const size_t row_bytes = header->width * picture_pixel_bytes(picture_depth_of(header));
    free(make_rows(bytes, header, row_bytes, 0, &fault));
    return fault;
}

const char *picture_decode(str bytes, struct picture_header *header, struct picture *out) {
    const char *fault;
    *out = picture_of_header(header);
    out->pixels =
        make_rows(bytes, header, out->size_bytes, header->width * picture_pixel_bytes(out->depth), &fault);
    out->ignored = header->ignored;
    out->clear_pixels = header->clear_pixels;
    return fault;
}
