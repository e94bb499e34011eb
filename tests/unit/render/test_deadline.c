// Which samples fit before a deadline, by a clock that the test sets.
#include "render/deadline.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// Makes samples that take `seconds` each from `now` on, as long as they fit; returns when the last one ends.
static double make(struct deadline *d, double now, double seconds) {
    do {
        deadline_begin_sample(d, now);
        now += seconds;
        deadline_end_sample(d, now);
    } while (deadline_fits(d, now));
    return now;
}

static void as_many_as_fit(void **state) {
    (void)state;
    struct deadline d;
    deadline_begin(&d, 100, 110);
    assert_true(make(&d, 100, 3) == 109);
    assert_int_equal(d.samples, 3);
}

static void the_first_is_always_made(void **state) {
    (void)state;
    struct deadline d;
    deadline_begin(&d, 100, 101);
    make(&d, 100, 50);
    assert_int_equal(d.samples, 1);
}

// Writing takes 2 s, and looking at each sample once more 1 s.
static void what_comes_after_has_its_time(void **state) {
    (void)state;
    struct deadline d;
    deadline_begin(&d, 0, 20);
    d.after = 2;
    d.after_a_sample = 1;
    const double end = make(&d, 0, 2);
    assert_int_equal(d.samples, 6);
    assert_true(end + 2 + d.samples * 1.0 <= 20);
    assert_true(end + 2 + 2 + (d.samples + 1) * 1.0 > 20);
    assert_false(deadline_is_over(&d, 12));
    assert_true(deadline_is_over(&d, 12.1));
}

// One that was slow is expected again, but not for ever.
static void the_slower_of_the_last_two_counts(void **state) {
    (void)state;
    struct deadline d;
    deadline_begin(&d, 0, 10);
    deadline_end_sample(&d, 4);
    deadline_begin_sample(&d, 4);
    deadline_end_sample(&d, 5);
    assert_true(deadline_fits(&d, 6));
    assert_false(deadline_fits(&d, 6.5));
    deadline_begin_sample(&d, 5);
    deadline_end_sample(&d, 6);
    assert_true(deadline_fits(&d, 9));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_many_as_fit),
        cmocka_unit_test(the_first_is_always_made),
        cmocka_unit_test(what_comes_after_has_its_time),
        cmocka_unit_test(the_slower_of_the_last_two_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
