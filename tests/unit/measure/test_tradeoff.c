// Choosing from tables made up for it, planning, what to paste, and first hits counted by hand.
#include "measure/tradeoff/choose/choose.h"
#include "measure/tradeoff/measure/measure.h"
#include "measure/tradeoff/plan/plan.h"
#include "picture/write/scale.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static struct choice_row row(double time, double noise, double work, double error) {
    return (struct choice_row){
        .time_ms = time, .noise_ms = noise, .work = work, .error = error, .choosable = true};
}

// ---- classes, ranks, front

static void test_clear_times(void **state) {
    (void)state;
    struct choice_row rows[] = {row(40, 0.1, 4, 0.01), row(10, 0.1, 1, 0.3), row(20, 0.1, 2, 0.05),
                                row(30, 0.1, 3, 0.06)};
    const double noise = choice_classify(rows, 4);
    assert_true(noise >= CHOICE_NOISE_FLOOR && noise < 0.05);
    assert_int_equal(rows[1].rank, 0);
    assert_int_equal(rows[2].rank, 1);
    assert_int_equal(rows[3].rank, 2);
    assert_int_equal(rows[0].rank, 3);
    assert_int_equal(rows[3].time_class, 2);
    assert_true(rows[1].on_front && rows[2].on_front && rows[0].on_front);
    assert_false(rows[3].on_front); // slower than row 2, and worse
}

// Times within the noise: work decides, whichever was measured faster.
static void test_noise_class(void **state) {
    (void)state;
    for (int turn = 0; turn < 2; turn++) {
        struct choice_row rows[] = {row(turn ? 10.1 : 9.9, 0.1, 5, 0.1), row(turn ? 9.9 : 10.1, 0.1, 4, 0.1),
                                    row(20, 0.2, 9, 0.05)};
        const double noise = choice_classify(rows, 3);
        assert_int_equal(rows[0].time_class, rows[1].time_class);
        assert_int_not_equal(rows[0].time_class, rows[2].time_class);
        assert_int_equal(rows[1].rank, 0);
        assert_true(rows[1].on_front && !rows[0].on_front);
        assert_int_equal(choice_cheapest(rows, 3, noise, 0.2).row, 1);
    }
}

// The floor holds where nothing varied at all; equal work falls to the smaller error, then to the order.
static void test_ties(void **state) {
    (void)state;
    struct choice_row rows[] = {row(100, 0, 5, 0.2), row(102, 0, 5, 0.1), row(101, 0, 5, 0.1)};
    choice_classify(rows, 3);
    assert_int_equal(rows[1].rank, 0);
    assert_int_equal(rows[2].rank, 1);
    assert_int_equal(rows[0].rank, 2);
    assert_true(rows[1].on_front && !rows[2].on_front && !rows[0].on_front);
}

// One row that varied much does not join a class that it is far from.
static void test_pooled_noise(void **state) {
    (void)state;
    struct choice_row rows[] = {row(10, 0.01, 1, 0.3), row(20, 10, 2, 0.2), row(40, 0.01, 4, 0.1)};
    const double noise = choice_classify(rows, 3);
    assert_true(noise < 0.05);
    assert_int_equal(rows[0].time_class, 0);
    assert_int_equal(rows[1].time_class, 1);
    assert_int_equal(rows[2].time_class, 2);
}

static void test_alternatives_take_no_part(void **state) {
    (void)state;
    struct choice_row rows[] = {row(1, 0, 1, 0.001), row(10, 0, 2, 0.1)};
    rows[0].choosable = false;
    const double noise = choice_classify(rows, 2);
    assert_int_equal(rows[0].rank, CHOICE_NONE);
    assert_false(rows[0].on_front);
    assert_int_equal(rows[1].rank, 0);
    assert_int_equal(choice_cheapest(rows, 2, noise, 1).row, 1);
    assert_int_equal(choice_best_within(rows, 2, noise, 100).row, 1);
    rows[1].choosable = false;
    assert_int_equal(choice_cheapest(rows, 2, noise, 1).row, CHOICE_NONE);
    assert_int_equal(choice_cheapest(rows, 2, noise, 1).nearest, CHOICE_NONE);
    assert_int_equal(choice_classify(rows, 0) >= CHOICE_NOISE_FLOOR, true);
}

