// The reference inside closed corridors and pipes up to a million million times as long as wide, and at rails
// as long: no ray sees the background, neither the first one nor those that mirrors send on.
#include "reference_kit.h"
#include "tests/unit/kit/shape_kit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum {
    RAYS = 2000,
    SEGMENTS = 32, // of a path at most: mirrors send a ray from each surface
    SIZE = 24,     // pixels, of the picture whose paths are followed
};

static uint32_t count_misses(const struct reference *r, const struct long_body *body) {
    uint32_t misses = 0;
    for (uint32_t i = 0; i < RAYS; i++) {
        struct reference_hit hit;
        vec3 start, direction;
        long_ray(body, i, &start, &direction);
        reference_closest(r, start, direction, INFINITY, &hit);
        misses += hit.body == HIT_NONE || !reference_occluded(r, start, direction, INFINITY);
    }
    return misses;
}

// Rays of the paths of a picture from inside that see the background.
static uint32_t count_lost(const struct reference *r) {
    const struct reference_settings settings = {
        .width = SIZE, .height = SIZE, .samples = 1, .max_depth = 12, .segments = SEGMENTS, .as_file = true};
    uint32_t lost = 0, followed = 0;
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        struct reference_segment path[SEGMENTS];
        const uint32_t count = reference_log(r, &settings, i % SIZE, i / SIZE, 0, path, SEGMENTS, NULL);
        for (uint32_t k = 0; k < count && k < SEGMENTS; k++)
            lost += path[k].body == HIT_NONE;
        followed += count;
    }
    assert_true(followed > 10 * SIZE * SIZE);
    return lost;
}

static void check(struct long_body body) {
    struct kit kit;
    kit_init(&kit);
    long_make(&kit, &body);
    reference_kit_camera(&kit, kit.origin);
    kit_material(&kit)->albedo = (struct ir_weights){.reflection = 1};
    if (body.sides > 0)
        kit_model_material(&kit, 0, 0);
    struct reference *r = reference_kit_make(&kit, REFERENCE_WATERTIGHT, false);
    const uint32_t misses = count_misses(r, &body), lost = body.sides > 0 ? count_lost(r) : 0;
    if (misses || lost)
        fail_msg("%s, %g long: %u of %u rays saw the background, and %u of those that mirrors sent on",
                 body.name, body.length, misses, RAYS, lost);
    reference_destroy(r);
    kit_finish(&kit);
}

// `width`: of a rail, or of a side of a closed body.
static void check_lengths(const struct long_body *body, double width) {
    for (double aspect = 1e3; aspect < 2e12; aspect *= 1e3)
        check((struct long_body){body->name, body->sides, aspect * width});
}

static void test_corridor(void **state) {
    (void)state;
    check_lengths(&(struct long_body){"corridor", 4, 0}, 2);
}

static void test_pipe_of_64(void **state) {
    (void)state;
    check_lengths(&(struct long_body){"pipe of 64 sides", 64, 0}, LONG_PIPE_GIRTH / 64);
}

static void test_pipe_of_256(void **state) {
    (void)state;
    check_lengths(&(struct long_body){"pipe of 256 sides", 256, 0}, LONG_PIPE_GIRTH / 256);
}

static void test_rails(void **state) {
    (void)state;
    check((struct long_body){"rails", 0, 600});
    check_lengths(&(struct long_body){"rails", 0, 0}, LONG_RAIL_WIDTH);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_corridor),
        cmocka_unit_test(test_pipe_of_64),
        cmocka_unit_test(test_pipe_of_256),
        cmocka_unit_test(test_rails),
    };
    return cmocka_run_group_tests_name("exact corridors", tests, NULL, NULL);
}
