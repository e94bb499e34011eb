// PNG (ISO/IEC 15948): rows filtered and pieces deflated by all threads, one IDAT chunk a piece.
#include "core/parallel.h"
#include "runtime/image/deflate.h"
#include "runtime/image/encode_parts.h"

#include <stdlib.h>
#include <string.h>

enum {
    CHANNELS = 3,
    FILTERS = 5,
    PIECE_ROWS = 16,
};

struct png {
    uint32_t height;
    size_t row; // bytes, without the filter's
    const uint8_t *rgb;
    const uint8_t *zeros; // the row before the first
    uint8_t *filtered;    // (row + 1) * height
    size_t filtered_size;
    struct strbuf *pieces;
    uint32_t crc_table[256];
};

static void put_be32(uint8_t *to, uint32_t value) {
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(value >> (24 - 8 * i));
}

// ISO/IEC 15948, annex D.
static void make_crc_table(uint32_t table[256]) {
    for (uint32_t n = 0; n < 256; n++) {
        uint32_t c = n;
        for (int k = 0; k < 8; k++)
            c = c & 1 ? 0xedb88320u ^ c >> 1 : c >> 1;
        table[n] = c;
    }
}

// Closes a chunk that begins at `start` of `out`: length, type and data stand there.
static void close_chunk(const struct png *png, struct strbuf *out, size_t start) {
    if (out->failed)
        return;
    put_be32((uint8_t *)out->data + start, (uint32_t)(out->len - start - 8));
    uint32_t crc = UINT32_MAX;
    for (size_t i = start + 4; i < out->len; i++)
        crc = png->crc_table[(crc ^ (uint8_t)out->data[i]) & 255] ^ crc >> 8;
    uint8_t bytes[4];
    put_be32(bytes, ~crc);
    strbuf_add(out, bytes, sizeof bytes);
}

static void put_chunk(const struct png *png, struct strbuf *out, const char *type, const uint8_t *data,
                      size_t size) {
    size_t start = out->len;
    strbuf_add(out, "\0\0\0\0", 4);
    strbuf_add(out, type, 4);
    strbuf_add(out, data, size);
    close_chunk(png, out, start);
}

static uint8_t paeth(int left, int up, int corner) {
    int guess = left + up - corner;
    int to_left = abs(guess - left);
    int to_up = abs(guess - up);
    int to_corner = abs(guess - corner);
    return (uint8_t)(to_left <= to_up && to_left <= to_corner ? left : to_up <= to_corner ? up : corner);
}

// Filter `kind` of a row; gives the sum of sizes, which guesses how well it will deflate.
static uint32_t filter_row(int kind, const uint8_t *row, const uint8_t *above, size_t size, uint8_t *out) {
    uint32_t sum = 0;
    for (size_t i = 0; i < size; i++) {
        int left = i < CHANNELS ? 0 : row[i - CHANNELS];
        int corner = i < CHANNELS ? 0 : above[i - CHANNELS];
        int guess = kind == 0   ? 0
                    : kind == 1 ? left
                    : kind == 2 ? above[i]
                    : kind == 3 ? (left + above[i]) / 2
                                : paeth(left, above[i], corner);
        out[i] = (uint8_t)(row[i] - guess);
        sum += out[i] < 128 ? out[i] : 256u - out[i];
    }
    return sum;
}

static void filter_rows(void *context, size_t begin, size_t end) {
    const struct png *png = context;
    for (size_t y = begin; y < end; y++) {
        const uint8_t *row = png->rgb + y * png->row;
        const uint8_t *above = y ? row - png->row : png->zeros;
        uint8_t *out = png->filtered + y * (png->row + 1);
        uint32_t best_sum = UINT32_MAX;
        int best = 0;
        for (int kind = 0; kind < FILTERS; kind++) {
            uint32_t sum = filter_row(kind, row, above, png->row, out + 1);
            if (sum < best_sum) {
                best_sum = sum;
                best = kind;
            }
        }
        if (best != FILTERS - 1)
            filter_row(best, row, above, png->row, out + 1);
        out[0] = (uint8_t)best;
    }
}

// RFC 1950, section 8.2.
static uint32_t adler(const uint8_t *data, size_t size) {
    uint32_t a = 1;
    uint32_t b = 0;
    for (size_t i = 0; i < size;) {
        size_t end = size - i < 5552 ? size : i + 5552;
        for (; i < end; i++) {
            a += data[i];
            b += a;
        }
        a %= 65521;
        b %= 65521;
    }
    return b << 16 | a;
}

static void deflate_pieces(void *context, size_t begin, size_t end) {
    const struct png *png = context;
    for (size_t at = begin; at < end; at += DEFLATE_PIECE_MAX) {
        size_t stop =
            png->filtered_size - at < DEFLATE_PIECE_MAX ? png->filtered_size : at + DEFLATE_PIECE_MAX;
        bool is_last = stop == png->filtered_size;
        struct strbuf *out = &png->pieces[at / DEFLATE_PIECE_MAX];
        strbuf_add(out, "\0\0\0\0IDAT", 8);
        if (at == 0)
            strbuf_add(out, "\170\234", 2); // RFC 1950: a window of 32 KiB, default effort
        deflate_piece(png->filtered, at, stop, is_last, out);
        if (is_last) {
            uint8_t check[4];
            put_be32(check, adler(png->filtered, png->filtered_size));
            strbuf_add(out, check, sizeof check);
        }
        close_chunk(png, out, 0);
    }
}

static void put_head(const struct png *png, uint32_t width, struct strbuf *out) {
    uint8_t head[13] = {[8] = 8, [9] = 2}; // 8 bits a channel, RGB
    put_be32(head, width);
    put_be32(head + 4, png->height);
    strbuf_add(out, "\211PNG\r\n\032\n", 8);
    put_chunk(png, out, "IHDR", head, sizeof head);
}

void encode_png(uint32_t width, uint32_t height, const uint8_t *rgb, struct strbuf *out) {
    struct png png = {.height = height, .row = (size_t)CHANNELS * width, .rgb = rgb};
    png.filtered_size = (png.row + 1) * height;
    size_t pieces = (png.filtered_size + DEFLATE_PIECE_MAX - 1) / DEFLATE_PIECE_MAX;
    uint8_t *zeros = calloc(png.row, 1);
    png.zeros = zeros;
    png.filtered = malloc(png.filtered_size);
    png.pieces = calloc(pieces, sizeof *png.pieces);
    if (zeros && png.filtered && png.pieces) {
        make_crc_table(png.crc_table);
        parallel_for(height, PIECE_ROWS, filter_rows, &png);
        parallel_for(png.filtered_size, DEFLATE_PIECE_MAX, deflate_pieces, &png);
        put_head(&png, width, out);
        for (size_t i = 0; i < pieces; i++) {
            strbuf_add(out, png.pieces[i].data, png.pieces[i].len);
            out->failed |= png.pieces[i].failed;
            strbuf_finish(&png.pieces[i]);
        }
        put_chunk(&png, out, "IEND", NULL, 0);
    } else {
        out->failed = true;
    }
    free(png.pieces);
    free(png.filtered);
    free(zeros);
}