// ---- the answers

// Error falls with time, but for the third.
static double four_rows(struct choice_row rows[4]) {
    rows[0] = row(10, 0.01, 1, 0.3);
    rows[1] = row(20, 0.01, 2, 0.05);
    rows[2] = row(30, 0.01, 3, 0.06);
    rows[3] = row(40, 0.01, 4, 0.01);
    return choice_classify(rows, 4);
}

static void chooses(struct choice c, uint32_t wanted, uint32_t runner_up, bool runner_up_fits) {
    assert_int_equal(c.row, wanted);
    assert_int_equal(c.nearest, CHOICE_NONE);
    assert_int_equal(c.runner_up, runner_up);
    assert_int_equal(c.runner_up_fits, runner_up_fits);
}

static void misses(struct choice c, uint32_t nearest, double by, uint32_t runner_up) {
    assert_int_equal(c.row, CHOICE_NONE);
    assert_int_equal(c.nearest, nearest);
    assert_true(fabs(c.short_by - by) < 1e-12);
    assert_int_equal(c.runner_up, runner_up);
    assert_false(c.runner_up_fits);
}

static void test_cheapest(void **state) {
    (void)state;
    struct choice_row rows[4];
    const double noise = four_rows(rows);
    chooses(choice_cheapest(rows, 4, noise, 0.1), 1, 2, true);
    chooses(choice_cheapest(rows, 4, noise, 0.05), 1, 3, true); // exactly met
    // One fits: the runner-up comes nearest in error.
    chooses(choice_cheapest(rows, 4, noise, 0.02), 3, 1, false);
    misses(choice_cheapest(rows, 4, noise, 0.004), 3, 0.006, 1);
}

static void test_best_within(void **state) {
    (void)state;
    struct choice_row rows[4];
    const double noise = four_rows(rows);
    chooses(choice_best_within(rows, 4, noise, 35), 1, 2, true);
    chooses(choice_best_within(rows, 4, noise, 12), 0, 1, false);
    misses(choice_best_within(rows, 4, noise, 8), 0, 2, 1);
}

// The cheapest by its error is a little over the limit; one that cannot be told from it is not.
static void test_both_bounds(void **state) {
    (void)state;
    struct choice_row rows[] = {row(10.15, 0.01, 1, 0.1), row(10, 0.01, 2, 0.1), row(9.9, 0.01, 3, 0.1),
                                row(5, 0.01, 1, 0.3), row(10, 0.01, 1, (double)NAN)};
    const double noise = choice_classify(rows, 5);
    assert_int_equal(choice_cheapest(rows, 5, noise, 0.2).row, 0);
    chooses(choice_both(rows, 5, noise, 0.2, 10.1), 1, 2, true);
    chooses(choice_both(rows, 5, noise, 0.2, 9.95), 2, CHOICE_NONE, false);
    chooses(choice_both(rows, 5, noise, 0.2, 20), 0, 1, true);
    chooses(choice_both(rows, 5, noise, 0.2, 9), CHOICE_NONE, CHOICE_NONE, false);
    chooses(choice_both(rows, 5, noise, 0.05, 20), CHOICE_NONE, CHOICE_NONE, false);
}

static void test_not_a_number(void **state) {
    (void)state;
    struct choice_row rows[] = {row(10, 0, 1, (double)NAN), row(20, 0, 2, 0.1)};
    const double noise = choice_classify(rows, 2);
    assert_false(rows[0].on_front);
    assert_int_equal(choice_cheapest(rows, 2, noise, 1).row, 1);
    assert_int_equal(choice_best_within(rows, 2, noise, 100).row, 1);
    assert_int_equal(choice_best_within(rows, 2, noise, 100).runner_up, 0);
    assert_int_equal(choice_cheapest(rows, 2, noise, 0.01).nearest, 1);
}

