// A picture against its reference: the metrics of glint compare, on displayed values, and how the reference's
// record differs.
#include "cli/commands/test/test.h"

#include "core/heap.h"
#include "files/files.h"
#include "picture/metrics/heatmap.h"
#include "picture/metrics/picture_file.h"
#include "render/record/record.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct judging {
    struct test_run *run;
    struct test_case *test;
    const struct test_made *made;
    struct arena arena; // of the reference's bytes
    str bytes;
    struct picture_file pictures[2]; // the one made now, and the reference
    float *map;                      // the difference of each pixel
    bool failed;                     // no memory
};

static bool wants_shown(const struct test_run *run) {
    return run->cli->options.test.html;
}

// ---- pictures for the page

enum {
    SHOWN_MOST = 1024,       // pixels per side; fewer if the bounds are kept
    SHOWN_MOST_WITHIN = 320, //
};

static uint32_t step_of(const struct test_case *test, uint32_t width, uint32_t height) {
    const uint32_t most =
        test->state == TEST_SAME || test->state == TEST_WITHIN ? SHOWN_MOST_WITHIN : SHOWN_MOST;
    const uint32_t side = width > height ? width : height;
    return (side + most - 1) / most;
}

// Squares of step x step pixels become one pixel: their mean.
static bool show_picture(const struct picture_file *p, uint32_t step, struct strbuf *out) {
    struct image small;
    if (!image_init(&small, (p->width + step - 1) / step, (p->height + step - 1) / step))
        return false;
    for (size_t y = 0; y < small.height; y++)
        for (size_t x = 0; x < small.width; x++) {
            const size_t right = (x + 1) * step < p->width ? (x + 1) * step : p->width;
            const size_t below = (y + 1) * step < p->height ? (y + 1) * step : p->height;
            const double count = (double)((right - x * step) * (below - y * step));
            double sum[3] = {0};
            for (size_t row = y * step; row < below; row++)
                for (size_t at = 3 * (row * p->width + x * step); at < 3 * (row * p->width + right); at++)
                    sum[at % 3] += p->rgb[at];
            for (size_t k = 0; k < 3; k++)
                small.rgb[3 * (y * small.width + x) + k] = (float)(sum[k] / count);
        }
    image_encode(&small, IMAGE_PNG,
                 (struct image_display){.tone = IR_TONE_CLIP, .transfer = IR_TRANSFER_NONE}, out);
    image_finish(&small);
    return !out->failed;
}

// The largest value of each square, so one wrong pixel stays visible.
static bool show_map(const struct judging *j, uint32_t step, struct strbuf *out) {
    const struct picture_file *p = &j->pictures[0];
    const uint32_t width = (p->width + step - 1) / step, height = (p->height + step - 1) / step;
    float *small = heap_zeroed(heap_times(width, height), sizeof *small);
    if (!small)
        return false;
    for (size_t y = 0; y < p->height; y++)
        for (size_t x = 0; x < p->width; x++) {
            float *most = &small[y / step * width + x / step];
            *most = fmaxf(*most, j->map[y * p->width + x]);
        }
    heatmap_png(width, height, small, HEATMAP_LOGARITHMIC, out);
    free(small);
    return !out->failed;
}

static bool show(struct judging *j) {
    struct test_case *test = j->test;
    bool good = true;
    for (int i = 0; i < 2; i++)
        if (j->pictures[i].rgb)
            good = good &&
                   show_picture(&j->pictures[i], step_of(test, j->pictures[i].width, j->pictures[i].height),
                                &test->shown[i ? TEST_SHOWN_REFERENCE : TEST_SHOWN_PICTURE]);
    if (j->map && test->state != TEST_SAME)
        good = good && show_map(j, step_of(test, j->pictures[0].width, j->pictures[0].height),
                                &test->shown[TEST_SHOWN_DIFFERENCE]);
    return good;
}

// ---- the reference's record

static void add_words(struct strbuf *out, const char *format, str value) {
    if (out->len)
        strbuf_cstr(out, "; ");
    if (value.len > 100)
        value.len = 100;
    strbuf_cstr(out, format);
    for (size_t i = 0; i < value.len; i++)
        strbuf_char(out, (unsigned char)value.ptr[i] < ' ' || value.ptr[i] == 0x7f ? '?' : value.ptr[i]);
}

static void compare_records(struct judging *j) {
    struct record_read was, is;
    struct strbuf text;
    record_find(j->bytes, &was);
    record_find(strbuf_view(&j->made->file), &is);
    if (!was.is_there || !is.is_there)
        return;
    strbuf_init(&text);
    if (!str_equal(was.fields[RECORD_SCENE], is.fields[RECORD_SCENE]))
        add_words(&text, "the scene, or a file that it reads, was changed since", STR(""));
    if (!str_equal(was.fields[RECORD_SETTINGS], is.fields[RECORD_SETTINGS]))
        add_words(&text, "the reference was made with ", was.fields[RECORD_SETTINGS]);
    if (!str_equal(was.fields[RECORD_SOFTWARE], is.fields[RECORD_SOFTWARE]))
        add_words(&text, "the reference was made by ", was.fields[RECORD_SOFTWARE]);
    if (!str_equal(was.fields[RECORD_DEVICE], is.fields[RECORD_DEVICE]))
        add_words(&text, "the reference was made on ", was.fields[RECORD_DEVICE]);
    if (text.len == 0 && !text.failed)
        add_words(&text, "the same scene, settings, version and device made another picture", STR(""));
    j->test->record = arena_copy(&j->run->cli->arena, strbuf_view(&text));
    j->failed = j->failed || text.failed;
    strbuf_finish(&text);
}

