// PNG (ISO/IEC 15948) through libpng.
#include "picture/write/encode_parts.h"
#include "picture/write/image.h"

#include "core/heap.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>

static void on_write(png_structp png, png_bytep bytes, size_t count) {
    struct strbuf *out = png_get_io_ptr(png);
    strbuf_add(out, bytes, count);
    if (out->failed)
        png_error(png, "not enough memory");
}

static void on_flush(png_structp png) {
    (void)png;
}

static void on_error(png_structp png, png_const_charp message) {
    (void)message;
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

static png_voidp on_malloc(png_structp png, png_alloc_size_t count) {
    (void)png;
    return heap_alloc(count);
}

static void on_free(png_structp png, png_voidp memory) {
    (void)png;
    free(memory);
}

// Returns normally, or through libpng's jump to the caller's setjmp.
static void write_all(png_structp png, png_infop info, uint32_t width, uint32_t height, const uint8_t *rgb,
                      const char *note) {
    png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (note) {
        char keyword[] = IMAGE_NOTE_KEYWORD;
        png_text text = {.compression = PNG_TEXT_COMPRESSION_NONE, .key = keyword, .text = (char *)note};
        png_set_text(png, info, &text, 1);
    }
    png_write_info(png, info);
    for (uint32_t y = 0; y < height; y++)
        png_write_row(png, rgb + (size_t)3 * width * y);
    png_write_end(png, NULL);
}

void encode_png(uint32_t width, uint32_t height, const uint8_t *rgb, const char *note, struct strbuf *out) {
    png_structp png = png_create_write_struct_2(PNG_LIBPNG_VER_STRING, NULL, on_error, on_warning, NULL,
                                                on_malloc, on_free);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (info) {
        png_set_write_fn(png, out, on_write, on_flush);
        if (setjmp(png_jmpbuf(png)) == 0)
            write_all(png, info, width, height, rgb, note);
        else
            out->failed = true;
    } else {
        out->failed = true;
    }
    png_destroy_write_struct(&png, &info);
}
