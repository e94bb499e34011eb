// Tone, transfer and rounding as docs/language.md says, and files that other readers would take.
#include "picture/write/encode_internal.h"
#include "picture/write/image.h"

#include "core/parallel.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <png.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_HDR
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb/stb_image.h>

static const struct image_display plain = {.tone = IR_TONE_CLIP, .transfer = IR_TRANSFER_NONE};

static uint8_t byte_of(float value, struct image_display display) {
    struct image image = {.width = 1, .height = 1, .rgb = (float[3]){value, 0, 0}};
    uint8_t bytes[3];
    image_to_bytes(&image, display, bytes);
    assert_int_equal(bytes[1], 0);
    return bytes[0];
}

static void test_rounding(void **state) {
    (void)state;
    for (int i = 0; i < 256; i++) {
        assert_int_equal(byte_of((float)i / 255, plain), i);
        if (i < 255) {
            assert_int_equal(byte_of(((float)i + 0.499f) / 255, plain), i);
            assert_int_equal(byte_of(((float)i + 0.501f) / 255, plain), i + 1);
        }
    }
    assert_int_equal(byte_of(-1, plain), 0);
    assert_int_equal(byte_of(7, plain), 255);
    assert_int_equal(byte_of(INFINITY, plain), 255);
    assert_int_equal(byte_of(-INFINITY, plain), 0);
}

// What is no number is marked, whatever tone and transfer say, and kept where the format can.
static void test_marked(void **state) {
    (void)state;
    static const uint8_t magenta[6] = {255, 0, 255, 255, 0, 255};
    float rgb[6] = {NAN, 0.25f, INFINITY, 1, 9, NAN};
    struct image image = {.width = 2, .height = 1, .rgb = rgb};
    for (unsigned tone = IR_TONE_CLIP; tone <= IR_TONE_NORMALIZE; tone++)
        for (unsigned transfer = IR_TRANSFER_NONE; transfer <= IR_TRANSFER_SRGB; transfer++) {
            uint8_t bytes[6] = {0};
            image_to_bytes(&image, (struct image_display){.tone = tone, .transfer = transfer}, bytes);
            assert_memory_equal(bytes, magenta, sizeof bytes);
        }
    struct strbuf file;
    int width, height, channels;
    strbuf_init(&file);
    image_encode(&image, IMAGE_HDR, plain, &file);
    float *read =
        stbi_loadf_from_memory((const uint8_t *)file.data, (int)file.len, &width, &height, &channels, 3);
    assert_non_null(read);
    for (int i = 0; i < 6; i++)
        assert_true(read[i] == (i % 3 == 1 ? 0 : 1));
    stbi_image_free(read);
    strbuf_finish(&file);
}

static bool holds(const struct strbuf *file, const char *text, size_t length) {
    for (size_t i = 0; i + length <= file->len; i++)
        if (memcmp(file->data + i, text, length) == 0)
            return true;
    return false;
}

// A note is in the head of a file and changes no pixel.
static void test_note(void **state) {
    (void)state;
    static const char chunk[] = "tEXtAccuracy\0at most 1 %", comment[] = "\n# Accuracy: at most 1 %\nFORMAT=";
    float rgb[6] = {0.1f, 0.5f, 1, 0, 0.25f, 0.75f};
    struct image image = {.width = 2, .height = 1, .rgb = rgb};
    static const enum image_format formats[] = {IMAGE_PNG, IMAGE_PFM, IMAGE_HDR};
    for (size_t f = 0; f < sizeof formats / sizeof *formats; f++) {
        const enum image_format format = formats[f];
        struct strbuf files[2];
        int width, height, channels;
        float *read[2];
        for (int i = 0; i < 2; i++) {
            image.note = i ? "at most 1 %" : NULL;
            strbuf_init(&files[i]);
            image_encode(&image, format, plain, &files[i]);
            assert_int_equal(holds(&files[i], chunk, sizeof chunk - 1), i && format == IMAGE_PNG);
            assert_int_equal(holds(&files[i], comment, sizeof comment - 1), i && format == IMAGE_HDR);
        }
        assert_int_equal(files[0].len == files[1].len, format == IMAGE_PFM);
        for (int i = 0; i < 2 && format != IMAGE_PFM; i++) {
            read[i] = stbi_loadf_from_memory((const uint8_t *)files[i].data, (int)files[i].len, &width,
                                             &height, &channels, 3);
            assert_non_null(read[i]);
        }
        if (format != IMAGE_PFM) {
            assert_memory_equal(read[0], read[1], sizeof rgb);
            stbi_image_free(read[0]);
            stbi_image_free(read[1]);
        }
        strbuf_finish(&files[0]);
        strbuf_finish(&files[1]);
    }
}

