// Choosing from tables made up for it, and first hits counted by hand.
#include "measure/tradeoff/choose/choose.h"
#include "measure/tradeoff/measure/measure.h"
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
    near(errors.silhouette, 20 * one); // the two columns at the border of the bodies
    assert_true(errors.wrong_inside + errors.wrong_outside + errors.acne + errors.leaks == 0);
    device[4].body = 1;                // at silhouettes
    device[11].triangle = 8;           // elsewhere
    device[12].body = HIT_NONE;        // a hole, and wrong
    device[18].body = HIT_NONE;        // the same through an open body
    device[13].lit = 0;                // acne
    device[92].lit = 1;                // a leak
    device[52].lit = 1;                // at the shadow's edge
    device[22].reflected = 5;          // another second body
    device[81].considered = 0;         // not lit by anything: neither acne nor leak
    device[24].reflected = 5;          // at silhouettes, where it does not count
    reference[82].distance = 3 * 1.04; // a slope, no silhouette
    hits_compare(SIDE, SIDE, device, reference, &scene, &errors);
    near(errors.silhouette, 20 * one);
    near(errors.wrong_inside, one);
    near(errors.wrong_outside, 3 * one);
    near(errors.holes, one);
    near(errors.acne, one);
    near(errors.leaks, one);
    near(errors.shadow_edge, one);
    near(errors.wrong_second, one);
    reference[82].distance = 4; // a step: the pixel and its eight neighbours
    hits_compare(SIDE, SIDE, device, reference, &scene, &errors);
    near(errors.silhouette, 29 * one);
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
        cmocka_unit_test(test_hits),
        cmocka_unit_test(test_halves),
        cmocka_unit_test(test_escapes),
        cmocka_unit_test(test_scale_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
