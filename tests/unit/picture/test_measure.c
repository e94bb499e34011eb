// Each metric against its closed form, or a value computed apart by the definition of its paper.
#include "picture/metrics/compare_report.h"
#include "picture/metrics/heatmap.h"
#include "picture/metrics/metrics.h"
#include "picture/metrics/picture_file.h"

#include "picture/write/image.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    WIDTH = 24,
    HEIGHT = 20,
    PIXELS = WIDTH * HEIGHT,
};

struct pair {
    float a[3 * PIXELS], b[3 * PIXELS];
    struct measure_options options;
    struct measure_result result;
    float difference[PIXELS], flip[PIXELS];
};

static void fill(float *picture, float r, float g, float b) {
    for (size_t i = 0; i < PIXELS; i++) {
        picture[3 * i] = r;
        picture[3 * i + 1] = g;
        picture[3 * i + 2] = b;
    }
}

static struct pair *pair_new(float a, float b) {
    struct pair *p = calloc(1, sizeof *p);
    assert_non_null(p);
    p->options = measure_options_default();
    fill(p->a, a, a, a);
    fill(p->b, b, b, b);
    return p;
}

static void measure(struct pair *p) {
    assert_true(measure_pictures(WIDTH, HEIGHT, p->a, p->b, &p->options, &p->result, p->difference, p->flip));
}

static void near(double value, double expected, double tolerance) {
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.9g is not %.9g within %g", value, expected, tolerance);
}

static void test_equal(void **state) {
    (void)state;
    struct pair *p = pair_new(0.25f, 0.25f);
    measure(p);
    const double *v = p->result.value;
    assert_true(v[METRIC_MAE] == 0 && v[METRIC_RMSE] == 0 && v[METRIC_RELMSE] == 0 && v[METRIC_LARGEST] == 0);
    assert_true(isinf(v[METRIC_PSNR]) && v[METRIC_PSNR] > 0);
    near(v[METRIC_SSIM], 1, 1e-6);
    assert_true(v[METRIC_FLIP] == 0 && v[METRIC_SHARE] == 0);
    assert_int_equal(p->result.over, 0);
    free(p);
}

// A constant difference of 1/4 against 1/2.
static void test_constant(void **state) {
    (void)state;
    struct pair *p = pair_new(0.75f, 0.5f);
    measure(p);
    const double *v = p->result.value;
    near(v[METRIC_MAE], 0.25, 1e-12);
    near(v[METRIC_RMSE], 0.25, 1e-12);
    near(v[METRIC_RELMSE], 0.0625 / 0.26, 1e-12);
    near(v[METRIC_LARGEST], 0.25, 0);
    near(v[METRIC_PSNR], 10 * log10(16), 1e-9);
    // No variance: only the term of the means is left.
    near(v[METRIC_SSIM], (2 * 0.75 * 0.5 + 1e-4) / (0.75 * 0.75 + 0.5 * 0.5 + 1e-4), 1e-5);
    near(v[METRIC_SHARE], 1, 0);
    free(p);
}

// Against the same with the pictures exchanged: relMSE alone looks at which is the reference.
static void test_reference(void **state) {
    (void)state;
    struct pair *p = pair_new(0.5f, 0.75f);
    measure(p);
    near(p->result.value[METRIC_RELMSE], 0.0625 / (0.5625 + 0.01), 1e-12);
    free(p);
}

static void test_one_pixel(void **state) {
    (void)state;
    struct pair *p = pair_new(0.5f, 0.5f);
    p->a[3 * (7 * WIDTH + 5) + 1] = 0.625f;
    p->a[3 * (9 * WIDTH + 2) + 2] = 0.5f - 1.0f / 512;
    measure(p);
    const struct measure_place *at = &p->result.largest;
    assert_int_equal(at->x, 5);
    assert_int_equal(at->y, 7);
    assert_int_equal(at->channel, 1);
    near(at->value, 0.625, 0);
    near(at->reference, 0.5, 0);
    near(p->result.value[METRIC_LARGEST], 0.125, 0);
    near(p->result.value[METRIC_MAE], (0.125 + 1.0 / 512) / (3 * PIXELS), 1e-15);
    // The second pixel stays below 1/255.
    assert_int_equal(p->result.over, 1);
    near(p->result.value[METRIC_SHARE], 1.0 / PIXELS, 1e-15);
    near((double)p->difference[7 * WIDTH + 5], 0.125, 0);
    near((double)p->difference[0], 0, 0);
    p->options.threshold = 1e-3;
    measure(p);
    assert_int_equal(p->result.over, 2);
    free(p);
}

