// What flattening makes of triangles besides their bits: which are left out in double precision, and how long
// their tree took.
#include "core/clock.h"
#include "flat_kit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void test_build_time(void **state) {
    (void)state;
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    const double start = clock_seconds();
    kit_model(&kit, kit_icosphere(&kit, 1, 0));
    assert_true(kit_flatten(&kit, &flat));
    assert_true(flat.build_seconds >= 0 && flat.build_seconds <= clock_seconds() - start);
    flat_finish(&flat);
    kit_finish(&kit);
}

// A triangle is kept or left out whichever of its corners tells the normal best.
static void test_slivers_in_double(void **state) {
    (void)state;
    static const vec3 positions[3] = {{0, 0, 0}, {1, 0, 0}, {0.99, 1e-3, 0}};
    for (uint32_t first = 0; first < 3; first++)
        for (int flat_one = 0; flat_one < 2; flat_one++) {
            const uint32_t faces[1][3] = {{first, (first + 1) % 3, flat_one ? first : (first + 2) % 3}};
            struct kit kit;
            struct flat_scene flat;
            kit_init(&kit);
            kit.is_double = true;
            kit_model(&kit, kit_mesh(&kit, positions, 3, faces, 1, false));
            assert_true(kit_flatten(&kit, &flat));
            assert_int_equal(flat.dropped_triangles, flat_one);
            flat_finish(&flat);
            kit_finish(&kit);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_build_time),
        cmocka_unit_test(test_slivers_in_double),
    };
    return cmocka_run_group_tests_name("flatten items", tests, NULL, NULL);
}
