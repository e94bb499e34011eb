// Rays on the device inside closed corridors and pipes much longer than wide, and at rails: none sees the
// background, up to a million times as long as wide in single precision, a million million times in double.
//
// A second ray leaves each hit of a closed body on the side that the first one came from: it must hit the
// body too. That a search which drops hits within the bound of their error does not pass is tested as well.
#include "probe_kit.h"
#include "random.h"
#include "shape_kit.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

enum {
    RAYS = 2048, // into each body
};

struct lost {
    unsigned first, second;
};

static void choose_rays(const struct probe *probe, const struct long_body *body, struct probe_ray *rays) {
    for (uint32_t i = 0; i < RAYS; i++) {
        uint64_t seed = 2 * (uint64_t)i + 1;
        vec3 start, direction;
        long_ray(body, i, &start, &direction);
        rays[i] = (struct probe_ray){probe_place(probe, start), direction, 3e38, random_direction(&seed)};
    }
}

// So close to its plane that rounding of the corners decides on which side of the face the second ray goes.
static bool grazes(const struct probe *probe, const struct probe_ray *ray, const struct probe_hit *hit) {
    return fabs(vec3_dot(probe_normal(probe, hit->first.number), ray->next)) < 1e-5;
}

static struct lost count_lost(struct probe_fixture *f, const struct probe *probe,
                              const struct long_body *body) {
    struct lost lost = {0, 0};
    for (uint32_t i = 0; i < RAYS; i++) {
        const struct probe_hit *hit = &f->hits[i];
        lost.first += !hit->first.found || !hit->any;
        if (body->sides > 0 && hit->first.found && hit->same_side && !grazes(probe, &f->rays[i], hit))
            lost.second += !hit->second.found || !hit->blocked;
    }
    return lost;
}

static struct lost trace(void **state, const struct long_body *body, bool is_double, enum probe_way way) {
    struct probe_fixture *f = probe_need(state, is_double);
    struct kit kit;
    struct flat_scene flat;
    struct probe probe;
    kit_init(&kit);
    kit.is_double = is_double;
    long_make(&kit, body);
    assert_true(kit_flatten(&kit, &flat));
    assert_true(probe_init_way(&probe, f->device.gpu, &flat, false, way));
    choose_rays(&probe, body, f->rays);
    assert_true(probe_trace(&probe, f->rays, RAYS, f->hits));
    f->sent += RAYS;
    const struct lost lost = count_lost(f, &probe, body);
    probe_finish(&probe);
    flat_finish(&flat);
    kit_finish(&kit);
    return lost;
}

static void check(void **state, struct long_body body, bool is_double) {
    const struct lost lost = trace(state, &body, is_double, PROBE_EXACT);
    if (lost.first || lost.second)
        fail_msg("%s, %g long, %s: of %u rays %u saw the background, and %u of those from what they hit",
                 body.name, body.length, is_double ? "double" : "single", RAYS, lost.first, lost.second);
}

// `width`: of a rail, or of a side of a closed body.
static void check_lengths(void **state, const struct long_body *body, double width) {
    static const double single[] = {1e3, 1e6}, twofold[] = {1e6, 1e12};
    for (int i = 0; i < 2; i++) {
        check(state, (struct long_body){body->name, body->sides, single[i] * width}, false);
        check(state, (struct long_body){body->name, body->sides, twofold[i] * width}, true);
    }
}

static void test_corridor(void **state) {
    check_lengths(state, &(struct long_body){"corridor", 4, 0}, 2);
}

static void test_pipe_of_64(void **state) {
    check_lengths(state, &(struct long_body){"pipe of 64 sides", 64, 0}, LONG_PIPE_GIRTH / 64);
}

static void test_pipe_of_256(void **state) {
    check_lengths(state, &(struct long_body){"pipe of 256 sides", 256, 0}, LONG_PIPE_GIRTH / 256);
}

static void test_rails(void **state) {
    check(state, (struct long_body){"rails", 0, 600}, false);
    check_lengths(state, &(struct long_body){"rails", 0, 0}, LONG_RAIL_WIDTH);
}

// What the test is for.
static void test_bound(void **state) {
    static const struct long_body bodies[] = {{"corridor", 4, 2e3},
                                              {"pipe of 64 sides", 64, 1e3},
                                              {"pipe of 256 sides", 256, 100},
                                              {"rails", 0, 600}};
    for (unsigned i = 0; i < sizeof bodies / sizeof *bodies; i++) {
        const struct lost lost = trace(state, &bodies[i], false, PROBE_BOUND);
        printf("%s, %g long, hits beyond their bound alone: of %u rays %u saw the background\n",
               bodies[i].name, bodies[i].length, RAYS, lost.first);
        assert_true(lost.first > 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_corridor),    cmocka_unit_test(test_pipe_of_64),
        cmocka_unit_test(test_pipe_of_256), cmocka_unit_test(test_rails),
        cmocka_unit_test(test_bound),       cmocka_unit_test(device_kit_silent),
    };
    return cmocka_run_group_tests_name("corridors", tests, probe_setup, probe_teardown);
}