static void test_normalize(void **state) {
    (void)state;
    const struct image_display normalize = {.tone = IR_TONE_NORMALIZE, .transfer = IR_TRANSFER_NONE};
    struct image image = {
        .width = 4, .height = 1, .rgb = (float[12]){4, 2, 1, 0.5f, 0.25f, 1, INFINITY, 3, INFINITY, 0, 2, 1}};
    static const uint8_t expected[12] = {255, 128, 64, 128, 64, 255, 255, 0, 255, 0, 255, 128};
    uint8_t bytes[12];
    image_to_bytes(&image, normalize, bytes);
    assert_memory_equal(bytes, expected, sizeof bytes);
    static const uint8_t clipped[12] = {255, 255, 255, 128, 64, 255, 255, 255, 255, 0, 255, 255};
    image_to_bytes(&image, plain, bytes);
    assert_memory_equal(bytes, clipped, sizeof bytes);
}

static void assert_shown(struct image_display display, const float linear[3], const double expected[3]) {
    float shown[3];
    image_to_displayed(linear, 1, display, shown);
    for (int i = 0; i < 3; i++)
        assert_true(fabs((double)shown[i] - expected[i]) < 1e-6);
}

// Values computed by hand from the formulas.
static void test_tones(void **state) {
    (void)state;
    const struct image_display neutral = {.tone = IR_TONE_NEUTRAL}, filmic = {.tone = IR_TONE_FILMIC};
    const float grey[3] = {0.5f, 0.5f, 0.5f}, white[3] = {4, 4, 4}, red[3] = {2, 0, 0},
                one[3] = {1, 0.18f, 0};
    assert_shown(neutral, grey, (double[3]){0.46, 0.46, 0.46});
    assert_shown(neutral, white, (double[3]){0.983255814, 0.983255814, 0.983255814});
    assert_shown(neutral, red, (double[3]){0.961081081, 0.129579857, 0.129579857});
    assert_shown(filmic, one, (double[3]){0.803797468, 0.266899, 0});
    const float far[3] = {INFINITY, 1e38f, NAN}, below[3] = {-1, -0.5f, -INFINITY};
    for (unsigned tone = IR_TONE_CLIP; tone <= IR_TONE_FILMIC; tone++) {
        float shown[6];
        const struct image_display display = {.tone = tone, .exposure = 100};
        image_to_displayed(far, 1, display, shown);
        image_to_displayed(below, 1, display, shown + 3);
        for (int i = 0; i < 6; i++)
            assert_true(shown[i] >= 0 && shown[i] <= 1);
    }
}

// A stop doubles what is shown, with every tone.
static void test_exposure(void **state) {
    (void)state;
    const float dim[3] = {0.25f, 0.125f, 0.03125f}, bright[3] = {1, 0.5f, 0.125f};
    for (unsigned tone = IR_TONE_CLIP; tone <= IR_TONE_FILMIC; tone++) {
        float a[3], b[3];
        image_to_displayed(dim, 1, (struct image_display){.tone = tone, .exposure = 2}, a);
        image_to_displayed(bright, 1, (struct image_display){.tone = tone}, b);
        assert_memory_equal(a, b, sizeof a);
        image_to_displayed(bright, 1, (struct image_display){.tone = tone, .exposure = -2}, b);
        image_to_displayed(dim, 1, (struct image_display){.tone = tone}, a);
        assert_memory_equal(a, b, sizeof a);
    }
}

// Of 1000 pixels 100 are too bright, and the five brightest may stay so.
static void test_clipped(void **state) {
    (void)state;
    static float rgb[3000];
    struct image image = {.width = 100, .height = 10, .rgb = rgb};
    double exposure = 7;
    for (int i = 0; i < 1000; i++) // 1, or in another channel 4, or 64
        rgb[3 * i + i % 3] = i % 10 ? 1 : i % 200 ? 4 : 64;
    assert_true(fabs(image_clipped(&image, plain, 0.05, &exposure) - 0.1) < 1e-12);
    assert_true(fabs(exposure + 2) < 1e-9);
    assert_true(image_clipped(&image, (struct image_display){.exposure = 1}, 0.05, &exposure) == 1);
    assert_true(fabs(exposure + 2) < 1e-9);
    exposure = 7;
    assert_true(image_clipped(&image, plain, 0.1, &exposure) == 0);
    assert_true(image_clipped(&image, (struct image_display){.tone = IR_TONE_NEUTRAL}, 0.05, &exposure) == 0);
    assert_true(image_clipped(&image, (struct image_display){.exposure = -6}, 0, &exposure) == 0);
    image.rgb = NULL;
    assert_true(image_clipped(&image, plain, 0.05, &exposure) == 0);
    assert_true(exposure == 7);
}