// Levels of bytes: one apart is at the threshold and not over it, two apart is over it, whatever the levels.
static void test_levels(void **state) {
    (void)state;
    for (int apart = 1; apart <= 2; apart++)
        for (int level = 0; level + apart <= 255; level++) {
            struct pair *p = pair_new((float)(level / 255.0), (float)((level + apart) / 255.0));
            measure(p);
            assert_int_equal(p->result.over, apart == 1 ? 0 : PIXELS);
            free(p);
        }
}

// The distance of black and white: |dL*| = 100 to the power 0.7, redistributed; the largest distance of the
// space is 41.2761 (green and blue, to the power 0.7).
static void test_flip_black_white(void **state) {
    (void)state;
    struct pair *p = pair_new(1, 0);
    measure(p);
    const double most = 41.276098, knee = 0.4 * most, error = pow(100, 0.7);
    near(p->result.value[METRIC_FLIP], 0.95 + (error - knee) / (most - knee) * 0.05, 1e-5);
    near(p->result.value[METRIC_FLIP], 0.96738, 1e-5);
    // Two greys far below the knee: L* of sRGB 0.5 and 0.51 are 53.3890 and 54.3874.
    fill(p->a, 0.5f, 0.5f, 0.5f);
    fill(p->b, 0.51f, 0.51f, 0.51f);
    measure(p);
    near(p->result.value[METRIC_FLIP], pow(54.3874 - 53.3890, 0.7) * 0.95 / knee, 2e-4);
    // Green and blue: the largest there is.
    fill(p->a, 0, 1, 0);
    fill(p->b, 0, 0, 1);
    measure(p);
    near(p->result.value[METRIC_FLIP], 1, 1e-5);
    free(p);
}

// A pattern without symmetry. The expected values were computed by a program of its own, with filters in two
// dimensions, straight from the two papers.
static void pattern(struct pair *p) {
    uint32_t seed = 1;
    for (size_t y = 0; y < HEIGHT; y++)
        for (size_t x = 0; x < WIDTH; x++)
            for (size_t c = 0; c < 3; c++) {
                const size_t at = 3 * (y * WIDTH + x) + c;
                seed = seed * 1664525u + 1013904223u;
                const float noise = (float)(seed >> 16) / 65536.0f;
                p->b[at] = (float)((x * 7 + y * 13 + c * 29) % 64) / 64.0f;
                p->a[at] = x > 8 ? 0.75f * p->b[at] + 0.25f * noise : p->b[at];
            }
}

static void test_pattern(void **state) {
    (void)state;
    struct pair *p = pair_new(0, 0);
    pattern(p);
    p->options.pixels_per_degree = 20;
    measure(p);
    near(p->result.value[METRIC_SSIM], 0.922284036, 1e-6);
    near(p->result.value[METRIC_FLIP], 0.274078801, 1e-6);
    near(p->result.value[METRIC_MAE], 0.052436439, 1e-9);
    near(p->result.value[METRIC_PSNR], 21.851000007, 1e-6);
    double sum = 0;
    for (size_t i = 0; i < PIXELS; i++)
        sum += (double)p->flip[i];
    near(sum / PIXELS, p->result.value[METRIC_FLIP], 1e-9);
    free(p);
}

