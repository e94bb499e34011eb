// The points of samples: evenly spread in a pixel, in squares of pixels, and independent between what has
// other keys.
#include "scene/points.h"

#include "core/splitmix.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>

enum {
    BITS = 6,
    MOST = 1 << 12
};

static const struct points FIRST = {.bits = BITS};

static void one_sample_takes_the_middle(void **state) {
    (void)state;
    double a, b;
    const struct points points = {.x = 17, .y = 5, .bits = points_bits(0, 1)};
    points_at(&points, 1234, &a, &b);
    assert_true(a == 0.5 && b == 0.5);
}

static void bits_hold_the_numbers_of_the_samples(void **state) {
    (void)state;
    assert_int_equal(points_bits(0, 1), 0);
    assert_int_equal(points_bits(0, 2), 1);
    assert_int_equal(points_bits(0, 5), 3);
    assert_int_equal(points_bits(0, 4096), 12);
    assert_int_equal(points_bits(0, UINT32_MAX), POINT_MOST);
    // A sample that is not the first one is no middle.
    assert_int_equal(points_bits(7, 1), 1);
}

// Whether 2^total points have one in each box of each shape whose area is theirs: a (0, total, 2)-net in
// base 2.
static bool is_net(double (*points)[2], uint32_t total) {
    for (uint32_t wide = 0; wide <= total; wide++) {
        bool taken[MOST] = {false};
        const double columns = ldexp(1, (int)wide), lines = ldexp(1, (int)(total - wide));
        for (uint32_t i = 0; i < 1u << total; i++) {
            const size_t box = (size_t)(points[i][1] * lines) << wide | (size_t)(points[i][0] * columns);
            if (taken[box])
                return false;
            taken[box] = true;
        }
    }
    return true;
}

// Those of an aligned square of pixels.
static bool square_is_net(uint32_t x, uint32_t y, uint32_t side_bits, uint32_t key) {
    double all[MOST][2];
    uint32_t count = 0;
    for (uint32_t pixel = 0; pixel < 1u << 2 * side_bits; pixel++)
        for (uint32_t n = 0; n < 1u << BITS; n++, count++) {
            const struct points at = {x + (pixel & ((1u << side_bits) - 1)), y + (pixel >> side_bits), n,
                                      BITS};
            points_at(&at, key, &all[count][0], &all[count][1]);
        }
    return is_net(all, BITS + 2 * side_bits);
}

static void pixels_and_their_squares_are_covered_evenly(void **state) {
    (void)state;
    for (uint32_t key = 0; key < 20; key++) {
        assert_true(square_is_net(3 * key, 700 + key, 0, point_key(key, POINT_LENS)));
        assert_true(square_is_net(2 * key, 254, 1, point_key(key, POINT_PIXEL)));
        assert_true(square_is_net(8 * key, 1024, 3, point_key(key, POINT_LIGHT + key)));
    }
}

// Samples of a number beyond the bits, as others of the same pixel.
static void later_samples_are_others(void **state) {
    (void)state;
    for (uint32_t n = 0; n < 1u << BITS; n++) {
        double a, b, c, d;
        struct points at = FIRST;
        at.sample = n;
        points_at(&at, 9, &a, &b);
        at.sample = n + (1u << BITS);
        points_at(&at, 9, &c, &d);
        assert_true(a != c || b != d);
    }
}

// Mean over pixels of the product of two keys' coordinates, of points of variance 1.
static double correlation(uint32_t key, uint32_t other, bool second) {
    double sum = 0;
    const uint32_t count = 1 << 14;
    for (uint32_t i = 0; i < count; i++) {
        double a, b, c, d;
        struct points at = FIRST;
        at.x = i & 127;
        at.y = i >> 7;
        points_at(&at, key, &a, &b);
        points_at(&at, other, &c, &d);
        sum += (a - 0.5) * ((second ? d : c) - 0.5) * 12;
    }
    return sum / count;
}

