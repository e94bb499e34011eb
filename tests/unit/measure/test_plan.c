// What a study plans to try, in which order times must be, and what to paste of a setting.
#include "measure/tradeoff/plan/plan.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static struct plan_input input_of(void) {
    return (struct plan_input){.base = {.width = 64,
                                        .height = 48,
                                        .samples = 1,
                                        .max_depth = 16,
                                        .min_weight = 0.0009765625,
                                        .shadows = true},
                               .bounces = true,
                               .deepest = 6,
                               .knows_double = true,
                               .has_triangles = true,
                               .most_samples = 8};
}

static uint32_t count_of(const struct row *rows, uint32_t count, enum knob knob) {
    uint32_t found = 0;
    for (uint32_t i = 0; i < count; i++)
        found += rows[i].knobs == 1u << knob;
    return found;
}

static void test_plan_single(void **state) {
    (void)state;
    struct row *rows = calloc(PLAN_ROWS_MAX, sizeof *rows);
    struct plan_input input = input_of();
    uint32_t count = plan_single(&input, rows);
    assert_string_equal(rows[0].name, "as the file says");
    assert_int_equal(rows[0].knobs, 0);
    // 0 1 2 3 4: at 6 nothing is cut any more.
    assert_int_equal(count_of(rows, count, KNOB_MAX_DEPTH), 5);
    assert_string_equal(rows[1].name, "max_depth 0");
    assert_int_equal(count_of(rows, count, KNOB_MIN_WEIGHT), 7);
    assert_int_equal(count_of(rows, count, KNOB_SAMPLES), 3);
    assert_int_equal(count_of(rows, count, KNOB_PRECISION), 1);
    assert_int_equal(count_of(rows, count, KNOB_SHADOWS), 1);
    assert_int_equal(count_of(rows, count, KNOB_RESOLUTION), 3);
    assert_int_equal(count_of(rows, count, KNOB_FEATURES), 1);
    assert_int_equal(count_of(rows, count, KNOB_ALTERNATIVE), RENDER_ALTERNATIVES - 1);
    for (uint32_t i = 0; i < count; i++)
        assert_int_equal(rows[i].choosable,
                         !(rows[i].knobs & (1u << KNOB_FEATURES | 1u << KNOB_ALTERNATIVE)));
    assert_int_equal(count_of(rows, count, KNOB_ERROR), 5);
    for (uint32_t i = 0; i < count; i++)
        assert_true(rows[i].knobs != 1u << KNOB_ERROR || setting_ends_pixels(&rows[i].setting));
    // The file's own limit is what ends paths: deeper ones are tried too.
    input.base.max_depth = input.deepest = 4;
    count = plan_single(&input, rows);
    assert_int_equal(count_of(rows, count, KNOB_MAX_DEPTH), 6); // 0 1 2 3, 6 8
    input.base.max_depth = input.deepest = 0;
    count = plan_single(&input, rows);
    assert_int_equal(count_of(rows, count, KNOB_MAX_DEPTH), 1);
    assert_string_equal(rows[1].name, "max_depth 1");
    input.bounces = false;
    input.knows_double = false;
    input.base.shadows = false;
    count = plan_single(&input, rows);
    uint32_t choosable = 0;
    for (uint32_t i = 0; i < count; i++)
        choosable += rows[i].choosable;
    assert_int_equal(choosable, 1 + 3 + 5 + 3);
    free(rows);
}

static const struct row *row_called(const struct row *rows, uint32_t count, const char *name) {
    for (uint32_t i = 0; i < count; i++)
        if (strcmp(rows[i].name, name) == 0)
            return &rows[i];
    fail_msg("no row is called '%s'", name);
    return NULL;
}