static void test_not_finite(void **state) {
    (void)state;
    struct pair *p = pair_new(0.5f, 0.25f);
    p->a[0] = NAN;
    p->a[3] = -INFINITY;
    p->b[3] = INFINITY;
    p->b[9] = INFINITY;
    measure(p);
    assert_int_equal(p->result.not_finite[0], 2);
    assert_int_equal(p->result.not_finite[1], 2);
    assert_int_equal(p->result.not_finite_together, 3);
    near(p->result.value[METRIC_MAE], 0.25, 1e-12);
    assert_true(isinf(p->difference[0]));
    assert_true(isfinite(p->result.value[METRIC_SSIM]) && isfinite(p->result.value[METRIC_FLIP]));
    fill(p->a, NAN, NAN, NAN);
    measure(p);
    assert_true(isnan(p->result.value[METRIC_MAE]) && isnan(p->result.value[METRIC_PSNR]));
    free(p);
}

// Linear values are clamped and encoded for SSIM and FLIP, and for nothing else.
static void test_spaces(void **state) {
    (void)state;
    struct pair *p = pair_new(4, 2);
    p->options.space = MEASURE_LINEAR;
    measure(p);
    near(p->result.value[METRIC_MAE], 2, 0);
    near(p->result.value[METRIC_FLIP], 0, 0);
    float linear[6] = {0.5f, -1, 2, NAN, 0.0031308f, 8}, shown[6];
    image_to_displayed(linear, 2, (struct image_display){.tone = IR_TONE_CLIP, .transfer = IR_TRANSFER_SRGB},
                       shown);
    near((double)shown[0], 0.735357, 1e-6);
    near((double)shown[1], 0, 0);
    near((double)shown[2], 1, 0);
    near((double)shown[3], 0, 0);
    near((double)shown[4], 12.92 * 0.0031308, 1e-6);
    image_to_displayed(
        linear, 2, (struct image_display){.tone = IR_TONE_NORMALIZE, .transfer = IR_TRANSFER_NONE}, shown);
    near((double)shown[0], 0.25, 0);
    near((double)shown[2], 1, 0);
    free(p);
}

// Displayed values, rounded, are the bytes of the picture.
static void test_display_rounds_to_bytes(void **state) {
    (void)state;
    float linear[3 * 64], shown[3 * 64];
    uint8_t bytes[3 * 64];
    for (size_t i = 0; i < 3 * 64; i++)
        linear[i] = (float)i / 160;
    for (unsigned tone = 0; tone < 2; tone++)
        for (unsigned transfer = 0; transfer < 2; transfer++) {
            const struct image_display display = {.tone = tone, .transfer = transfer};
            struct image image = {.width = 64, .height = 1, .rgb = linear};
            image_to_bytes(&image, display, bytes);
            image_to_displayed(linear, 64, display, shown);
            for (size_t i = 0; i < 3 * 64; i++)
                assert_true(fabs(255 * (double)shown[i] - bytes[i]) <= 0.5 + 1e-4);
        }
}

static void test_metric_subset(void **state) {
    (void)state;
    struct pair *p = pair_new(0.5f, 0.25f);
    p->options.metrics = 1u << METRIC_MAE;
    assert_true(measure_pictures(WIDTH, HEIGHT, p->a, p->b, &p->options, &p->result, NULL, NULL));
    near(p->result.value[METRIC_MAE], 0.25, 1e-12);
    assert_true(isnan(p->result.value[METRIC_SSIM]) && isnan(p->result.value[METRIC_FLIP]));
    assert_int_equal(metric_find(STR("flip")), METRIC_FLIP);
    assert_int_equal(metric_find(STR("fli")), METRIC_COUNT);
    free(p);
}

static void test_small_picture(void **state) {
    (void)state;
    const float a[3] = {1, 1, 1}, b[3] = {0, 0, 0};
    struct measure_options options = measure_options_default();
    struct measure_result result;
    assert_true(measure_pictures(1, 1, a, b, &options, &result, NULL, NULL));
    near(result.value[METRIC_SSIM], 1e-4 / (1 + 1e-4), 1e-6);
    near(result.value[METRIC_FLIP], 0.96738, 1e-5);
}

// ---- files

static void decode(str bytes, struct picture_file *out) {
    bool unknown;
    const char *fault = picture_file_decode(bytes, 1 << 22, out, &unknown);
    if (fault)
        fail_msg("%s", fault);
}