static void keys_are_independent(void **state) {
    (void)state;
    const uint32_t ray = point_root(0, 0), child = point_key(ray, POINT_REFLECTED);
    const uint32_t keys[] = {point_key(ray, POINT_LIGHT), point_key(ray, POINT_LIGHT + 1),
                             point_key(ray, POINT_LENS), point_key(child, POINT_LIGHT),
                             point_key(child, POINT_LIGHT + 1)};
    const double five_sigma = 5 / 128.0;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        assert_true(fabs(correlation(keys[i], keys[i], true)) < five_sigma);
        for (size_t k = 0; k < i; k++) {
            assert_true(fabs(correlation(keys[i], keys[k], false)) < five_sigma);
            assert_true(fabs(correlation(keys[i], keys[k], true)) < five_sigma);
        }
    }
    assert_int_equal(point_key(ray, POINT_SAME), ray);
}

// Root of the mean square error, over pixels, of the mean of a function over 2^bits points of the sequence,
// or of points that only look random.
static double error_of(uint32_t bits, bool plain, bool smooth) {
    const uint32_t pixels = 1024, count = 1u << bits;
    uint64_t random = 1;
    double sum = 0;
    for (uint32_t i = 0; i < pixels; i++) {
        double mean = 0;
        for (uint32_t n = 0; n < count; n++) {
            double a, b;
            const struct points at = {i & 31, i >> 5, n, bits};
            points_at(&at, 77, &a, &b);
            if (plain) {
                a = (double)(splitmix_next(&random) >> 11) * 0x1p-53;
                b = (double)(splitmix_next(&random) >> 11) * 0x1p-53;
            }
            const double inside = a * a + b * b < 1;
            mean += (smooth ? sin(3 * a) * exp(b) : inside) / count;
        }
        const double is = smooth ? (1 - cos(3)) / 3 * (exp(1) - 1) : acos(-1) / 4;
        sum += (mean - is) * (mean - is) / pixels;
    }
    return sqrt(sum);
}

static double slope_of(bool plain, bool smooth) {
    return log2(error_of(10, plain, smooth) / error_of(2, plain, smooth)) / 8;
}

static void errors_fall_fast(void **state) {
    (void)state;
    assert_true(slope_of(false, false) < -0.73); // an edge: -3/4 (Owen 1997)
    assert_true(slope_of(false, true) < -1.3);   // smooth: -3/2, and a logarithm
    assert_true(slope_of(true, false) > -0.55);  // what only looks random: -1/2
    assert_true(error_of(4, false, false) < 0.6 * error_of(4, true, false));
}

// Errors of neighbours differ in sign: the mean over 4 x 4 pixels is far better than that of independent
// ones.
static void errors_of_neighbours_cancel(void **state) {
    (void)state;
    double own = 0, squares = 0;
    const double is = acos(-1) / 4;
    for (uint32_t square = 0; square < 256; square++) {
        double together = 0;
        for (uint32_t pixel = 0; pixel < 16; pixel++) {
            double mean = 0;
            for (uint32_t n = 0; n < 4; n++) {
                double a, b;
                const struct points at = {4 * (square & 15) + (pixel & 3), 4 * (square >> 4) + (pixel >> 2),
                                          n, 2};
                points_at(&at, 5, &a, &b);
                mean += (a * a + b * b < 1) / 4.0;
            }
            own += (mean - is) * (mean - is) / (256 * 16);
            together += (mean - is) / 16;
        }
        squares += together * together / 256;
    }
    // Independent ones: a quarter.
    assert_true(sqrt(squares) < 0.6 * 0.25 * sqrt(own));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_sample_takes_the_middle),
        cmocka_unit_test(bits_hold_the_numbers_of_the_samples),
        cmocka_unit_test(pixels_and_their_squares_are_covered_evenly),
        cmocka_unit_test(later_samples_are_others),
        cmocka_unit_test(keys_are_independent),
        cmocka_unit_test(errors_fall_fast),
        cmocka_unit_test(errors_of_neighbours_cancel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