// Pixels that end by their error, from a file that has none and from one that has.
static void test_plan_errors(void **state) {
    (void)state;
    struct row *rows = calloc(PLAN_ROWS_MAX, sizeof *rows);
    struct plan_input input = input_of();
    input.most_samples = 32;
    uint32_t count = plan_single(&input, rows);
    const struct row *row = row_called(rows, count, "error 0.02 by 8 to 32 samples");
    assert_true(row->choosable && row->setting.samples == 32 && row->setting.min_samples == 8);
    // Too few samples for any pixel to end.
    input.most_samples = 4;
    count = plan_single(&input, rows);
    assert_int_equal(count_of(rows, count, KNOB_ERROR), 0);
    input.most_samples = 32;
    input.base.samples = 256;
    input.base.min_samples = 16;
    input.base.error = 0.02;
    count = plan_single(&input, rows);
    row_called(rows, count, "error 0.01 by 16 to 256 samples");
    row = row_called(rows, count, "error off, samples 8");
    assert_false(setting_ends_pixels(&row->setting));
    // Four of the ladder, and six of samples: how many there are is no knob beside it.
    assert_int_equal(count_of(rows, count, KNOB_ERROR), 4 + 6);
    assert_int_equal(count_of(rows, count, KNOB_SAMPLES), 0);
    free(rows);
}

// Of what can be left out only what the scene has, and only what one setting says is chosen.
static void test_plan_parts(void **state) {
    (void)state;
    struct row *rows = calloc(PLAN_ROWS_MAX, sizeof *rows), *pairs = calloc(PLAN_ROWS_MAX, sizeof *pairs);
    struct plan_input input = input_of();
    uint32_t left_out, count = plan_single(&input, rows), with;
    input.parts = KNOBS_WITHOUT;
    with = plan_single(&input, rows);
    assert_int_equal(with, count + 6);
    assert_true(row_called(rows, with, "transparent_shadows off")->choosable);
    assert_true(row_called(rows, with, "occlusion off")->choosable);
    for (const char *const *name =
             (const char *const[]){"lights without extent", "pinhole", "no roughness", "no filter", NULL};
         *name; name++)
        assert_false(row_called(rows, with, *name)->choosable);
    input.parts = 1u << KNOB_OCCLUSION;
    count = plan_single(&input, rows);
    assert_int_equal(count, with - 5);
    for (uint32_t i = 0; i < count; i++) {
        const bool samples = rows[i].knobs == 1u << KNOB_SAMPLES && rows[i].setting.samples == 4;
        const bool error = rows[i].knobs == 1u << KNOB_ERROR && rows[i].setting.error > 0.05;
        rows[i].work.cost = samples ? 4e6 : error ? 6e6 : rows[i].setting.without ? 5e5 : 1e6;
        rows[i].value[METRIC_MAE] = samples ? 0.003 : error ? 0.002 : rows[i].setting.without ? 0.02 : 0.01;
    }
    // Each of the two with occlusion; samples and the error of samples are no pair.
    assert_int_equal(plan_pairs(rows, count, METRIC_MAE, 10, pairs, &left_out), 2);
    row_called(pairs, 2, "samples 4, occlusion off");
    const struct row *both = row_called(pairs, 2, "error 0.1 by 4 to 8 samples, occlusion off");
    assert_true(both->setting.samples == 8 && both->setting.min_samples == 4 && both->choosable);
    free(rows);
    free(pairs);
}

static void test_plan_pairs(void **state) {
    (void)state;
    struct row *rows = calloc(PLAN_ROWS_MAX, sizeof *rows), *pairs = calloc(PLAN_ROWS_MAX, sizeof *pairs);
    struct plan_input input = input_of();
    uint32_t left_out, count = plan_single(&input, rows);
    for (uint32_t i = 0; i < count; i++) {
        rows[i].work.cost = 1e6;
        rows[i].value[METRIC_MAE] = 0.01;
    }
    // Nothing mattered.
    assert_int_equal(plan_pairs(rows, count, METRIC_MAE, 10, pairs, &left_out), 0);
    assert_int_equal(left_out, 0);
    for (uint32_t i = 0; i < count; i++) {
        if (rows[i].setting.max_depth == 2) { // cheaper, worse
            rows[i].work.cost = 5e5;
            rows[i].value[METRIC_MAE] = 0.02;
        }
        if (rows[i].knobs == 1u << KNOB_SAMPLES && rows[i].setting.samples == 4) { // dearer, better
            rows[i].work.cost = 4e6;
            rows[i].value[METRIC_MAE] = 0.003;
        }
        if (rows[i].knobs == 1u << KNOB_SAMPLES &&
            rows[i].setting.samples == 8) { // dearer still, and no better: not worth a pair
            rows[i].work.cost = 8e6;
            rows[i].value[METRIC_MAE] = 0.003;
        }
        if (rows[i].knobs == 1u << KNOB_ALTERNATIVE)
            rows[i].work.cost = 1; // never part of a pair
    }
    assert_int_equal(plan_pairs(rows, count, METRIC_MAE, 10, pairs, &left_out), 1);
    assert_int_equal(pairs[0].setting.max_depth, 2);
    assert_int_equal(pairs[0].setting.samples, 4);
    assert_string_equal(pairs[0].name, "max_depth 2, samples 4");
    assert_true(pairs[0].choosable);
    assert_int_equal(plan_pairs(rows, count, METRIC_MAE, 0, pairs, &left_out), 0);
    assert_int_equal(left_out, 1);
    free(rows);
    free(pairs);
}

