// A picture in bands on the disk: what was finished is there, whatever ended the process, and nothing else.
#include "render/parts/bands.h"

#include "scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    WIDTH = 9,
    HEIGHT = 30,
    ROWS = 8,
    BANDS = 4,
};

struct fixture {
    struct scratch scratch;
    char path[4200];
    struct part part;
    struct strbuf error;
    float rgb[HEIGHT * WIDTH * 3];
};

static int set_up(void **state) {
    struct fixture *f = calloc(1, sizeof *f);
    *state = f;
    if (!f || !scratch_make(&f->scratch))
        return 1;
    snprintf(f->path, sizeof f->path, "%s/a.png" BANDS_ENDING, f->scratch.folder);
    f->part = (struct part){.scene = {1, 2},
                            .settings = {3, 4},
                            .device = "a device",
                            .record = "Software: glint\tDevice: a device",
                            .width = 20,
                            .height = 40,
                            .region = {3, 5, WIDTH, HEIGHT},
                            .end_sample = 6,
                            .samples = 6};
    for (int i = 0; i < HEIGHT * WIDTH * 3; i++)
        f->rgb[i] = (float)i / 7;
    strbuf_init(&f->error);
    return 0;
}

static int tear_down(void **state) {
    struct fixture *f = *state;
    strbuf_finish(&f->error);
    scratch_finish(&f->scratch);
    free(f);
    return 0;
}

static void put(struct fixture *f, struct bands *bands, uint32_t band) {
    struct bands_faults faults = {0};
    faults.words[0][0] = band;
    assert_true(bands_put(bands, band, f->rgb + (size_t)bands_begin(bands, band) * WIDTH * 3, &faults));
}

static void begin(struct fixture *f, struct bands *bands) {
    assert_true(bands_create(bands, f->path, &f->part, ROWS, &f->error));
    assert_int_equal(bands->count, BANDS);
    assert_int_equal(bands_rows(bands, BANDS - 1), HEIGHT - ROWS * (BANDS - 1));
}

static bool again(struct fixture *f, struct bands *bands) {
    bool missing;
    return bands_open(bands, f->path, NULL, NULL, &missing, &f->error);
}

static void finished_bands_are_there(void **state) {
    struct fixture *f = *state;
    struct bands bands;
    begin(f, &bands);
    put(f, &bands, 3);
    put(f, &bands, 1);
    bands_finish(&bands);
    assert_true(again(f, &bands));
    assert_null(bands_difference(&bands, &f->part));
    assert_string_equal(bands.part.record, f->part.record);
    assert_int_equal(bands.done_count, 2);
    for (uint32_t i = 0; i < BANDS; i++)
        assert_int_equal(bands.done[i], i % 2);
    assert_int_equal(bands.faults[3].words[0][0], 3);
    float rgb[HEIGHT * WIDTH * 3];
    assert_true(bands_take(&bands, 0, HEIGHT, rgb));
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t i = 0; i < WIDTH * 3; i++) {
            const size_t at = (size_t)y * WIDTH * 3 + i;
            assert_true(rgb[at] == (y / ROWS % 2 ? f->rgb[at] : 0));
        }
    assert_true(bands_take(&bands, 10, 3, rgb));
    assert_memory_equal(rgb, f->rgb + 10 * WIDTH * 3, sizeof(float) * 3 * WIDTH * 3);
    bands_remove(&bands);
    assert_int_not_equal(access(f->path, F_OK), 0);
}

