// A camera by keys and mouse: where it goes, that it stays upright and orthonormal, and what is asked for.
#include "window/steer.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const struct steer_pose START = {{1, 2, 3}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};

static struct steer make(void) {
    struct steer steer;
    steer_begin(&steer, START, (vec3){0, 2, 0}, 30);
    return steer;
}

static void check_near(vec3 a, vec3 b) {
    assert_true(vec3_length(vec3_sub(a, b)) < 1e-12);
}

static void check_upright(const struct steer *steer) {
    const struct steer_pose *p = &steer->pose;
    check_near(vec3_cross(p->right, p->up), vec3_neg(p->forward));
    assert_true(fabs(vec3_dot(p->right, p->up)) < 1e-12 && fabs(vec3_dot(p->right, p->forward)) < 1e-12);
    assert_true(fabs(vec3_length(p->forward) - 1) < 1e-12 && fabs(vec3_length(p->up) - 1) < 1e-12);
    // The horizon is level.
    assert_true(fabs(vec3_dot(p->right, steer->up)) < 1e-9);
    assert_true(vec3_dot(p->up, steer->up) > 0);
}

static struct steer_action key(struct steer *steer, int key, bool down) {
    return steer_event(steer, &(struct steer_event){.kind = STEER_KEY, .key = key, .down = down});
}

static struct steer_action button(struct steer *steer, int number, bool down, double x, double y) {
    return steer_event(
        steer, &(struct steer_event){.kind = STEER_BUTTON, .button = number, .down = down, .x = x, .y = y});
}

static void move(struct steer *steer, double x, double y) {
    steer_event(steer, &(struct steer_event){.kind = STEER_MOVE, .x = x, .y = y});
}

static void test_flies(void **state) {
    (void)state;
    static const struct {
        int key;
        vec3 way;
    } rows[] = {{'W', {0, 0, -1}}, {'S', {0, 0, 1}}, {'A', {-1, 0, 0}},
                {'D', {1, 0, 0}},  {'E', {0, 1, 0}}, {'Q', {0, -1, 0}}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct steer steer = make();
        assert_false(steer_step(&steer, 0.1));
        assert_int_equal(STEER_NOTHING, key(&steer, rows[i].key, true).what);
        assert_true(steer_is_flying(&steer));
        assert_true(steer_step(&steer, 0.1));
        // A third of the scene a second.
        check_near(steer.pose.position, vec3_add(START.position, rows[i].way));
        key(&steer, rows[i].key, false);
        assert_false(steer_is_flying(&steer) || steer_step(&steer, 0.1));
    }
}

// Two keys are as fast as one, opposite ones stand still, and a pause is no flight.
static void test_together(void **state) {
    (void)state;
    struct steer steer = make();
    key(&steer, 'W', true);
    key(&steer, 'D', true);
    steer_step(&steer, 0.1);
    assert_true(fabs(vec3_length(vec3_sub(steer.pose.position, START.position)) - 1) < 1e-12);
    key(&steer, 'S', true);
    key(&steer, 'A', true);
    assert_false(steer_step(&steer, 0.1));
    steer = make();
    key(&steer, 'W', true);
    steer_step(&steer, 1e6);
    assert_true(vec3_length(vec3_sub(steer.pose.position, START.position)) < 3);
    steer_event(&steer, &(struct steer_event){.kind = STEER_LEAVE});
    assert_false(steer_is_flying(&steer));
}

static void test_wheel(void **state) {
    (void)state;
    struct steer steer = make();
    const double speed = steer.speed;
    steer_event(&steer, &(struct steer_event){.kind = STEER_WHEEL, .amount = 2});
    assert_true(steer.speed > 1.5 * speed);
    steer_event(&steer, &(struct steer_event){.kind = STEER_WHEEL, .amount = -2});
    assert_true(fabs(steer.speed - speed) < 1e-12);
    for (int i = 0; i < 1000; i++)
        steer_event(&steer, &(struct steer_event){.kind = STEER_WHEEL, .amount = -9});
    assert_true(steer.speed > 0);
}

