// PNG (ISO/IEC 15948) through libpng, with data that is already deflated (png_data.h).
#include "picture/write/encode_internal.h"
#include "picture/write/image.h"
#include "picture/write/png_data.h"
#include "picture/write/rows.h"

#include "core/heap.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum {
    DEEP_BITS = 16,
};

// Deflates rows that come some at a time.
struct flow {
    const struct image_rows *rows;
    struct image_display display;
    float *linear;
    uint8_t *shown;    // the row before the taken rows, and these rows
    uint8_t *filtered; // `before` bytes of the stream already deflated, then `have` new ones
    size_t before, have;
    struct png_data data;
};

struct file {
    uint32_t width, height;
    int bits;
    const struct image_texts *texts; // NULL: none
    struct png_data data;
    struct flow *flow; // NULL: the data is complete
    const struct image_sink *sink;
};

static void on_write(png_structp png, png_bytep bytes, size_t count) {
    const struct image_sink *sink = png_get_io_ptr(png);
    if (!sink->put(sink->context, bytes, count))
        png_error(png, "cannot be written");
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

// The bytes before and after the deflated pieces (RFC 1950): a window of 32 KiB, and the checksum of all
// bytes.
enum {
    STREAM_HEAD = 2,
    STREAM_END = 4
};
static const uint8_t STREAM_HEAD_BYTES[STREAM_HEAD] = {0x78, 0x5e};

static unsigned long sum_of(unsigned long sum, const struct png_data *data) {
    for (size_t i = 0; i < data->count; i++)
        sum =
            adler32_combine(sum, data->pieces[i].sum, (z_off_t)(data->pieces[i].end - data->pieces[i].from));
    return sum;
}

// A chunk for each piece: none is too large for its length field. *all is the checksum of everything written
// before, then including these.
static void write_data(png_structp png, const struct png_data *data, unsigned long *all, bool begins,
                       bool ends) {
    static const png_byte type[] = "IDAT";
    const unsigned long sum = *all = sum_of(*all, data);
    const uint8_t end[STREAM_END] = {(uint8_t)(sum >> 24), (uint8_t)(sum >> 16), (uint8_t)(sum >> 8),
                                     (uint8_t)sum};
    for (size_t i = 0; i < data->count; i++) {
        const struct png_piece *piece = &data->pieces[i];
        const size_t before = begins && i == 0 ? STREAM_HEAD : 0;
        const size_t after = ends && i + 1 == data->count ? STREAM_END : 0;
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

static size_t pixel_bytes(const struct image_rows *rows) {
    return rows->coding.bits == DEEP_BITS ? 6 : 3;
}

// Rows [y, y + count) into the filtered bytes. false: no memory, or no rows.
static bool take_rows(struct flow *flow, uint32_t y, uint32_t count) {
    const struct image_rows *rows = flow->rows;
    const size_t row = pixel_bytes(rows) * rows->width;
    const struct image image = {.width = rows->width, .height = count, .rgb = flow->linear};
    const uint8_t *above = y > 0 ? flow->shown : NULL;
    if (!rows->take(rows->context, y, count, flow->linear))
        return false;
    (rows->coding.bits == DEEP_BITS ? image_to_words : image_to_bytes)(&image, flow->display,
                                                                       flow->shown + row);
    if (!png_filter_rows(rows->width, count, (uint32_t)pixel_bytes(rows), flow->shown + row, above,
                         flow->filtered + flow->before + flow->have))
        return false;
    memcpy(flow->shown, flow->shown + count * row, row);
    flow->have += count * (row + 1);
    return true;
}

// Deflates the bytes that make whole pieces, or all that are left.
static bool deflate_rows(struct flow *flow, bool is_last) {
    const size_t size = is_last ? flow->have : flow->have / PNG_PIECE * PNG_PIECE;
    png_data_finish(&flow->data);
    if (size == 0)
        return true;
    if (!png_data_deflate(flow->filtered, flow->before, size, is_last, &flow->data))
        return false;
    const size_t end = flow->before + size, from = end - PNG_WINDOW;
    if (is_last)
        return true;
    memmove(flow->filtered, flow->filtered + from, PNG_WINDOW + flow->have - size);
    flow->before = PNG_WINDOW;
    flow->have -= size;
    return true;
}

static void write_flow(png_structp png, struct flow *flow) {
    const uint32_t height = flow->rows->height, most = image_rows_at_once(flow->rows);
    unsigned long sum = adler32(0, NULL, 0);
    bool begins = true;
    for (uint32_t y = 0; y < height;) {
        const uint32_t count = height - y < most ? height - y : most;
        const bool is_last = y + count == height;
        if (!take_rows(flow, y, count) || !deflate_rows(flow, is_last))
            png_error(png, "no rows");
        write_data(png, &flow->data, &sum, begins, is_last);
        begins = begins && flow->data.count == 0;
        y += count;
    }
}

// Returns normally, or through libpng's jump to the caller's setjmp.
static void write_all(png_structp png, png_infop info, const struct file *file) {
    unsigned long sum = adler32(0, NULL, 0);
    png_set_IHDR(png, info, file->width, file->height, file->bits, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    for (uint32_t i = 0; file->texts && i < file->texts->count; i++)
        add_text(png, info, &file->texts->items[i]);
    png_write_info(png, info);
    if (file->flow)
        write_flow(png, file->flow);
    else
        write_data(png, &file->data, &sum, true, true);
    // png_write_end would miss the data, which libpng does not know of.
    png_write_chunk(png, (png_const_bytep) "IEND", NULL, 0);
}

// The locals of its caller are not changed between setjmp and a jump.
static bool write_guarded(png_structp png, png_infop info, const struct file *file) {
    png_set_write_fn(png, (png_voidp)file->sink, on_write, on_flush);
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    write_all(png, info, file);
    return true;
}

static bool write_file(const struct file *file) {
    bool written = false;
    png_structp png = png_create_write_struct_2(PNG_LIBPNG_VER_STRING, NULL, on_error, on_warning, NULL,
                                                on_malloc, on_free);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (info)
        written = write_guarded(png, info, file);
    png_destroy_write_struct(&png, &info);
    return written;
}

static bool put_memory(void *context, const void *bytes, size_t count) {
    struct strbuf *out = context;
    strbuf_add(out, bytes, count);
    return !out->failed;
}

static void encode(struct file *file, const uint8_t *rgb, struct strbuf *out) {
    const struct image_sink sink = {.put = put_memory, .context = out};
    file->sink = &sink;
    if (!png_data_make(file->width, file->height, 3 * (uint32_t)file->bits / 8, rgb, &file->data) ||
        !write_file(file))
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

bool encode_png_rows(const struct image_rows *rows, struct image_display display,
                     const struct image_sink *sink) {
    const size_t row = heap_times(pixel_bytes(rows), rows->width), most = image_rows_at_once(rows);
    struct flow flow = {.rows = rows, .display = display};
    struct file file = {.width = rows->width,
                        .height = rows->height,
                        .bits = rows->coding.bits == DEEP_BITS ? DEEP_BITS : 8,
                        .texts = &rows->texts,
                        .flow = &flow,
                        .sink = sink};
    flow.linear = heap_array(heap_times(rows->width, most), 3 * sizeof *flow.linear);
    flow.shown = heap_array(most + 1, row);
    flow.filtered = heap_alloc(PNG_WINDOW + PNG_PIECE + heap_times(most, row + 1));
    const bool written = flow.linear && flow.shown && flow.filtered && write_file(&file);
    png_data_finish(&flow.data);
    free(flow.filtered);
    free(flow.shown);
    free(flow.linear);
    return written;
}
