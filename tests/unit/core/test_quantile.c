// Sorting measured numbers, and their quantiles.
#include "core/quantile.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void near(double value, double expected) {
    if (!(fabs(value - expected) <= 1e-12))
        fail_msg("%.17g is not %.17g", value, expected);
}

static void test_sort(void **state) {
    (void)state;
    double values[] = {3, (double)NAN, -1, (double)INFINITY, 2};
    quantile_sort(values, 5);
    near(values[0], -1);
    near(values[1], 2);
    near(values[2], 3);
    assert_true(isinf(values[3]) && isnan(values[4]));
    quantile_sort(values, 0);
}

static void test_quantile(void **state) {
    (void)state;
    const double values[] = {1, 2, 4, 8};
    near(quantile(values, 4, 0), 1);
    near(quantile(values, 4, 1), 8);
    near(quantile(values, 4, 0.5), 3); // even: the middle of two
    near(quantile(values, 3, 0.5), 2); // odd: one of them
    near(quantile(values, 4, 0.25), 1.75);
    near(quantile(values, 1, 0.5), 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sort),
        cmocka_unit_test(test_quantile),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