static void test_looks(void **state) {
    (void)state;
    struct steer steer = make();
    steer_resize(&steer, 100, 0.5); // 1/200 of a radian a pixel
    button(&steer, STEER_LEFT, true, 50, 50);
    move(&steer, 60, 50);
    move(&steer, 60, 50);
    assert_true(steer_step(&steer, 0.1));
    assert_false(steer_step(&steer, 0.1));
    // To the right: all ten pixels, those before it was a drag too few to matter.
    assert_true(fabs(steer.pose.forward.x - sin(0.05)) < 0.01 && steer.pose.forward.y == 0);
    check_near(steer.pose.position, START.position);
    check_upright(&steer);
    // Up to nearly straight up, however far the mouse goes.
    move(&steer, 60, -100000);
    for (int i = 1; i <= 2000; i++)
        move(&steer, 60, -100000 - 10 * i);
    check_upright(&steer);
    assert_true(steer.pose.forward.y > 0.99);
    for (int i = 1; i <= 5000; i++)
        move(&steer, 60 + 7 * i, -100000 + 11 * i * (i % 2 ? 1 : -1));
    check_upright(&steer);
    assert_int_equal(STEER_NOTHING, button(&steer, STEER_LEFT, false, 0, 0).what);
}

static void test_orbits(void **state) {
    (void)state;
    struct steer steer = make();
    steer.pivot = (vec3){1, 2, -7};
    steer.has_pivot = true;
    button(&steer, STEER_RIGHT, true, 0, 0);
    for (int i = 1; i <= 300; i++)
        move(&steer, 3 * i, i % 40);
    check_upright(&steer);
    // As far from the pivot as before, which is still in the middle.
    const vec3 way = vec3_sub(steer.pivot, steer.pose.position);
    assert_true(fabs(vec3_length(way) - 10) < 1e-9);
    assert_true(vec3_length(vec3_sub(vec3_unit(way), steer.pose.forward)) < 1e-9);
    assert_true(vec3_length(vec3_sub(steer.pose.position, START.position)) > 0.1);
}

static void test_clicks(void **state) {
    (void)state;
    struct steer steer = make();
    button(&steer, STEER_LEFT, true, 20, 30);
    move(&steer, 21, 31);
    struct steer_action action = button(&steer, STEER_LEFT, false, 21, 31);
    assert_int_equal(STEER_PICK, action.what);
    assert_true(action.x == 21 && action.y == 31);
    assert_false(steer_step(&steer, 0.1));
    // Back where it began, but a drag all the same.
    button(&steer, STEER_LEFT, true, 20, 30);
    move(&steer, 60, 30);
    move(&steer, 20, 30);
    assert_int_equal(STEER_NOTHING, button(&steer, STEER_LEFT, false, 20, 30).what);
    assert_int_equal(STEER_NOTHING, button(&steer, STEER_RIGHT, true, 5, 5).what);
    assert_int_equal(STEER_NOTHING, button(&steer, STEER_RIGHT, false, 5, 5).what);
    assert_int_equal(STEER_NOTHING, button(&steer, 7, true, 5, 5).what);
}

static void test_actions(void **state) {
    (void)state;
    static const struct {
        int key;
        enum steer_do what;
        uint32_t number;
    } rows[] = {{STEER_ESCAPE, STEER_QUIT, 0}, {STEER_TAB, STEER_NEXT, 0}, {'R', STEER_BACK, 0},
                {'P', STEER_WRITE, 0},         {'C', STEER_PRINT, 0},      {'H', STEER_OVERLAY, 0},
                {'1', STEER_CAMERA, 0},        {'9', STEER_CAMERA, 8},     {'0', STEER_CAMERA, 9},
                {'X', STEER_NOTHING, 0},       {0, STEER_NOTHING, 0},      {STEER_F1, STEER_KEYS, 0}};
    struct steer steer = make();
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const struct steer_action action = key(&steer, rows[i].key, true);
        assert_int_equal(rows[i].what, action.what);
        assert_int_equal(rows[i].number, action.number);
        assert_int_equal(STEER_NOTHING, key(&steer, rows[i].key, false).what);
    }
    assert_int_equal(STEER_QUIT, steer_event(&steer, &(struct steer_event){.kind = STEER_CLOSE}).what);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_flies),   cmocka_unit_test(test_together), cmocka_unit_test(test_wheel),
        cmocka_unit_test(test_looks),   cmocka_unit_test(test_orbits),   cmocka_unit_test(test_clicks),
        cmocka_unit_test(test_actions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