static void test_pfm(void **state) {
    (void)state;
    struct picture_file p;
    // Big endian, grey, 1 x 2: rows come from the bottom.
    decode(STR("Pf\n1 2\n1.0\n\x3f\x80\0\0\x40\0\0\0"), &p);
    assert_int_equal(p.width, 1);
    assert_int_equal(p.height, 2);
    assert_int_equal(p.space, MEASURE_LINEAR);
    near((double)p.rgb[0], 2, 0);
    near((double)p.rgb[3], 1, 0);
    near((double)p.rgb[5], 1, 0);
    picture_file_finish(&p);
    struct strbuf file;
    float rgb[3 * 6];
    for (size_t i = 0; i < 18; i++)
        rgb[i] = (float)i * 0.5f - 1;
    rgb[4] = NAN;
    struct image image = {.width = 3, .height = 2, .rgb = rgb};
    strbuf_init(&file);
    image_encode(&image, IMAGE_PFM, (struct image_display){0}, &file);
    decode(strbuf_view(&file), &p);
    assert_memory_equal(p.rgb, rgb, sizeof rgb);
    assert_string_equal(p.kind, "PFM");
    picture_file_finish(&p);
    strbuf_finish(&file);
}

static void test_png_and_hdr(void **state) {
    (void)state;
    struct picture_file p;
    float rgb[6] = {0, 0.5f, 1, 0.25f, 0.125f, 2};
    struct image image = {.width = 2, .height = 1, .rgb = rgb};
    struct strbuf file;
    strbuf_init(&file);
    image_encode(&image, IMAGE_PNG, (struct image_display){0}, &file);
    decode(strbuf_view(&file), &p);
    assert_int_equal(p.space, MEASURE_DISPLAYED);
    near((double)p.rgb[1], 128.0 / 255, 1e-7);
    near((double)p.rgb[5], 1, 0);
    picture_file_finish(&p);
    strbuf_clear(&file);
    image_encode(&image, IMAGE_HDR, (struct image_display){0}, &file);
    decode(strbuf_view(&file), &p);
    assert_int_equal(p.space, MEASURE_LINEAR);
    near((double)p.rgb[5], 2, 0.01);
    picture_file_finish(&p);
    strbuf_finish(&file);
}

