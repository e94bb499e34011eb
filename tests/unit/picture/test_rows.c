// Files of pictures whose rows come some at a time: the bytes of those that are in memory as a whole.
#include "picture/write/rows.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// Rows of an image in memory, and a file in memory; both may fail.
struct ends {
    const struct image *image;
    uint32_t asked, most; // rows; most: that were asked for at once
    uint32_t rows_left;   // before taking fails
    struct strbuf file;
    size_t room; // before putting fails
};

static bool take(void *context, uint32_t y, uint32_t count, float *rgb) {
    struct ends *e = context;
    const size_t row = 3 * (size_t)e->image->width;
    assert_true(y + count <= e->image->height);
    e->asked += count;
    e->most = count > e->most ? count : e->most;
    if (e->asked > e->rows_left)
        return false;
    memcpy(rgb, e->image->rgb + y * row, count * row * sizeof *rgb);
    return true;
}

static bool put(void *context, const void *bytes, size_t count) {
    struct ends *e = context;
    if (e->file.len + count > e->room)
        return false;
    strbuf_add(&e->file, bytes, count);
    return true;
}

static bool put_over(void *context, uint64_t at, const void *bytes, size_t count) {
    struct ends *e = context;
    assert_true(at + count <= e->file.len);
    memcpy(e->file.data + at, bytes, count);
    return true;
}

static float noise(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / (float)(1 << 24);
}

// Even places, noise and values that mark or clip.
static void fill(struct image *image) {
    uint32_t state = image->width * 31 + image->height;
    const size_t count = 3 * (size_t)image->width * image->height;
    for (size_t i = 0; i < count; i++)
        image->rgb[i] = i / 4096 % 3 == 0 ? 0.25f : noise(&state) * 1.5f;
    image->rgb[count / 2] = NAN;
}

static const struct image_display shown = {.tone = IR_TONE_CLIP, .transfer = IR_TRANSFER_SRGB};
static const struct image_text lines[] = {{"Software", "glint"}, {"Command", "glint render \xC3\xA4"}};

static bool write(const struct image *image, enum image_format format, struct ends *ends) {
    const struct image_rows rows = {.width = image->width,
                                    .height = image->height,
                                    .take = take,
                                    .context = ends,
                                    .texts = image->texts,
                                    .coding = image->coding};
    const struct image_sink sink = {put, put_over, ends};
    return image_rows_write(&rows, format, shown, &sink);
}

static void check(uint32_t width, uint32_t height, enum image_format format, struct image_coding coding) {
    struct image image;
    struct strbuf whole;
    if (image_format_missing(format))
        return;
    assert_true(image_init(&image, width, height));
    image.texts = (struct image_texts){lines, 2};
    image.coding = coding;
    fill(&image);
    strbuf_init(&whole);
    image_encode(&image, format, shown, &whole);
    assert_false(whole.failed);
    struct ends ends = {.image = &image, .rows_left = UINT32_MAX, .room = SIZE_MAX};
    strbuf_init(&ends.file);
    assert_true(write(&image, format, &ends));
    assert_int_equal(ends.asked, height);
    assert_true(ends.most * (size_t)width * 12 <= IMAGE_ROWS_BYTES * 4 || format == IMAGE_EXR);
    assert_int_equal(ends.file.len, whole.len);
    assert_memory_equal(ends.file.data, whole.data, whole.len);
    strbuf_finish(&ends.file);
    strbuf_finish(&whole);
    image_finish(&image);
}

static void same_bytes(void **state) {
    (void)state;
    static const uint32_t sizes[][2] = {{1, 1}, {7, 5}, {8, 300}, {16384, 3}, {1200, 700}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const uint32_t w = sizes[i][0], h = sizes[i][1];
        check(w, h, IMAGE_PNG, (struct image_coding){0});
        check(w, h, IMAGE_PNG, (struct image_coding){.bits = 16});
        check(w, h, IMAGE_PFM, (struct image_coding){0});
        check(w, h, IMAGE_HDR, (struct image_coding){0});
        for (unsigned c = IMAGE_ZIP; c <= (w < 1200 ? IMAGE_UNCOMPRESSED : IMAGE_ZIP); c++)
            check(w, h, IMAGE_EXR, (struct image_coding){.compression = c, .bits = 16 + 16 * (c & 1)});
    }
}

static void formats(void **state) {
    (void)state;
    assert_true(image_rows_can(IMAGE_PNG) && image_rows_can(IMAGE_PFM) && image_rows_can(IMAGE_HDR) &&
                image_rows_can(IMAGE_EXR));
    assert_false(image_rows_can(IMAGE_JPEG) || image_rows_can(IMAGE_WEBP) || image_rows_can(IMAGE_NONE));
}

// Rows that do not come, and a disk that is full, end every file.
static void failures(void **state) {
    (void)state;
    static const enum image_format all[] = {IMAGE_PNG, IMAGE_PFM, IMAGE_HDR, IMAGE_EXR};
    struct image image;
    assert_true(image_init(&image, 1200, 700));
    fill(&image);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        if (image_format_missing(all[i]))
            continue;
        struct ends rows = {.image = &image, .rows_left = 650, .room = SIZE_MAX};
        struct ends disk = {.image = &image, .rows_left = UINT32_MAX, .room = 500000};
        strbuf_init(&rows.file);
        strbuf_init(&disk.file);
        assert_false(write(&image, all[i], &rows));
        assert_false(write(&image, all[i], &disk));
        assert_true(disk.file.len <= disk.room);
        strbuf_finish(&rows.file);
        strbuf_finish(&disk.file);
    }
    image_finish(&image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_bytes),
        cmocka_unit_test(formats),
        cmocka_unit_test(failures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
