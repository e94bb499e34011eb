// OpenEXR files: what was written is read, whatever the coding; every prefix and damage ends with a finding
// or a picture. An argument is how many damaged files are tried of each kind.
#include "core/heap.h"
#include "picture/read/picture_read.h"
#include "picture/write/exr_file.h"
#include "picture/write/image.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static uint64_t tries = 300;

static uint64_t next(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return *state >> 33;
}

static struct image picture_of(uint32_t width, uint32_t height, struct image_coding coding) {
    struct image image;
    uint64_t state = width * 1000 + height;
    assert_true(image_init(&image, width, height));
    image.coding = coding;
    for (size_t i = 0; i < (size_t)3 * width * height; i++)
        image.rgb[i] = i % 7 == 0 ? 0 : (float)(next(&state) % 2048) / 32; // halves hold it exactly
    return image;
}

static struct strbuf file_of(const struct image *image) {
    struct strbuf file;
    strbuf_init(&file);
    image_encode(image, IMAGE_EXR, (struct image_display){0}, &file);
    assert_false(file.failed);
    return file;
}

static void assert_reads(const struct image *image, str bytes) {
    struct picture_header header;
    struct picture picture;
    assert_null(picture_read_header(bytes, &header));
    assert_int_equal(header.kind, IMAGE_EXR);
    assert_int_equal(header.width, image->width);
    assert_int_equal(header.height, image->height);
    assert_null(picture_check(bytes, &header));
    assert_null(picture_decode(bytes, &header, &picture));
    assert_int_equal(picture.depth, PICTURE_FLOAT);
    assert_memory_equal(picture.pixels, image->rgb, (size_t)12 * image->width * image->height);
    assert_null(picture.ignored);
    picture_finish(&picture);
}

static void for_each(void (*check)(const struct image *image, str file)) {
    static const uint32_t sizes[][2] = {{1, 1}, {7, 40}, {65, 33}};
    for (unsigned compression = IMAGE_ZIP; compression <= IMAGE_UNCOMPRESSED; compression++)
        for (unsigned bits = 16; bits <= 32; bits += 16)
            for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
                struct image image =
                    picture_of(sizes[i][0], sizes[i][1],
                               (struct image_coding){.bits = bits, .compression = compression});
                struct strbuf file = file_of(&image);
                check(&image, strbuf_view(&file));
                strbuf_finish(&file);
                image_finish(&image);
            }
}

static void check_same(const struct image *image, str bytes) {
    struct strbuf again = file_of(image);
    assert_reads(image, bytes);
    assert_int_equal(again.len, bytes.len);
    assert_memory_equal(again.data, bytes.ptr, bytes.len);
    strbuf_finish(&again);
}

static void test_round_trip(void **state) {
    (void)state;
    for_each(check_same);
}

// NULL: it is read to its end; the same whether pixels are kept or not.
static const char *fault_of(str bytes) {
    struct picture_header header;
    struct picture picture;
    const char *fault = picture_read_header(bytes, &header);
    if (fault || header.kind != IMAGE_EXR || (uint64_t)header.width * header.height > 1 << 20)
        return fault ? fault : "another kind";
    const char *checked = picture_check(bytes, &header);
    fault = picture_decode(bytes, &header, &picture);
    assert_true(checked == fault);
    for (size_t i = 0; !fault && i < (size_t)3 * picture.width * picture.height; i++)
        assert_true(isfinite(picture_linear(&picture, i / 3, i % 3)) &&
                    picture_linear(&picture, i / 3, i % 3) >= 0);
    picture_finish(&picture);
    return fault;
}

// Each in memory of its own, so that what reads beyond its end is seen.
static const char *fault_of_copy(const char *bytes, size_t count) {
    char *copy = malloc(count ? count : 1);
    memcpy(copy, bytes, count);
    const char *fault = fault_of((str){copy, count});
    free(copy);
    return fault;
}

static void check_prefixes(const struct image *image, str bytes) {
    (void)image;
    for (size_t count = 0; count < bytes.len; count += count < 600 ? 1 : 13)
        assert_non_null(fault_of_copy(bytes.ptr, count));
    assert_non_null(fault_of_copy(bytes.ptr, bytes.len - 1));
}