// ---- the ground truth

enum {
    GROUND_TRUTH_PIXELS = 64000,
    GROUND_TRUTH_PILOT = 2000,
    GROUND_TRUTH_LIMIT = 16384,
    LIGHT_RAYS = 2, // of most pixels
};

// A scene in which one pixel of `heavy` asks for as many rays as there may be; 0: none does.
static double rays_of(uint64_t segments, uint32_t heavy) {
    const double share = heavy ? 1.0 / heavy : 0;
    return LIGHT_RAYS + share * (double)(segments - LIGHT_RAYS);
}

// The plan for a budget of rays, by pilots of that scene; *spent: rays of the pilots.
static struct plan_ground_truth planned(uint32_t samples, double rays_most, uint32_t heavy, double *spent) {
    struct plan_pilot pilots[PLAN_PILOTS_MAX];
    struct plan_ground_truth_input in = {.file_samples = samples,
                                         .pixels = GROUND_TRUTH_PIXELS,
                                         .pilot_pixels = GROUND_TRUTH_PILOT,
                                         .rays_most = rays_most,
                                         .segments_most = GROUND_TRUTH_LIMIT,
                                         .pilots = pilots};
    *spent = 0;
    for (uint64_t segments; (segments = plan_next_pilot(&in)) > 0;) {
        assert_true(in.pilot_count < PLAN_PILOTS_MAX && segments <= GROUND_TRUTH_LIMIT);
        pilots[in.pilot_count++] = (struct plan_pilot){segments, rays_of(segments, heavy), heavy > 0};
        *spent += GROUND_TRUTH_PILOT * rays_of(segments, heavy);
    }
    return plan_ground_truth(&in);
}

static void test_plan_ground_truth(void **state) {
    (void)state;
    double spent;
    // No budget: everything, and nothing is counted before.
    struct plan_ground_truth p = planned(2, INFINITY, 20, &spent);
    assert_true(p.samples == 16 && p.segments == GROUND_TRUTH_LIMIT && p.fits && spent == 0.0);
    assert_int_equal(planned(32, INFINITY, 20, &spent).samples, 64);
    assert_int_equal(planned(100, INFINITY, 20, &spent).samples, 200);
    // Light paths only: samples by what they take, and room for heavier pixels than the pilot met.
    p = planned(2, 2.1 * 8 * GROUND_TRUTH_PIXELS, 0, &spent);
    assert_true(p.samples == 8 && p.fits && p.segments > 50 && p.segments < 100);
    // One pixel of twenty asks for all: what is planned stays within the bound, whatever that is, and the
    // counting is a small part of it.
    for (double most = 2.1e6; most < 1e11; most *= 1.7) {
        p = planned(2, most, 20, &spent);
        assert_true(p.fits && p.samples >= 4);
        assert_true((double)p.samples * GROUND_TRUTH_PIXELS * rays_of(p.segments, 20) <= most);
        assert_true(spent <= 0.1 * most);
    }
    assert_true(p.samples == 16 && p.segments == GROUND_TRUTH_LIMIT);
    // Not even the least fits: twice the file's samples where that is not far off, else the file's.
    p = planned(2, 5e5, 20, &spent);
    assert_true(!p.fits && p.samples == 4 && p.segments == PLAN_PILOT_SEGMENTS);
    p = planned(2, 5e4, 20, &spent);
    assert_true(!p.fits && p.samples == 2 && p.segments == PLAN_PILOT_SEGMENTS);
}

