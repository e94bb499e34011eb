#include "picture/read/read_png.h"

#include "core/heap.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <zlib.h>

enum {
    SIGNATURE = 8,
    FRAME = 12, // length, type and checksum of a chunk
    DATA_SLACK = 64 << 10,
    MEMORY_SLACK = 1 << 20,
    COLORS = 3,
    ROWS = 4, // how many libpng has at a time, each as wide as a row can be
};

static uint32_t big_endian(const unsigned char *p, int bytes) {
    uint32_t value = 0;
    for (int i = 0; i < bytes; i++)
        value = value << 8 | p[i];
    return value;
}

// ---- chunks: all are there, and the first has the size

static const char *name_ignored(bool alpha, bool profile) {
    return alpha && profile ? "alpha and colour profile are"
           : alpha          ? "alpha is"
           : profile        ? "colour profile is"
                            : NULL;
}

// Four channels: alpha is decoded, and then taken off.
static uint64_t widest_row(const struct picture_header *header) {
    return (uint64_t)header->width * 4 * (header->is_16_bit ? 2 : 1);
}

const char *picture_png_header(str bytes, struct picture_header *out) {
    const unsigned char *data = (const unsigned char *)bytes.ptr;
    bool alpha = false;
    bool profile = false;
    for (size_t at = SIGNATURE;;) {
        if (bytes.len - at < FRAME)
            return at == SIGNATURE ? "the file ends before the first chunk"
                                   : "the file ends before its end chunk";
        uint32_t length = big_endian(data + at, 4);
        const char *type = bytes.ptr + at + 4;
        if (length > bytes.len - at - FRAME)
            return "the file ends within a chunk";
        if (at == SIGNATURE) {
            if (length != 13 || memcmp(type, "IHDR", 4) != 0)
                return "the first chunk is not a header";
            out->width = big_endian(data + at + 8, 4);
            out->height = big_endian(data + at + 12, 4);
            out->is_16_bit = data[at + 16] == 16;
            alpha = data[at + 17] & PNG_COLOR_MASK_ALPHA;
        }
        alpha |= memcmp(type, "tRNS", 4) == 0;
        profile |=
            memcmp(type, "gAMA", 4) == 0 || memcmp(type, "cHRM", 4) == 0 || memcmp(type, "iCCP", 4) == 0;
        if (memcmp(type, "IEND", 4) == 0)
            break;
        at += FRAME + length;
    }
    out->ignored = name_ignored(alpha, profile);
    out->decoder_bytes = ROWS * widest_row(out) + MEMORY_SLACK;
    return out->width == 0 || out->height == 0 || out->width > INT32_MAX || out->height > INT32_MAX
               ? "its width or height is 0 or beyond the format's range"
               : NULL;
}

// Checks the CRC-32 of each chunk (annex D), and the amount of compressed data: a byte inflates to a
// thousand, so data beyond what the picture can need is refused before any time is spent on it.
static const char *check_chunks(str bytes, uint64_t most_data) {
    const unsigned char *data = (const unsigned char *)bytes.ptr;
    uint64_t data_bytes = 0;
    for (size_t at = SIGNATURE;;) {
        uint32_t length = big_endian(data + at, 4);
        const unsigned char *type = data + at + 4;
        if (crc32(crc32(0, type, 4), type + 4, length) != big_endian(type + 4 + length, 4))
            return "a chunk's checksum is wrong: the file is damaged";
        if (memcmp(type, "IEND", 4) == 0)
            break;
        if (memcmp(type, "IDAT", 4) == 0)
            data_bytes += length;
        at += FRAME + length;
    }
    return data_bytes > most_data ? "it has more data than a picture of its size needs" : NULL;
}

// ---- pixels, by libpng

struct job {
    const char *at; // the next byte that libpng has not asked for
    size_t left;
    struct picture_header *header;
    struct picture_rows rows;
    size_t row_bytes;     // bytes of a row as it is kept
    uint64_t memory_left; // memory that libpng may still ask for
    const char *fault;    // what is wrong if libpng gives up now; NULL: nothing
};