static void test_prefixes(void **state) {
    (void)state;
    for_each(check_prefixes);
}

static void check_damage(const struct image *image, str bytes) {
    (void)image;
    uint64_t seed = bytes.len;
    char *copy = malloc(bytes.len);
    for (uint64_t i = 0; i < tries; i++) {
        memcpy(copy, bytes.ptr, bytes.len);
        for (uint64_t k = next(&seed) % 4 + 1; k > 0; k--) {
            // Half of it is in the head, where a byte means most.
            const size_t most = next(&seed) % 2 && bytes.len > 400 ? 400 : bytes.len;
            copy[next(&seed) % most] = (char)(next(&seed) % 3 ? next(&seed) : next(&seed) % 2 * 255);
        }
        fault_of_copy(copy, bytes.len);
    }
    free(copy);
}

static void test_damage(void **state) {
    (void)state;
    for_each(check_damage);
}

static void write_channels(const char *const *names, uint32_t count, enum exr_type type, const float *value,
                           struct strbuf *out) {
    struct exr_channel channels[4];
    for (uint32_t i = 0; i < count; i++)
        channels[i] = (struct exr_channel){names[i], type, &value[i], sizeof *value};
    const struct exr_file file = {
        .width = 1, .height = 1, .compression = IMAGE_ZIP, .channels = channels, .channel_count = count};
    strbuf_init(out);
    exr_file_write(&file, out);
    assert_false(out->failed);
}

static void expect_fault(const char *const *names, uint32_t count, enum exr_type type, const float *value,
                         const char *fault) {
    struct strbuf file;
    write_channels(names, count, type, value, &file);
    const char *got = fault_of(strbuf_view(&file));
    if (fault)
        assert_string_equal(got, fault);
    else
        assert_null(got);
    strbuf_finish(&file);
}

static void test_forms(void **state) {
    (void)state;
    static const char *const rgb[] = {"R", "G", "B"}, *const rg[] = {"R", "G"}, *const y[] = {"Y"};
    static const float values[] = {1, 0.5f, 0.25f, 2}, endless[] = {1, INFINITY, 0}, none[] = {NAN, 1, 1};
    expect_fault(rgb, 3, EXR_TYPE_FLOAT, values, NULL);
    expect_fault(y, 1, EXR_TYPE_HALF, values, NULL);
    expect_fault(rg, 2, EXR_TYPE_HALF, values, "it has no channels R, G and B, and no channel Y");
    expect_fault(rgb, 3, EXR_TYPE_UINT, values, "its colours are whole numbers; half and float are read");
    expect_fault(rgb, 3, EXR_TYPE_FLOAT, endless, "a pixel of it is infinite or not a number");
    expect_fault(rgb, 3, EXR_TYPE_HALF, none, "a pixel of it is infinite or not a number");
}

// What is not used is said.
static void test_ignored(void **state) {
    (void)state;
    static const char *const rgba[] = {"R", "G", "B", "A"};
    static const float values[] = {1, -0.5f, 0.25f, 2};
    struct picture_header header;
    struct picture picture;
    struct strbuf file;
    write_channels(rgba, 4, EXR_TYPE_HALF, values, &file);
    assert_null(picture_read_header(strbuf_view(&file), &header));
    assert_string_equal(header.ignored, "channels other than its colours are");
    assert_null(picture_decode(strbuf_view(&file), &header, &picture));
    assert_string_equal(picture.ignored, "negative values, and channels other than its colours are");
    assert_true(picture_linear(&picture, 0, 0) == 1 && picture_linear(&picture, 0, 1) == 0);
    picture_finish(&picture);
    strbuf_finish(&file);
}

static int skip_without_library(void **state) {
    (void)state;
    if (image_format_missing(IMAGE_EXR)) {
        print_message("%s\n", image_format_missing(IMAGE_EXR));
        exit(77);
    }
    return 0;
}

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], "few") != 0)
        tries = strtoull(argv[1], NULL, 10);
    else if (argc > 1)
        tries = 50;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip), cmocka_unit_test(test_prefixes), cmocka_unit_test(test_damage),
        cmocka_unit_test(test_forms),      cmocka_unit_test(test_ignored),
    };
    return cmocka_run_group_tests(tests, skip_without_library, NULL);
}
