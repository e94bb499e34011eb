// PNG of every kind that there is: colour type, depth, interlaced or not, filters, transparency.
#include "picture/read/picture_read.h"

#include "png_kit.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <setjmp.h>

#include <cmocka.h>

enum {
    WIDTH = 11,
    HEIGHT = 13,
    CHANNELS_MAX = 4,
    ROW_MAX = WIDTH * CHANNELS_MAX * 2,
    GRAY = 0,
    RGB = 2,
    PALETTE = 3,
    GRAY_ALPHA = 4,
    RGB_ALPHA = 6,
};

struct kind {
    int color, depth, channels;
    bool interlaced, transparent; // tRNS
};

static unsigned sample_of(const struct kind *kind, int x, int y, int channel) {
    unsigned noise = (unsigned)(x * 7919 + y * 104729 + channel * 1299709);
    noise = (noise ^ noise >> 7) * 2654435761u;
    return (noise >> 8) & ((1u << kind->depth) - 1);
}

static unsigned palette_entry(unsigned index, int channel) {
    return (index * (channel == 0 ? 7 : channel == 1 ? 31 : 101) + 5) & 0xFF;
}

// The pixel as the standard defines it: fewer than 8 bits are spread over 0..255. What is transparent keeps
// its colour.
static void expected_pixel(const struct kind *kind, int x, int y, unsigned rgb[3]) {
    unsigned most = kind->depth == 16 ? UINT16_MAX : UINT8_MAX;
    unsigned own_most = (1u << kind->depth) - 1;
    for (int c = 0; c < 3; c++) {
        unsigned sample = sample_of(kind, x, y, kind->channels >= 3 ? c : 0);
        rgb[c] = kind->color == PALETTE ? palette_entry(sample, c) : sample * (most / own_most);
    }
}

// Alpha, the alpha of an entry of the palette, or the one colour that tRNS makes transparent (11.3.2.1).
static bool is_clear(const struct kind *kind, int x, int y) {
    if (kind->color == GRAY_ALPHA || kind->color == RGB_ALPHA)
        return sample_of(kind, x, y, kind->channels - 1) != (1u << kind->depth) - 1;
    if (kind->color == PALETTE)
        return kind->transparent && palette_entry(sample_of(kind, x, y, 0), 3) != UINT8_MAX;
    bool is_key = kind->transparent;
    for (int c = 0; c < kind->channels; c++)
        is_key &= sample_of(kind, x, y, c) == sample_of(kind, 0, 0, c);
    return is_key;
}

// Every `step`th pixel of a row from `first`; returns the bytes.
static size_t pack_row(const struct kind *kind, int y, int first, int step, uint8_t *out) {
    size_t bit = 0;
    memset(out, 0, ROW_MAX);
    for (int x = first; x < WIDTH; x += step)
        for (int c = 0; c < kind->channels; c++)
            for (int b = kind->depth - 1; b >= 0; b--, bit++)
                out[bit / 8] |= (uint8_t)((sample_of(kind, x, y, c) >> b & 1) << (7 - bit % 8));
    return (bit + 7) / 8;
}