static void on_read(png_structp png, png_bytep to, size_t count) {
    struct job *job = png_get_io_ptr(png);
    if (count > job->left)
        png_error(png, "the file ends");
    memcpy(to, job->at, count);
    job->at += count;
    job->left -= count;
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
    struct job *job = png_get_mem_ptr(png);
    if (count > job->memory_left) {
        job->fault = "it has more data than a picture of its size needs";
        return NULL;
    }
    job->memory_left -= count;
    void *memory = heap_alloc(count);
    if (!memory)
        job->fault = picture_no_memory;
    return memory;
}

static void on_free(png_structp png, png_voidp memory) {
    (void)png;
    free(memory);
}

// Of the chunks only those that hold the picture are read: no text, no profile, no gamma correction. Their
// checksums have been compared.
static void set_up(png_structp png, struct job *job) {
    png_set_read_fn(png, job, on_read);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    png_set_crc_action(png, PNG_CRC_QUIET_USE, PNG_CRC_QUIET_USE);
    png_set_user_limits(png, INT32_MAX, INT32_MAX);
}

// Removes the alpha of a row, and counts the pixels where it is not full. It is libpng's last step, so it
// sees an interlaced picture's pixels only once.
static void take_alpha(png_structp png, png_row_infop row, png_bytep data) {
    struct job *job = png_get_user_transform_ptr(png);
    const size_t color = (size_t)COLORS * row->bit_depth / 8, pixel = color / COLORS * (COLORS + 1);
    if (row->channels != COLORS + 1)
        return;
    for (png_uint_32 x = 0; x < row->width; x++) {
        const png_bytep from = data + x * pixel;
        job->header->clear_pixels += from[color] != UINT8_MAX || from[pixel - 1] != UINT8_MAX;
        memmove(data + x * color, from, color);
    }
}

static void ask_for_rgb(png_structp png, struct job *job) {
    static const uint16_t one = 1;
    png_set_expand(png); // palettes, fewer than 8 bits, tRNS
    png_set_gray_to_rgb(png);
    png_set_read_user_transform_fn(png, take_alpha);
    png_set_user_transform_info(png, job, 0, COLORS);
    if (*(const uint8_t *)&one == 1)
        png_set_swap(png); // 16 bits are big-endian in the file
}

// Returns normally, or through libpng's jump to the caller's setjmp.
static void read_rows(png_structp png, png_infop info, struct job *job) {
    struct picture_header *header = job->header;
    header->clear_pixels = 0;
    set_up(png, job);
    job->fault = "its header or its palette is damaged";
    png_read_info(png, info);
    ask_for_rgb(png, job);
    int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    if (png_get_image_width(png, info) != header->width ||
        png_get_image_height(png, info) != header->height || png_get_rowbytes(png, info) != job->row_bytes) {
        job->fault = "its parts contradict each other about its size";
        return;
    }
    job->fault = "its pixels are damaged, or some are missing";
    for (int pass = 0; pass < passes; pass++)
        for (uint32_t y = 0; y < header->height; y++)
            png_read_row(png, picture_row(&job->rows, y), NULL);
    png_read_end(png, info);
    job->fault = NULL;
}

// The job is outside the function that calls setjmp, so that it is defined after a jump.
static void read_guarded(png_structp png, png_infop info, struct job *job) {
    if (setjmp(png_jmpbuf(png)) == 0)
        read_rows(png, info, job);
}

const char *picture_png_rows(str bytes, struct picture_header *header, struct picture_rows rows) {
    const char *fault = check_chunks(bytes, 2 * widest_row(header) * header->height + DATA_SLACK);
    if (fault)
        return fault;
    struct job job = {.at = bytes.ptr,
                      .left = bytes.len,
                      .header = header,
                      .rows = rows,
                      .row_bytes = header->width * picture_pixel_bytes(picture_depth_of(header)),
                      .memory_left = header->decoder_bytes,
                      .fault = picture_no_memory};
    png_structp png =
        png_create_read_struct_2(PNG_LIBPNG_VER_STRING, NULL, on_error, on_warning, &job, on_malloc, on_free);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (info)
        read_guarded(png, info, &job);
    png_destroy_read_struct(&png, &info, NULL);
    return job.fault;
}
