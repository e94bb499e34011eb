// Four floats at a time: the processor's instructions and the plain loops give the same bits.
#include "tracer/bvh/lanes.h"

// The same header once more, with other names.
#undef GLINT_TRACER_BVH_LANES_H
#define GLINT_PLAIN_LANES
#define lanes       plain
#define lanes_load  plain_load
#define lanes_store plain_store
#define lanes_all   plain_all
#define lanes_add   plain_add
#define lanes_sub   plain_sub
#define lanes_mul   plain_mul
#define lanes_min   plain_min
#define lanes_max   plain_max
#define lanes_three plain_three
#define lanes_whole plain_whole
#include "tracer/bvh/lanes.h"
#undef lanes
#undef lanes_load
#undef lanes_store
#undef lanes_all
#undef lanes_add
#undef lanes_sub
#undef lanes_mul
#undef lanes_min
#undef lanes_max
#undef lanes_three
#undef lanes_whole

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const float VALUES[] = {0.0f,      -0.0f,         1.0f,     -1.0f,      3.25f,       -7.5f,
                               0x1p-149f, 1e-3f,         0x1p120f, -0x1p120f,  0x1.fffp13f, 15.0f,
                               -0x1p-30f, 2147483520.0f, 0.1f,     16777216.0f};

enum {
    VALUE_COUNT = sizeof VALUES / sizeof *VALUES
};

static void assert_same(lanes a, plain b) {
    float x[4], y[4];
    lanes_store(a, x);
    plain_store(b, y);
    assert_memory_equal(x, y, sizeof x);
}

static void test_same(void **state) {
    (void)state;
    for (size_t i = 0; i < VALUE_COUNT; i++)
        for (size_t k = 0; k < VALUE_COUNT; k++) {
            const float four[4] = {VALUES[i], VALUES[(i + 1) % VALUE_COUNT], VALUES[k], VALUES[(k + 5) % 16]};
            const float other[4] = {VALUES[k], VALUES[i], VALUES[(k + 3) % VALUE_COUNT], VALUES[i]};
            const lanes a = lanes_load(four), b = lanes_load(other);
            const plain c = plain_load(four), d = plain_load(other);
            assert_same(lanes_add(a, b), plain_add(c, d));
            assert_same(lanes_sub(a, b), plain_sub(c, d));
            assert_same(lanes_mul(a, b), plain_mul(c, d));
            assert_same(lanes_min(a, b), plain_min(c, d));
            assert_same(lanes_max(a, b), plain_max(c, d));
            assert_same(lanes_three(a), plain_three(c));
            assert_same(lanes_all(VALUES[i]), plain_all(VALUES[i]));
        }
}

static void test_whole(void **state) {
    (void)state;
    const float four[4] = {0.999f, 14.5f, 2147483520.0f, -3.75f};
    const int32_t expected[4] = {0, 14, 2147483520, -3};
    int32_t found[4];
    lanes_whole(lanes_load(four), found);
    assert_memory_equal(found, expected, sizeof found);
    plain_whole(plain_load(four), found);
    assert_memory_equal(found, expected, sizeof found);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same), cmocka_unit_test(test_whole)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
