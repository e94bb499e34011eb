#include "core/vec3.h"

#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void products(void **state) {
    (void)state;
    vec3 x = {1, 0, 0};
    vec3 y = {0, 1, 0};
    vec3 z = vec3_cross(x, y);
    assert_true(z.x == 0 && z.y == 0 && z.z == 1);
    assert_true(vec3_dot((vec3){1, 2, 3}, (vec3){4, -5, 6}) == 12);
    assert_true(vec3_max_abs((vec3){1, -7, 3}) == 7);
    assert_true(vec3_is_zero((vec3){0, -0.0, 0}));
    assert_false(vec3_is_zero((vec3){0, DBL_TRUE_MIN, 0}));
}

static void lengths_neither_overflow_nor_vanish(void **state) {
    (void)state;
    assert_true(vec3_length((vec3){3, 4, 0}) == 5);
    assert_true(vec3_length((vec3){0, 0, 0}) == 0);
    assert_true(vec3_length((vec3){3e300, -4e300, 0}) == 5e300);
    assert_true(vec3_length((vec3){0x3p-1070, 0x4p-1070, 0}) == 0x5p-1070);
    assert_true(vec3_length((vec3){DBL_TRUE_MIN, 0, 0}) == DBL_TRUE_MIN);
    assert_true(isinf(vec3_length((vec3){1, INFINITY, 0})));
}

static void unit_vectors(void **state) {
    (void)state;
    vec3 zero = vec3_unit((vec3){0, 0, 0});
    assert_true(vec3_is_zero(zero));
    const vec3 v = {0.3, -1.7, 12.25};
    const vec3 unit = vec3_unit(v);
    assert_true(fabs(vec3_length(unit) - 1) < 1e-15);
    // Scaling by powers of two changes no bit.
    for (int k = -1000; k <= 1000; k += 50) {
        vec3 scaled = {scalbn(v.x, k), scalbn(v.y, k), scalbn(v.z, k)};
        vec3 same = vec3_unit(scaled);
        assert_true(same.x == unit.x && same.y == unit.y && same.z == unit.z);
        assert_true(vec3_length(scaled) == scalbn(vec3_length(v), k));
    }
}

// What is computed without dividing first has the bits that it would have with it.
static void ordinary_sizes(void **state) {
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 20000; i++) {
        double part[3];
        for (int k = 0; k < 3; k++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            const double value = (double)(seed >> 11) * 0x1p-53 - 0.5;
            part[k] = scalbn(value, (int)(seed >> 3 & 63) - 32);
        }
        const vec3 v = {part[0], part[1], part[2]};
        const vec3 far = {scalbn(v.x, 600), scalbn(v.y, 600), scalbn(v.z, 600)};
        const vec3 a = vec3_unit(v), b = vec3_unit(far);
        assert_true(a.x == b.x && a.y == b.y && a.z == b.z);
        assert_true(scalbn(vec3_length(v), 600) == vec3_length(far));
    }
    assert_true(vec3_max_abs((vec3){NAN, -2, 1}) == 2 && vec3_max_abs((vec3){1, NAN, NAN}) == 1);
    assert_true(isnan(vec3_max_abs((vec3){NAN, NAN, NAN})));
}

static void matrices_apply_in_order(void **state) {
    (void)state;
    const mat3 quarter_turn = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}; // about z
    const mat3 stretch = {{{2, 0, 0}, {0, 3, 0}, {0, 0, 4}}};
    const vec3 v = {1, 10, 100};
    vec3 both = mat3_apply(mat3_mul(quarter_turn, stretch), v);
    vec3 in_turn = mat3_apply(quarter_turn, mat3_apply(stretch, v));
    assert_true(both.x == -30 && both.y == 2 && both.z == 400);
    assert_true(both.x == in_turn.x && both.y == in_turn.y && both.z == in_turn.z);
    vec3 moved = affine3_apply((affine3){stretch, {1, 1, 1}}, v);
    assert_true(moved.x == 3 && moved.y == 31 && moved.z == 401);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(products),
        cmocka_unit_test(lengths_neither_overflow_nor_vanish),
        cmocka_unit_test(ordinary_sizes),
        cmocka_unit_test(unit_vectors),
        cmocka_unit_test(matrices_apply_in_order),
    };
    return cmocka_run_group_tests_name("vec3", tests, NULL, NULL);
}