// ---- figures

bool test_breaks(const struct test_case *test, enum metric metric) {
    return !measure_keeps(&test->settings.bounds, &test->result, metric);
}

// Pixels that are finite in only one float picture: displayed, they might look alike.
static uint64_t count_not_finite(const struct picture_file *p) {
    const uint64_t pixels = (uint64_t)p[0].width * p[0].height;
    uint64_t count = 0;
    for (uint64_t i = 0; i < pixels; i++) {
        bool differs = false;
        for (uint32_t k = 0; k < 3; k++)
            differs = differs || isfinite(p[0].rgb[3 * i + k]) != isfinite(p[1].rgb[3 * i + k]);
        count += differs;
    }
    return count;
}

static bool has_same_pixels(const struct picture_file *p) {
    return memcmp(p[0].rgb, p[1].rgb, (size_t)p[0].width * p[0].height * 3 * sizeof(float)) == 0;
}

static void measure(struct judging *j) {
    struct test_case *test = j->test;
    struct picture_file *p = j->pictures;
    const bool same = has_same_pixels(p);
    const uint64_t not_finite = count_not_finite(p);
    struct measure_options options = measure_options_default();
    for (int i = 0; i < 2; i++)
        if (p[i].space == MEASURE_LINEAR)
            image_to_displayed(p[i].rgb, (size_t)p[i].width * p[i].height, j->made->display, p[i].rgb);
    options.threshold = test->settings.threshold;
    options.metrics = 1u << METRIC_MAE | 1u << METRIC_SHARE;
    for (int m = 0; m < METRIC_COUNT; m++)
        if (test->settings.bounds.has[m])
            options.metrics |= 1u << m;
    if (wants_shown(j->run))
        options.metrics |= 1u << METRIC_FLIP;
    if (wants_shown(j->run))
        j->map = heap_array(heap_times(p[0].width, p[0].height), sizeof *j->map);
    if ((wants_shown(j->run) && !j->map) || !measure_pictures(p[0].width, p[0].height, p[0].rgb, p[1].rgb,
                                                              &options, &test->result, j->map, NULL)) {
        j->failed = true;
        return;
    }
    test->is_measured = true;
    test->result.not_finite_together = not_finite;
    bool keeps = (double)not_finite <= test->settings.bounds.not_finite;
    for (int m = 0; m < METRIC_COUNT; m++)
        keeps = keeps && !test_breaks(test, (enum metric)m);
    test->state = same ? TEST_SAME : keeps ? TEST_WITHIN : TEST_DIFFERS;
}

static const char *read_reference(struct judging *j) {
    struct cli *cli = j->run->cli;
    bool unknown = false;
    const enum file_status read = files_read(
        &j->run->files, j->test->picture, cli->options.limits.value[LIMIT_IMAGE_BYTES], &j->arena, &j->bytes);
    j->test->is_foreign = read != FILE_OK;
    j->test->is_unread = read == FILE_UNREADABLE;
    if (read != FILE_OK)
        return arena_copy(&cli->arena, str_from(file_status_text(&j->run->files, read))).ptr;
    const char *fault = picture_file_decode(j->bytes, cli->options.limits.value[LIMIT_IMAGE_MEMORY],
                                            &j->pictures[1], &unknown);
    j->test->is_foreign = fault && unknown;
    return fault;
}

static void judge(struct judging *j) {
    struct test_case *test = j->test;
    struct arena *arena = &j->run->cli->arena;
    bool unknown;
    const uint64_t most = j->run->cli->options.limits.value[LIMIT_IMAGE_MEMORY];
    if (j->made->file.failed ||
        picture_file_decode(strbuf_view(&j->made->file), most, &j->pictures[0], &unknown)) {
        j->failed = true;
        return;
    }
    if (!test->is_there) {
        test->state = TEST_MISSING;
        return;
    }
    const char *fault = read_reference(j);
    if (fault) {
        test->state = TEST_FAILED;
        test->reason = arena_format(arena, "the reference %.*s: %s", STR_ARG(test->picture), fault);
        return;
    }
    const struct picture_file *p = j->pictures;
    test->was = (struct test_size){p[1].width, p[1].height};
    if (p[0].width == p[1].width && p[0].height == p[1].height) {
        measure(j);
    } else {
        test->state = TEST_DIFFERS;
        test->reason = arena_format(arena, "it has %u x %u pixels, and the reference %u x %u", p[0].width,
                                    p[0].height, p[1].width, p[1].height);
    }
    if (test->state == TEST_DIFFERS)
        compare_records(j);
}

static void guarded(void *context) {
    struct judging *j = context;
    judge(j);
    if (!j->failed && wants_shown(j->run)) {
        const struct image_display display = j->made->display;
        for (int i = 0; i < 2; i++) // not yet displayed: there was nothing to compare
            if (j->pictures[i].rgb && j->pictures[i].space == MEASURE_LINEAR && !j->test->is_measured)
                image_to_displayed(j->pictures[i].rgb, (size_t)j->pictures[i].width * j->pictures[i].height,
                                   display, j->pictures[i].rgb);
        j->failed = !show(j);
    }
}

bool test_judge(struct test_run *run, struct test_case *test, const struct test_made *made) {
    struct judging j = {.run = run, .test = test, .made = made};
    arena_init(&j.arena, SIZE_MAX / 2);
    const bool good = arena_guarded(&j.arena, guarded, &j) == ARENA_FAULT_NONE && !j.failed;
    for (int i = 0; i < 2; i++)
        picture_file_finish(&j.pictures[i]);
    free(j.map);
    arena_finish(&j.arena);
    return good;
}
