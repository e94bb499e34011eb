// PNG (ISO/IEC 15948) through libpng, with data that are deflated already (png_data.h).
#include "picture/write/encode_parts.h"
#include "picture/write/image.h"
#include "picture/write/png_data.h"

#include "core/heap.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <zlib.h>

struct file {
    uint32_t width, height;
    int bits;
    const struct image_texts *texts; // NULL: none
    struct png_data data;
};

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

// What stands before and after the deflated pieces (RFC 1950): a window of 32 KiB, and the sum of all bytes.
enum {
    STREAM_HEAD = 2,
    STREAM_END = 4
};
static const uint8_t STREAM_HEAD_BYTES[STREAM_HEAD] = {0x78, 0x5e};

static unsigned long sum_of(const struct png_data *data) {
    unsigned long sum = adler32(0, NULL, 0);
    for (size_t i = 0; i < data->count; i++)
        sum =
            adler32_combine(sum, data->pieces[i].sum, (z_off_t)(data->pieces[i].end - data->pieces[i].from));
    return sum;
}

// A chunk for each piece: none is so large that its length would not fit.
static void write_data(png_structp png, const struct png_data *data) {
    static const png_byte type[] = "IDAT";
    const unsigned long sum = sum_of(data);
    const uint8_t end[STREAM_END] = {(uint8_t)(sum >> 24), (uint8_t)(sum >> 16), (uint8_t)(sum >> 8),
                                     (uint8_t)sum};
    for (size_t i = 0; i < data->count; i++) {
        const struct png_piece *piece = &data->pieces[i];
        const size_t before = i == 0 ? STREAM_HEAD : 0, after = i + 1 == data->count ? STREAM_END : 0;
        png_write_chunk_start(png, type, (png_uint_32)(before + piece->count + after));
        png_write_chunk_data(png, STREAM_HEAD_BYTES, before);
        png_write_chunk_data(png, piece->bytes, piece->count);
        png_write_chunk_data(png, end, after);
        png_write_chunk_end(png);
    }
}

static bool is_ascii(const char *text) {
    while (*text && (unsigned char)*text < 0x80)
        text++;
    return *text == '\0';
}

// tEXt is Latin-1, iTXt is UTF-8.
static void add_text(png_structp png, png_infop info, const struct image_text *text) {
    char no_language[] = "";
    png_text chunk = {.compression =
                          is_ascii(text->text) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE,
                      .key = (char *)text->keyword,
                      .text = (char *)text->text,
                      .lang = no_language,
                      .lang_key = no_language};
    png_set_text(png, info, &chunk, 1);
}

// Returns normally, or through libpng's jump to the caller's setjmp.
static void write_all(png_structp png, png_infop info, const struct file *file) {
    png_set_IHDR(png, info, file->width, file->height, file->bits, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    for (uint32_t i = 0; file->texts && i < file->texts->count; i++)
        add_text(png, info, &file->texts->items[i]);
    png_write_info(png, info);
    write_data(png, &file->data);
    // png_write_end would miss the data, of which libpng knows nothing.
    png_write_chunk(png, (png_const_bytep) "IEND", NULL, 0);
}

static void write_file(const struct file *file, struct strbuf *out) {
    png_structp png = png_create_write_struct_2(PNG_LIBPNG_VER_STRING, NULL, on_error, on_warning, NULL,
                                                on_malloc, on_free);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (info) {
        png_set_write_fn(png, out, on_write, on_flush);
        if (setjmp(png_jmpbuf(png)) == 0)
            write_all(png, info, file);
        else
            out->failed = true;
    } else {
        out->failed = true;
    }
    png_destroy_write_struct(&png, &info);
}

static void encode(struct file *file, const uint8_t *rgb, struct strbuf *out) {
    if (png_data_make(file->width, file->height, 3 * (uint32_t)file->bits / 8, rgb, &file->data))
        write_file(file, out);
    else
        out->failed = true;
    png_data_finish(&file->data);
}

void encode_png(uint32_t width, uint32_t height, const uint8_t *rgb, const struct image_texts *texts,
                struct strbuf *out) {
    struct file file = {.width = width, .height = height, .bits = 8, .texts = texts};
    encode(&file, rgb, out);
}

void encode_png_deep(uint32_t width, uint32_t height, const uint8_t *rgb, const struct image_texts *texts,
                     struct strbuf *out) {
    struct file file = {.width = width, .height = height, .bits = 16, .texts = texts};
    encode(&file, rgb, out);
}