static void test_ordered_times(void **state) {
    (void)state;
    struct row *rows = calloc(7, sizeof *rows);
    for (int i = 0; i < 7; i++)
        rows[i].setting = input_of().base;
    const double times[] = {10, 8, 9, 5, 0.5, 30, 1};
    rows[1].setting.max_depth = 20; // more rays than row 0, and measured faster
    rows[2].setting.samples = 2;    // more than row 0, neither more nor fewer than row 1
    rows[3].setting.is_double = true;
    rows[4].setting.without = 1u << KNOB_OCCLUSION; // fewer rays than row 0
    rows[5].setting.without = 1u << KNOB_LENS;      // others
    rows[6].setting.error = 0.01;                   // which of them nobody knows
    for (int i = 0; i < 7; i++)
        rows[i].time_ms = times[i];
    assert_true(plan_order_times(rows, 7));
    assert_true(rows[0].time_ms <= rows[1].time_ms && rows[0].time_ms <= rows[2].time_ms);
    assert_true(fabs(rows[1].time_ms - 9) < 1e-12);
    assert_true(fabs(rows[2].time_ms - 9.5) < 1e-12);
    assert_true(fabs(rows[3].time_ms - 5) < 1e-12); // another kernel: not to be compared
    assert_true(fabs(rows[5].time_ms - 30) < 1e-12 && fabs(rows[6].time_ms - 1) < 1e-12);
    rows[0].time_ms = 1;
    assert_true(plan_order_times(rows, 7)); // in order: nothing moves
    assert_true(fabs(rows[0].time_ms - 1) < 1e-12 && fabs(rows[1].time_ms - 9) < 1e-12);
    rows[4].time_ms = 7;
    assert_true(plan_order_times(rows, 7));
    assert_true(rows[4].time_ms > 1 && rows[4].time_ms <= rows[0].time_ms);
    free(rows);
}

static void test_setting_text(void **state) {
    (void)state;
    const struct setting base = input_of().base;
    struct setting s = base;
    struct strbuf text;
    char assignment[80];
    strbuf_init(&text);
    setting_options(&s, &base, &text);
    assert_int_equal(text.len, 0);
    s.samples = 4;
    s.max_depth = 3;
    s.min_weight = 0.01;
    s.is_double = true;
    setting_options(&s, &base, &text);
    assert_string_equal(text.data,
                        "--set image.samples=4 --set trace.max_depth=3 --set trace.min_weight=0.01 "
                        "--set trace.precision=double");
    strbuf_clear(&text);
    setting_yaml(&s, &base, &text);
    assert_string_equal(text.data,
                        "image: {samples: 4}\ntrace: {max_depth: 3, min_weight: 0.01, precision: double}\n");
    strbuf_clear(&text);
    setting_xml(&s, &base, &text);
    assert_string_equal(
        text.data,
        "<Image samples=\"4\"/>\n<Trace max_depth=\"3\" min_weight=\"0.01\" precision=\"double\"/>\n");
    assert_true(setting_assignment(&s, &base, 1, assignment, sizeof assignment));
    assert_string_equal(assignment, "trace.max_depth=3");
    assert_false(setting_assignment(&s, &base, 4, assignment, sizeof assignment));
    s = base;
    s.samples = 32;
    s.error = 0.02;
    s.min_samples = 8;
    s.without = 1u << KNOB_CLEAR_SHADOWS | 1u << KNOB_OCCLUSION;
    strbuf_clear(&text);
    setting_yaml(&s, &base, &text);
    assert_string_equal(text.data, "image: {samples: 32, error: 0.02, min_samples: 8}\n"
                                   "trace: {transparent_shadows: false}\nambient: {occlusion: 0}\n");
    // What says how many samples there are ends no pixel.
    struct setting with_error = base;
    with_error.error = 0.01;
    with_error.min_samples = 16;
    s = with_error;
    s.error = 0;
    s.samples = 4;
    strbuf_clear(&text);
    setting_options(&s, &with_error, &text);
    assert_string_equal(text.data, "--set image.samples=4 --set image.error=0");
    strbuf_finish(&text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plan_single),       cmocka_unit_test(test_plan_errors),
        cmocka_unit_test(test_plan_parts),        cmocka_unit_test(test_plan_pairs),
        cmocka_unit_test(test_plan_ground_truth), cmocka_unit_test(test_ordered_times),
        cmocka_unit_test(test_setting_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