// The table of thresholds against the formula, on floats of all sizes.
static void test_srgb(void **state) {
    (void)state;
    const size_t count = 400000;
    const struct image_display srgb = {.tone = IR_TONE_CLIP, .transfer = IR_TRANSFER_SRGB};
    struct image image;
    assert_true(image_init(&image, (uint32_t)count, 1));
    uint8_t *bytes = malloc(3 * count);
    uint32_t bits = 1;
    for (size_t i = 0; i < 3 * count; i++) {
        bits = bits * 1664525u + 1013904223u;
        image.rgb[i] =
            i % 2 ? (float)(bits >> 8) * 0x1p-24f : ldexpf((float)(bits >> 8) * 0x1p-24f, -(int)(i % 16));
    }
    image_to_bytes(&image, srgb, bytes);
    for (size_t i = 0; i < 3 * count; i++) {
        double c = image.rgb[i];
        double shown = c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
        assert_int_equal(bytes[i], (int)floor(255 * shown + 0.5));
    }
    free(bytes);
    image_finish(&image);
    assert_int_equal(byte_of(2, srgb), 255);
    assert_int_equal(byte_of(0.5f, srgb), 188);
}

static struct image pattern(uint32_t width, uint32_t height) {
    struct image image;
    assert_true(image_init(&image, width, height));
    for (size_t i = 0; i < (size_t)width * height * 3; i++)
        image.rgb[i] = i % 5 ? (float)(i * i % 257) / 256 : 0.25f;
    return image;
}

static void check_png(const struct image *image, size_t at_most) {
    size_t size = (size_t)3 * image->width * image->height;
    uint8_t *bytes = malloc(size);
    image_to_bytes(image, plain, bytes);
    struct strbuf file;
    strbuf_init(&file);
    image_encode(image, IMAGE_PNG, plain, &file);
    assert_false(file.failed);
    assert_true(file.len <= at_most);
    int width, height, channels;
    uint8_t *read =
        stbi_load_from_memory((const uint8_t *)file.data, (int)file.len, &width, &height, &channels, 0);
    assert_non_null(read);
    assert_int_equal(width, (int)image->width);
    assert_int_equal(height, (int)image->height);
    assert_int_equal(channels, 3);
    assert_memory_equal(read, bytes, size);
    stbi_image_free(read);
    strbuf_finish(&file);
    free(bytes);
}

// Pictures of one piece and of many; even ones, noise, and noise that repeats far away.
static void test_png(void **state) {
    (void)state;
    static const uint32_t sizes[][2] = {{1, 1},    {2, 3},     {67, 41},  {1, 3000},
                                        {3000, 1}, {640, 480}, {211, 823}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        struct image image = pattern(sizes[i][0], sizes[i][1]);
        size_t count = (size_t)image.width * image.height * 3;
        size_t most = (count + image.height) * 101 / 100 + 200; // each row has a byte for its filter
        check_png(&image, most);
        uint32_t bits = 1;
        for (size_t k = 0; k < count; k++) {
            bits = bits * 1664525u + 1013904223u;
            image.rgb[k] = (float)(bits >> 8) * 0x1p-24f;
        }
        check_png(&image, most);
        for (size_t k = 20001; k < count; k++)
            image.rgb[k] = image.rgb[k - 20001];
        check_png(&image, most);
        memset(image.rgb, 0, count * sizeof *image.rgb);
        check_png(&image, 200 + most / 200);
        image_finish(&image);
    }
}

// On all processors, or on a share of them.
static void encode_each(void *context, size_t begin, size_t end) {
    struct strbuf *files = context;
    struct image image = pattern(500, 700);
    for (size_t i = begin; i < end; i++)
        image_encode(&image, IMAGE_PNG, plain, &files[i]);
    image_finish(&image);
}

// The cut into pieces is fixed, so that threads cannot show.
static void test_png_repeats(void **state) {
    (void)state;
    enum {
        FILES = 65 // more than threads at most: all but the first are made on one
    };
    struct strbuf files[FILES];
    for (int i = 0; i < FILES; i++)
        strbuf_init(&files[i]);
    encode_each(files, 0, 1);
    parallel_for(FILES - 1, 1, encode_each, files + 1);
    for (int i = 0; i < FILES; i++) {
        assert_false(files[i].failed);
        assert_int_equal(files[0].len, files[i].len);
        assert_memory_equal(files[0].data, files[i].data, files[0].len);
    }
    for (int i = 0; i < FILES; i++)
        strbuf_finish(&files[i]);
}

