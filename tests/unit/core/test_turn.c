// Sines in degrees: how near to the truth, exact quarters, the same bits everywhere. An argument is how many
// angles to try.
#include "core/turn.h"

#include "core/splitmix.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static int count = 1000000;

// Angles of all sizes, half of them of a few turns; every tenth near a quarter turn.
static double angle(uint64_t *state) {
    const uint64_t kind = splitmix_next(state) % 10;
    const double u = (double)(splitmix_next(state) >> 11) * 0x1p-53 - 0.5;
    if (kind == 0)
        return 90 * (double)(int64_t)(splitmix_next(state) % 4001 - 2000) + u * 0x1p-20;
    if (kind < 6)
        return 1440 * u;
    return ldexp(u, (int)(splitmix_next(state) % 80) - 40);
}

#if LDBL_MANT_DIG >= 64
// The angle's distance from the nearest multiple of 180 is exact.
static long double true_sine(long double degrees) {
    int half;
    const long double rest = remquol(degrees, 180, &half);
    const long double value = sinl(rest * 0.017453292519943295769236907684886L);
    return half & 1 ? -value : value;
}

static double units(double value, long double truth) {
    int exponent;
    frexp(value, &exponent);
    return (double)fabsl(value - truth) / ldexp(1, exponent - 53);
}

static void near_the_truth(void **state) {
    uint64_t seed = 1;
    double worst = 0, at = 0;
    (void)state;
    for (int i = 0; i < count; i++) {
        const double a = angle(&seed);
        const double of_sine = turn_sine(a) == 0 ? 0 : units(turn_sine(a), true_sine(a));
        const double of_cosine =
            turn_cosine(a) == 0 ? 0 : units(turn_cosine(a), true_sine(90 - fabsl(fmodl(a, 360))));
        const double most = of_sine > of_cosine ? of_sine : of_cosine;
        at = most > worst ? a : at;
        worst = most > worst ? most : worst;
    }
    printf("%d angles: at most %.4f units in the last place, at %.17g degrees\n", count, worst, at);
    assert_true(worst <= 0.6);
    assert_true(worst > 0.4); // else nothing was measured
}
#endif

static void exact_quarters(void **state) {
    (void)state;
    for (int i = -4000; i <= 4000; i++) {
        static const double sines[] = {0, 1, 0, -1};
        const double of_sine = turn_sine(90.0 * i), of_cosine = turn_cosine(90.0 * i);
        assert_true(of_sine == sines[i & 3] && !(of_sine == 0 && signbit(of_sine)));
        assert_true(of_cosine == sines[(i + 1) & 3] && !(of_cosine == 0 && signbit(of_cosine)));
        assert_true(fabs(turn_sine(180.0 * i + 30)) == 0.5 && fabs(turn_cosine(180.0 * i + 60)) == 0.5);
    }
    assert_true(isnan(turn_sine(INFINITY)) && isnan(turn_cosine(NAN)));
}

// What x86-64 gave; 1e6 angles.
static void same_bits(void **state) {
    uint64_t seed = 2, hash = 0;
    (void)state;
    for (int i = 0; i < 1000000; i++) {
        const double a = angle(&seed), values[] = {turn_sine(a), turn_cosine(a)};
        for (int k = 0; k < 2; k++) {
            uint64_t bits;
            memcpy(&bits, &values[k], sizeof bits);
            hash = splitmix(hash ^ bits);
        }
    }
    printf("bits: %016llx\n", (unsigned long long)hash);
    assert_true(hash == UINT64_C(0x671378f17083190f));
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
#if LDBL_MANT_DIG >= 64
        cmocka_unit_test(near_the_truth),
#endif
        cmocka_unit_test(exact_quarters),
        cmocka_unit_test(same_bits),
    };
    count = argc > 1 ? (int)strtol(argv[1], NULL, 10) : count;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