// A file that ends anywhere has the bands before that, and is gone on with.
static void cut_anywhere(void **state) {
    struct fixture *f = *state;
    struct bands bands;
    struct stat info;
    begin(f, &bands);
    for (uint32_t i = 0; i < BANDS; i++)
        put(f, &bands, i);
    bands_finish(&bands);
    assert_int_equal(stat(f->path, &info), 0);
    const off_t size = info.st_size, band = (size - BANDS_HEAD_BYTES) / BANDS;
    for (off_t end = size; end >= BANDS_HEAD_BYTES; end -= 97) {
        assert_int_equal(truncate(f->path, end), 0);
        assert_true(again(f, &bands));
        assert_true(bands.done_count == (uint32_t)((end - BANDS_HEAD_BYTES) / band) ||
                    bands.done_count + 1 == (uint32_t)((end - BANDS_HEAD_BYTES) / band));
        for (uint32_t i = 0; i < BANDS; i++)
            assert_int_equal(bands.done[i], i < bands.done_count);
        bands_finish(&bands);
    }
    assert_true(again(f, &bands));
    for (uint32_t i = 0; i < BANDS; i++)
        put(f, &bands, i);
    bands_finish(&bands);
    assert_true(again(f, &bands));
    assert_int_equal(bands.done_count, BANDS);
    bands_finish(&bands);
    assert_int_equal(truncate(f->path, BANDS_HEAD_BYTES - 1), 0);
    assert_false(again(f, &bands));
    assert_non_null(strstr(f->error.data, "is not a checkpoint"));
}

// One byte that is another one, anywhere: no band that has it counts, and no head.
static void changed_anywhere(void **state) {
    struct fixture *f = *state;
    struct bands bands;
    struct stat info;
    begin(f, &bands);
    for (uint32_t i = 0; i < BANDS; i++)
        put(f, &bands, i);
    bands_finish(&bands);
    assert_int_equal(stat(f->path, &info), 0);
    FILE *file = fopen(f->path, "r+b");
    assert_non_null(file);
    setbuf(file, NULL);
    size_t head = 0;
    char text[BANDS_HEAD_BYTES];
    assert_int_equal(fread(text, 1, sizeof text, file), sizeof text);
    while (head + 1 < sizeof text && !(text[head] == '\n' && text[head + 1] == '\n'))
        head++;
    for (off_t at = 0; at < info.st_size; at += at < (off_t)head ? 5 : 41) {
        fseek(file, at, SEEK_SET);
        const int byte = fgetc(file);
        fseek(file, at, SEEK_SET);
        fputc(byte ^ 4, file);
        const bool read = again(f, &bands);
        if (at < (off_t)head)
            assert_false(read);
        else if (at >= BANDS_HEAD_BYTES)
            assert_true(read && bands.done_count == BANDS - 1);
        if (read)
            bands_finish(&bands);
        fseek(file, at, SEEK_SET);
        fputc(byte, file);
    }
    fclose(file);
}

static void another_picture(void **state) {
    struct fixture *f = *state;
    struct bands bands;
    struct part other = f->part;
    begin(f, &bands);
    assert_null(bands_difference(&bands, &other));
    other.scene[1]++;
    assert_non_null(strstr(bands_difference(&bands, &other), "another scene"));
    other = f->part;
    other.settings[0]++;
    assert_non_null(strstr(bands_difference(&bands, &other), "other settings"));
    other = f->part;
    other.region.height--;
    assert_non_null(strstr(bands_difference(&bands, &other), "another part"));
    other = f->part;
    other.width++;
    assert_non_null(strstr(bands_difference(&bands, &other), "another size"));
    bands_finish(&bands);
}

static void no_checkpoint(void **state) {
    struct fixture *f = *state;
    struct bands bands;
    bool missing;
    assert_false(bands_open(&bands, f->path, NULL, NULL, &missing, &f->error));
    assert_true(missing);
    scratch_write(&f->scratch, "a.png" BANDS_ENDING, "glint checkpoint 1\nscene ");
    assert_false(bands_open(&bands, f->path, NULL, NULL, &missing, &f->error));
    assert_false(missing);
    char folder[8400];
    snprintf(folder, sizeof folder, "%s/none/a" BANDS_ENDING, f->scratch.folder);
    strbuf_clear(&f->error);
    assert_false(bands_create(&bands, folder, &f->part, ROWS, &f->error));
    assert_non_null(strstr(f->error.data, "cannot be written"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(finished_bands_are_there, set_up, tear_down),
        cmocka_unit_test_setup_teardown(cut_anywhere, set_up, tear_down),
        cmocka_unit_test_setup_teardown(changed_anywhere, set_up, tear_down),
        cmocka_unit_test_setup_teardown(another_picture, set_up, tear_down),
        cmocka_unit_test_setup_teardown(no_checkpoint, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
