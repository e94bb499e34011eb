// Curves through keys: exact at keys, between them as their kind says, and looped.
#include "core/curve.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double frames[] = {0, 10, 30, 40};
static const double values[] = {1, 5, 3, 1};

static struct curve curve_of(enum curve_way way, enum curve_loop loop) {
    return (struct curve){frames, values, 4, 1, way, loop};
}

static double at(const struct curve *c, double frame) {
    double out[CURVE_WIDTH_MOST];
    curve_at(c, frame, out);
    return out[0];
}

static void keys_are_exact(void **state) {
    (void)state;
    for (int way = CURVE_LINEAR; way <= CURVE_STEP; way++)
        for (int loop = CURVE_ONCE; loop <= CURVE_MIRROR; loop++) {
            const struct curve c = curve_of((enum curve_way)way, (enum curve_loop)loop);
            for (int i = 0; i < 3; i++)
                assert_true(at(&c, frames[i]) == values[i]);
            assert_true(at(&c, 40) == 1); // the last one and, repeated, the first one
        }
}

static void between_keys(void **state) {
    (void)state;
    const struct curve line = curve_of(CURVE_LINEAR, CURVE_ONCE), ease = curve_of(CURVE_EASE, CURVE_ONCE);
    const struct curve step = curve_of(CURVE_STEP, CURVE_ONCE);
    assert_true(at(&line, 2.5) == 2);
    assert_true(at(&line, 20) == 4);
    assert_true(at(&ease, 5) == 3);
    assert_true(fabs(at(&ease, 2.5) - (1 + 4 * 0.15625)) < 1e-12);
    assert_true(at(&step, 9.999) == 1 && at(&step, 10) == 5 && at(&step, 29) == 5);
}

static void ends_stay_or_loop(void **state) {
    (void)state;
    const struct curve once = curve_of(CURVE_LINEAR, CURVE_ONCE);
    const struct curve repeat = curve_of(CURVE_LINEAR, CURVE_REPEAT);
    const struct curve mirror = curve_of(CURVE_LINEAR, CURVE_MIRROR);
    assert_true(at(&once, -5) == 1 && at(&once, 1e6) == 1);
    assert_true(at(&repeat, 45) == 3 && at(&repeat, 50) == 5 && at(&repeat, -10) == 3);
    assert_true(at(&mirror, 45) == at(&mirror, 35) && at(&mirror, 80) == 1 && at(&mirror, 90) == 5);
}

// What a curve of keys must be: no jump, and no corner, at the keys and where a loop closes.
static void smooth_has_no_corner(void **state) {
    (void)state;
    const double h = 1e-5;
    for (int loop = CURVE_ONCE; loop <= CURVE_MIRROR; loop++) {
        const struct curve c = curve_of(CURVE_SMOOTH, (enum curve_loop)loop);
        for (int turn = 0; turn < (loop == CURVE_ONCE ? 1 : 3); turn++)
            for (int i = 0; i < 4; i++) {
                const double key = frames[i] + 40 * turn;
                if (loop == CURVE_ONCE && (i == 0 || i == 3))
                    continue;
                const double before = (at(&c, key) - at(&c, key - h)) / h;
                const double after = (at(&c, key + h) - at(&c, key)) / h;
                assert_true(fabs(before - after) < 1e-3);
            }
    }
}

// A loop shows the middle of three turns that are written out, each beginning where the one before has ended.
static void a_loop_is_the_middle_of_three_turns(void **state) {
    (void)state;
    static const double turns[][4] = {{0, 90, 100, 360}, {1, 5, 3, 1}, {-2, 0, 7, 0.5}};
    for (size_t k = 0; k < sizeof turns / sizeof *turns; k++) {
        double when[10], what[10];
        const double *v = turns[k];
        for (int i = 0; i < 10; i++) {
            when[i] = frames[i % 3] + 40 * (i / 3);
            what[i] = v[i % 3] + (v[3] - v[0]) * (i / 3);
        }
        const struct curve loop = {frames, v, 4, 1, CURVE_SMOOTH, CURVE_REPEAT};
        const struct curve written = {when, what, 10, 1, CURVE_SMOOTH, CURVE_ONCE};
        for (double frame = 0; frame < 40; frame += 0.25)
            assert_true(fabs(at(&loop, frame) - (at(&written, frame + 40) - (v[3] - v[0]))) < 1e-9);
    }
}

static void straight_keys_make_a_straight_curve(void **state) {
    (void)state;
    const double line[] = {0, 20, 60, 80};
    const struct curve c = {frames, line, 4, 1, CURVE_SMOOTH, CURVE_ONCE};
    for (double frame = 0; frame <= 40; frame += 0.5)
        assert_true(fabs(at(&c, frame) - 2 * frame) < 1e-12);
}

static void one_key_and_several_numbers(void **state) {
    (void)state;
    const double place[] = {1, 2, 3, 4, 5, 6}, when[] = {5, 15};
    double out[CURVE_WIDTH_MOST];
    for (int way = CURVE_LINEAR; way <= CURVE_STEP; way++)
        for (int loop = CURVE_ONCE; loop <= CURVE_MIRROR; loop++) {
            const struct curve c = {when, place, 1, 3, (enum curve_way)way, (enum curve_loop)loop};
            curve_at(&c, 100, out);
            assert_true(out[0] == 1 && out[1] == 2 && out[2] == 3);
        }
    const struct curve c = {when, place, 2, 3, CURVE_LINEAR, CURVE_ONCE};
    curve_at(&c, 10, out);
    assert_true(out[0] == 2.5 && out[1] == 3.5 && out[2] == 4.5);
    assert_int_equal(curve_key(&c, 14), 0);
    assert_int_equal(curve_key(&c, 15), 1);
    assert_int_equal(curve_key(&c, 0), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_are_exact),
        cmocka_unit_test(between_keys),
        cmocka_unit_test(ends_stay_or_loop),
        cmocka_unit_test(smooth_has_no_corner),
        cmocka_unit_test(a_loop_is_the_middle_of_three_turns),
        cmocka_unit_test(straight_keys_make_a_straight_curve),
        cmocka_unit_test(one_key_and_several_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