static void test_bad_files(void **state) {
    (void)state;
    const struct {
        str bytes;
        const char *fault;
        bool unknown;
    } cases[] = {
        {STR(""), "it is not a PNG", true},
        {STR("hello"), "it is not a PNG", true},
        {STR("PF"), "width or height", false},
        {STR("PF\n0 1\n-1\n"), "width or height", false},
        {STR("PF\n1 -1\n-1\n"), "width or height", false},
        {STR("PF\n1 1\n0\n0000"), "scale", false},
        {STR("PF\n1 1\nnan\n0000"), "scale", false},
        {STR("PF\n1 1\n-1\n00001111222"), "ends before", false},
        {STR("Pf\n2 1\n-1\n0000"), "ends before", false},
        {STR("PF\n1000 2\n-1\n"), "image-memory", false},
        {STR("\x89PNG\r\n\x1A\n"), "first chunk", false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct picture_file p;
        bool unknown;
        const char *fault = picture_file_decode(cases[i].bytes, 1000, &p, &unknown);
        if (!fault || !strstr(fault, cases[i].fault) || unknown != cases[i].unknown)
            fail_msg("case %zu: %s", i, fault ? fault : "taken");
        picture_file_finish(&p);
    }
    picture_file_finish(NULL);
}

// ---- bounds and reports

static void test_bounds(void **state) {
    (void)state;
    struct pair *p = pair_new(0.5f, 0.25f);
    struct measure_bounds bounds = {0};
    struct compare_report report = {.path = {"a\"b", "c"},
                                    .kind = {"PFM", "PFM"},
                                    .width = WIDTH,
                                    .height = HEIGHT,
                                    .options = &p->options,
                                    .result = &p->result,
                                    .bounds = &bounds};
    p->a[0] = NAN;
    measure(p);
    assert_true(compare_keeps_bounds(&report));
    bounds.has[METRIC_MAE] = true;
    bounds.bound[METRIC_MAE] = 0.3;
    assert_false(compare_keeps_bounds(&report)); // the pixel that is no number
    bounds.not_finite = 1;
    assert_true(compare_keeps_bounds(&report));
    bounds.bound[METRIC_MAE] = 0.2;
    assert_false(measure_keeps(&bounds, &p->result, METRIC_MAE));
    assert_false(compare_keeps_bounds(&report));
    bounds.bound[METRIC_MAE] = 0.25;
    bounds.has[METRIC_PSNR] = true;
    bounds.bound[METRIC_PSNR] = 12;
    assert_true(compare_keeps_bounds(&report)); // 12.04 dB
    bounds.bound[METRIC_PSNR] = 12.1;
    assert_false(compare_keeps_bounds(&report));
    fill(p->a, NAN, NAN, NAN);
    measure(p);
    assert_false(measure_keeps(&bounds, &p->result, METRIC_MAE));
    struct strbuf text;
    strbuf_init(&text);
    compare_json(&report, &text);
    assert_non_null(strstr(text.data, "\"a\\\"b\""));
    assert_non_null(strstr(text.data, "\"mae\": {\"value\": null"));
    assert_non_null(strstr(text.data, "\"bounds_kept\": false"));
    strbuf_finish(&text);
    free(p);
}

static double oklab_lightness(const uint8_t rgb[3]) {
    double c[3];
    for (int i = 0; i < 3; i++) {
        const double d = rgb[i] / 255.0;
        c[i] = d <= 0.04045 ? d / 12.92 : pow((d + 0.055) / 1.055, 2.4);
    }
    const double l = cbrt(0.4122214708 * c[0] + 0.5363325363 * c[1] + 0.0514459929 * c[2]);
    const double m = cbrt(0.2119034982 * c[0] + 0.6806995451 * c[1] + 0.1073969566 * c[2]);
    const double s = cbrt(0.0883024619 * c[0] + 0.2817188376 * c[1] + 0.6299787005 * c[2]);
    return 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
}

// Lightness rises evenly: no part of the map leaves what sRGB can show.
static void test_heatmap(void **state) {
    (void)state;
    uint8_t rgb[3];
    for (int i = 4; i <= 64; i++) {
        heatmap_color(i / 64.0, rgb);
        near(oklab_lightness(rgb), 0.97 * i / 64.0, 0.012);
    }
    heatmap_color(-1, rgb);
    assert_true(rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0);
    heatmap_color((double)NAN, rgb);
    assert_true(rgb[0] == 0 && rgb[1] == 255 && rgb[2] == 255);
    const float values[4] = {0, 0.001f, 1, INFINITY};
    struct strbuf png;
    struct picture_file p;
    strbuf_init(&png);
    heatmap_png(2, 2, values, HEATMAP_LOGARITHMIC, &png);
    assert_false(png.failed);
    decode(strbuf_view(&png), &p);
    assert_true(p.rgb[0] == 0 && p.rgb[3] == 0 && p.rgb[6] > 0.9f && p.rgb[9] == p.rgb[6]);
    picture_file_finish(&p);
    strbuf_finish(&png);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equal),         cmocka_unit_test(test_constant),
        cmocka_unit_test(test_reference),     cmocka_unit_test(test_one_pixel),
        cmocka_unit_test(test_levels),        cmocka_unit_test(test_flip_black_white),
        cmocka_unit_test(test_pattern),       cmocka_unit_test(test_not_finite),
        cmocka_unit_test(test_spaces),        cmocka_unit_test(test_display_rounds_to_bytes),
        cmocka_unit_test(test_metric_subset), cmocka_unit_test(test_small_picture),
        cmocka_unit_test(test_pfm),           cmocka_unit_test(test_png_and_hdr),
        cmocka_unit_test(test_bad_files),     cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_heatmap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