static int paeth(int a, int b, int c) {
    int pa = abs(b - c), pb = abs(a - c), pc = abs(a + b - 2 * c);
    return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

// One pass (ISO/IEC 15948, 8.2), its rows filtered by each method in turn (9.2).
static void put_pass(const struct kind *kind, const int pass[4], struct strbuf *out) {
    uint8_t rows[2][ROW_MAX] = {{0}};
    size_t pixel = kind->depth < 8 ? 1 : (size_t)(kind->channels * kind->depth / 8);
    int count = 0;
    for (int y = pass[1]; y < HEIGHT && pass[0] < WIDTH; y += pass[3], count++) {
        uint8_t *row = rows[count & 1];
        const uint8_t *above = rows[~count & 1];
        size_t size = pack_row(kind, y, pass[0], pass[2], row);
        int method = count % 5;
        strbuf_char(out, (char)method);
        for (size_t i = 0; i < size; i++) {
            int a = i >= pixel ? row[i - pixel] : 0, b = above[i], c = i >= pixel ? above[i - pixel] : 0;
            int guesses[5] = {0, a, b, (a + b) / 2, paeth(a, b, c)};
            strbuf_char(out, (char)(row[i] - guesses[method]));
        }
    }
}

static void put_rows(const struct kind *kind, struct strbuf *file) {
    static const int whole[4] = {0, 0, 1, 1};
    static const int passes[7][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                     {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
    struct strbuf rows;
    strbuf_init(&rows);
    if (kind->interlaced)
        for (int i = 0; i < 7; i++)
            put_pass(kind, passes[i], &rows);
    else
        put_pass(kind, whole, &rows);
    png_put_rows(file, rows.data, rows.len);
    strbuf_finish(&rows);
}

static void put_palette(const struct kind *kind, struct strbuf *file) {
    unsigned count = 1u << kind->depth;
    uint8_t colors[3 * 256], alphas[256];
    for (unsigned i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++)
            colors[3 * i + (unsigned)c] = (uint8_t)palette_entry(i, c);
        alphas[i] = (uint8_t)palette_entry(i, 3);
    }
    png_put_chunk(file, "PLTE", colors, 3 * (size_t)count);
    if (kind->transparent)
        png_put_chunk(file, "tRNS", alphas, count);
}

static void put_file(const struct kind *kind, struct strbuf *file) {
    uint8_t key[2 * 3];
    png_put_header(file, WIDTH, HEIGHT, (char)kind->depth, (char)kind->color, kind->interlaced);
    // What a decoder might obey: linear values, four of eight bits.
    png_put_chunk(file, "gAMA", "\0\1\x86\xA0", 4);
    for (int c = 0; c < 3; c++) {
        key[2 * c] = (uint8_t)(sample_of(kind, 0, 0, c) >> 8);
        key[2 * c + 1] = (uint8_t)sample_of(kind, 0, 0, c);
    }
    if (kind->color == PALETTE)
        put_palette(kind, file);
    else if (kind->transparent)
        png_put_chunk(file, "tRNS", key, 2 * (size_t)kind->channels);
    put_rows(kind, file);
}

static void check_kind(const struct kind *kind) {
    struct strbuf file;
    struct picture_header header;
    struct picture picture = {0};
    uint64_t clear = 0;
    strbuf_init(&file);
    put_file(kind, &file);
    assert_null(picture_read_header(strbuf_view(&file), &header));
    assert_null(picture_check(strbuf_view(&file), &header));
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            clear += is_clear(kind, x, y);
    assert_int_equal(header.clear_pixels, clear);
    assert_null(picture_decode(strbuf_view(&file), &header, &picture));
    assert_int_equal(picture.clear_pixels, clear);
    assert_int_equal(picture.depth, kind->depth == 16 ? PICTURE_16 : PICTURE_8);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            unsigned expected[3];
            expected_pixel(kind, x, y, expected);
            for (size_t c = 0; c < 3; c++) {
                unsigned is = picture_stored(&picture, (size_t)(y * WIDTH + x), c);
                if (is != expected[c])
                    fail_msg("colour type %d, %d bits%s%s: %d %d, channel %zu is %u, not %u", kind->color,
                             kind->depth, kind->interlaced ? ", interlaced" : "",
                             kind->transparent ? ", tRNS" : "", x, y, c, is, expected[c]);
            }
        }
    picture_finish(&picture);
    strbuf_finish(&file);
}

static void pixels_are_those_of_the_standard(void **state) {
    (void)state;
    static const struct {
        int color, channels, least, most;
    } colors[] = {
        {GRAY, 1, 1, 16}, {RGB, 3, 8, 16}, {PALETTE, 1, 1, 8}, {GRAY_ALPHA, 2, 8, 16}, {RGB_ALPHA, 4, 8, 16}};
    for (size_t i = 0; i < sizeof colors / sizeof *colors; i++)
        for (int depth = colors[i].least; depth <= colors[i].most; depth *= 2)
            for (int way = 0; way < (colors[i].color < GRAY_ALPHA ? 4 : 2); way++)
                check_kind(&(struct kind){colors[i].color, depth, colors[i].channels, way & 1, way & 2});
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_are_those_of_the_standard),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