// A thousand tables of the same ground truth under noise: the same choice each time.
static void test_same_choice_under_noise(void **state) {
    (void)state;
    uint64_t seed = 42;
    for (int run = 0; run < 1000; run++) {
        enum {
            ROWS = 24
        };
        struct choice_row rows[ROWS];
        for (int i = 0; i < ROWS; i++) {
            // Work rises by 3 % a row, so that neighbours cannot be told apart; error falls.
            const double work = pow(1.03, i);
            double sum = 0;
            for (int k = 0; k < 12; k++) {
                seed = seed * 6364136223846793005u + 1442695040888963407u;
                sum += (double)(seed >> 40) / (1 << 24) - 0.5;
            }
            rows[i] = row(10 * work * (1 + 0.02 * sum), 0.2 * work, work, 1 / work);
        }
        const double noise = choice_classify(rows, ROWS);
        assert_int_equal(choice_cheapest(rows, ROWS, noise, 1 / pow(1.03, 9.5)).row, 10);
    }
}

static void test_knee(void **state) {
    (void)state;
    struct choice_row rows[] = {row(10, 0, 10, 1), row(20, 0, 20, 0.05), row(40, 0, 40, 0.04),
                                row(80, 0, 80, 0.03)};
    choice_classify(rows, 4);
    assert_int_equal(choice_knee(rows, 4), 1);
    choice_classify(rows, 2);
    assert_int_equal(choice_knee(rows, 2), CHOICE_NONE);
    rows[1].error = 1e-4;
    rows[2].error = 5e-5;
    rows[3].error = 0; // has no logarithm
    choice_classify(rows, 4);
    assert_int_equal(choice_knee(rows, 4), 1);
}

// ---- plans

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
    assert_int_equal(choosable, 1 + 3 + 3);
    free(rows);
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
        if (rows[i].setting.samples == 4) { // dearer, better
            rows[i].work.cost = 4e6;
            rows[i].value[METRIC_MAE] = 0.003;
        }
        if (rows[i].setting.samples == 8) { // dearer still, and no better: not worth a pair
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
    struct row *rows = calloc(4, sizeof *rows);
    for (int i = 0; i < 4; i++)
        rows[i].setting = input_of().base;
    const double times[] = {10, 8, 9, 5};
    rows[1].setting.max_depth = 20; // more rays than row 0, and measured faster
    rows[2].setting.samples = 2;    // more than row 0, neither more nor fewer than row 1
    rows[3].setting.is_double = true;
    for (int i = 0; i < 4; i++)
        rows[i].time_ms = times[i];
    assert_true(plan_order_times(rows, 4));
    assert_true(rows[0].time_ms <= rows[1].time_ms && rows[0].time_ms <= rows[2].time_ms);
    assert_true(fabs(rows[1].time_ms - 9) < 1e-12);
    assert_true(fabs(rows[2].time_ms - 9.5) < 1e-12);
    assert_true(fabs(rows[3].time_ms - 5) < 1e-12); // another kernel: not to be compared
    rows[0].time_ms = 1;
    assert_true(plan_order_times(rows, 4)); // in order: nothing moves
    assert_true(fabs(rows[0].time_ms - 1) < 1e-12 && fabs(rows[1].time_ms - 9) < 1e-12);
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
    strbuf_finish(&text);
}

// ---- first hits

enum {
    SIDE = 10,
    HITS = SIDE * SIDE,
};

static void near(double value, double expected) {
    if (!(fabs(value - expected) <= 1e-6 * fabs(expected)))
        fail_msg("%.9g is not %.9g", value, expected);
}