static void on_write(png_structp png, png_bytep bytes, size_t count) {
    strbuf_add(png_get_io_ptr(png), bytes, count);
}

static size_t size_by_libpng(uint32_t width, uint32_t height, const uint8_t *rgb) {
    struct strbuf file;
    strbuf_init(&file);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &file, on_write, NULL);
    png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (uint32_t y = 0; y < height; y++)
        png_write_row(png, rgb + (size_t)3 * width * y);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    const size_t size = file.len;
    strbuf_finish(&file);
    return size;
}

// What is bought with speed: a picture like those that are rendered is hardly larger than by libpng alone.
static void test_png_size(void **state) {
    (void)state;
    struct strbuf file;
    int width, height, channels;
    uint8_t *rgb = stbi_load("docs/showcase.png", &width, &height, &channels, 3);
    assert_non_null(rgb);
    strbuf_init(&file);
    encode_png((uint32_t)width, (uint32_t)height, rgb, NULL, &file);
    const size_t whole = size_by_libpng((uint32_t)width, (uint32_t)height, rgb);
    assert_in_range(file.len, 1, whole + whole / 20);
    strbuf_finish(&file);
    stbi_image_free(rgb);
}

static void test_pfm(void **state) {
    (void)state;
    struct image image = {
        .width = 2, .height = 2, .rgb = (float[12]){1, 2, 3, 4, 5, 6, 7, 8, 9, 10, -1.5f, 0}};
    struct strbuf file;
    strbuf_init(&file);
    image_encode(&image, IMAGE_PFM, plain, &file);
    static const char head[] = "PF\n2 2\n-1.0\n";
    assert_int_equal(file.len, strlen(head) + 48);
    assert_memory_equal(file.data, head, strlen(head));
    static const uint8_t seven[4] = {0, 0, 0xe0, 0x40};
    static const uint8_t one[4] = {0, 0, 0x80, 0x3f};
    assert_memory_equal(file.data + strlen(head), seven, 4); // the bottom row comes first
    assert_memory_equal(file.data + strlen(head) + 24, one, 4);
    strbuf_finish(&file);
}

static void check_hdr(const struct image *image) {
    struct strbuf file;
    strbuf_init(&file);
    image_encode(image, IMAGE_HDR, plain, &file);
    assert_false(file.failed);
    int width, height, channels;
    float *read =
        stbi_loadf_from_memory((const uint8_t *)file.data, (int)file.len, &width, &height, &channels, 0);
    assert_non_null(read);
    assert_int_equal(width, (int)image->width);
    assert_int_equal(height, (int)image->height);
    for (size_t i = 0; i < (size_t)image->width * image->height; i++) {
        float largest = 0;
        for (size_t k = 3 * i; k < 3 * i + 3; k++)
            largest = fmaxf(largest, image->rgb[k] > 0 ? fminf(image->rgb[k], 0x1p127f) : 0);
        for (size_t k = 3 * i; k < 3 * i + 3; k++) {
            float c = image->rgb[k] > 0 ? fminf(image->rgb[k], 0x1p127f) : 0;
            assert_true(fabsf(read[k] - c) <= largest / 128);
        }
    }
    stbi_image_free(read);
    strbuf_finish(&file);
}

static void test_hdr(void **state) {
    (void)state;
    static const uint32_t widths[] = {1, 7, 8, 9, 127, 128, 129, 300, 1000};
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++) {
        struct image image = pattern(widths[i], 5);
        for (uint32_t x = widths[i] / 3; x < widths[i] * 2 / 3; x++) // a run
            memset(image.rgb + 3 * (size_t)x, 0, 3 * sizeof *image.rgb);
        image.rgb[0] = 1e6f;
        if (widths[i] > 8) {
            image.rgb[6] = INFINITY;
            image.rgb[9] = -2;
            image.rgb[12] = 1e-30f;
        }
        check_hdr(&image);
        image_finish(&image);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_marked),      cmocka_unit_test(test_rounding), cmocka_unit_test(test_note),
        cmocka_unit_test(test_normalize),   cmocka_unit_test(test_tones),    cmocka_unit_test(test_exposure),
        cmocka_unit_test(test_clipped),     cmocka_unit_test(test_srgb),     cmocka_unit_test(test_png),
        cmocka_unit_test(test_png_repeats), cmocka_unit_test(test_png_size), cmocka_unit_test(test_pfm),
        cmocka_unit_test(test_hdr),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