static void test_hits(void **state) {
    (void)state;
    struct hit_pixel reference[HITS], device[HITS];
    struct scene_body bodies[2] = {{.closed = true}, {.closed = false}};
    const struct scene scene = {.bodies = bodies, .body_count = 2};
    struct hit_errors errors;
    const double one = 1e6 / HITS;
    for (size_t i = 0; i < HITS; i++) {
        const bool left = i % SIDE < 5;
        reference[i] = (struct hit_pixel){.body = left ? 0 : 1,
                                          .triangle = 7,
                                          .considered = 1,
                                          .lit = i / SIDE < 5,
                                          .reflected = HIT_NONE,
                                          .refracted = HIT_NONE,
                                          .distance = 3};
    }
    memcpy(device, reference, sizeof device);
    hits_compare(SIDE, SIDE, device, reference, &scene, &errors);
    assert_true(errors.known);
    near(errors.band, 20 * one); // the two columns at the border of the bodies
    assert_true(errors.wrong_inside + errors.wrong_outside + errors.acne + errors.leaks == 0);
    device[4].body = 1;                // in the band
    device[11].triangle = 8;           // elsewhere
    device[12].body = HIT_NONE;        // a hole, and wrong
    device[18].body = HIT_NONE;        // the same through an open body
    device[13].lit = 0;                // acne
    device[92].lit = 1;                // a leak
    device[52].lit = 1;                // at the shadow's edge
    device[22].reflected = 5;          // another second body
    device[81].considered = 0;         // not lit by anything: neither acne nor leak
    device[24].reflected = 5;          // in the band: silhouettes only
    reference[82].distance = 3 * 1.04; // a slope, no silhouette
    hits_compare(SIDE, SIDE, device, reference, &scene, &errors);
    near(errors.band, 20 * one);
    near(errors.wrong_inside, one);
    near(errors.wrong_outside, 3 * one);
    near(errors.holes, one);
    near(errors.acne, one);
    near(errors.leaks, one);
    near(errors.shadow_edge, one);
    near(errors.wrong_second, one);
    reference[82].distance = 4; // a step: the pixel and its eight neighbours
    hits_compare(SIDE, SIDE, device, reference, &scene, &errors);
    near(errors.band, 29 * one);
}

// The halves of a parallelogram are one face, the triangles of a mesh are not.
static void test_halves(void **state) {
    (void)state;
    static const enum scene_shape shapes[] = {SCENE_PARALLELOGRAM, SCENE_MESH};
    for (int i = 0; i < 2; i++) {
        struct hit_pixel reference[HITS], device[HITS];
        struct scene_body body = {.shape = shapes[i]};
        const struct scene scene = {.bodies = &body, .body_count = 1};
        struct hit_errors errors;
        for (size_t k = 0; k < HITS; k++)
            reference[k] = (struct hit_pixel){.distance = 3};
        memcpy(device, reference, sizeof device);
        device[55].triangle = 1;
        hits_compare(SIDE, SIDE, device, reference, &scene, &errors);
        near(errors.wrong_outside, i * 1e6 / HITS);
    }
}

// The background where neither the pixel nor one around it sees it, in any channel.
static void test_escapes(void **state) {
    (void)state;
    float device[3 * HITS] = {0};
    double reference[3 * HITS] = {0};
    const double one = 1e6 / HITS;
    near(hits_escapes(SIDE, SIDE, device, reference), 0);
    reference[3 * 55 + 1] = 0.25;
    for (size_t i = 0; i < 3; i++) {
        device[3 * (44 + i)] = 1e-9f; // around it
        device[3 * (74 + i) + i] = 1e-9f;
    }
    device[0] = device[3 * HITS - 1] = 1;
    near(hits_escapes(SIDE, SIDE, device, reference), 5 * one);
    device[0] = NAN;
    near(hits_escapes(SIDE, SIDE, device, reference), 5 * one);
}

static void test_scale_up(void **state) {
    (void)state;
    const float in[6] = {0, 0, 0, 1, 2, 4};
    float out[12];
    scale_picture(in, 2, 1, out, 4, 1);
    near((double)out[0], 0);
    near((double)out[4], 0.5); // a quarter of the way
    near((double)out[8], 3);
    near((double)out[11], 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_clear_times),
        cmocka_unit_test(test_noise_class),
        cmocka_unit_test(test_ties),
        cmocka_unit_test(test_pooled_noise),
        cmocka_unit_test(test_alternatives_take_no_part),
        cmocka_unit_test(test_cheapest),
        cmocka_unit_test(test_best_within),
        cmocka_unit_test(test_both_bounds),
        cmocka_unit_test(test_not_a_number),
        cmocka_unit_test(test_same_choice_under_noise),
        cmocka_unit_test(test_knee),
        cmocka_unit_test(test_plan_single),
        cmocka_unit_test(test_plan_pairs),
        cmocka_unit_test(test_plan_ground_truth),
        cmocka_unit_test(test_ordered_times),
        cmocka_unit_test(test_setting_text),
        cmocka_unit_test(test_hits),
        cmocka_unit_test(test_halves),
        cmocka_unit_test(test_escapes),
        cmocka_unit_test(test_scale_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
