// What the device's rays hit of cylinders, cones, boxes and rings, in single and double precision, against
// the bodies' closed forms: place, normal and distance of every pixel from random cameras around and inside.
#include "device_kit.h"
#include "flat_kit.h"
#include "form_kit.h"
#include "random.h"
#include "tracer/render/render.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum {
    WIDTH = 161, // no whole number of tiles
    HEIGHT = 115,
    PIXELS = WIDTH * HEIGHT,
    CAMERAS = 6, // 111 090 rays at each body
};
#define TAN_HALF_FOV 0.5

static const struct form CYLINDER = {"cylinder", FORM_FRUSTUM, 0.7, 0.7, 2.1, .turn = {40, 0, 70}};
static const struct form CONE = {"cone", FORM_FRUSTUM, 1.1, 0, 2, .turn = {-25, 0, 15}};
static const struct form FRUSTUM = {"frustum", FORM_FRUSTUM, 0.4, 1.7, 1, .turn = {80, 0, 80}};
static const struct form BOX = {"box", FORM_BOX, 0.3, 2, 1.5, .turn = {25, -50, 110}};
static const struct form RING = {"ring", FORM_TORUS, 1.5, 0.5, .tolerance = 1e-3, .turn = {60, 20, -35}};

// From outside, and one in three from deep inside.
static struct view_camera random_camera(const struct form *form, int i, uint64_t *random) {
    const vec3 middle = form_middle(form), aside = random_direction(random);
    const vec3 away = vec3_mul(random_direction(random), form_reach(form) * (1.5 + 2 * random_unit(random)));
    const vec3 position = i % 3 == 2 ? form_inside(form, random_unit(random)) : vec3_add(middle, away);
    const vec3 forward = i % 3 == 2 ? random_direction(random) : vec3_unit(vec3_sub(middle, position));
    const vec3 right = vec3_unit(vec3_cross(forward, aside));
    return (struct view_camera){.position = position,
                                .right = right,
                                .up = vec3_cross(right, forward),
                                .forward = forward,
                                .tan_half_fov = TAN_HALF_FOV};
}

static vec3 direction_at(const struct view_camera *camera, double x, double y) {
    const double right = (2 * x / WIDTH - 1) * TAN_HALF_FOV * WIDTH / HEIGHT,
                 up = (1 - 2 * y / HEIGHT) * TAN_HALF_FOV;
    return vec3_unit(
        vec3_add(camera->forward, vec3_add(vec3_mul(camera->right, right), vec3_mul(camera->up, up))));
}

struct counts {
    uint32_t rays, hits, inside, uncertain;
    double place, normal;
};

// false: next to the pixel's centre there is another face, or none, so that rounding may decide.
static bool is_certain(const struct form *form, const struct view_camera *camera, int x, int y, bool found,
                       const struct form_hit *truth, double step) {
    for (int k = 0; k < 4; k++) {
        struct form_hit near;
        const vec3 direction =
            direction_at(camera, x + 0.5 + (k & 1 ? step : -step), y + 0.5 + (k & 2 ? step : -step));
        if (form_first(form, camera->position, direction, 0, &near) != found)
            return false;
        if (found && vec3_dot(near.normal, truth->normal) < 0.999)
            return false;
    }
    return true;
}

static void fail_at(const struct form *form, bool is_double, int x, int y, const struct hit_pixel *got) {
    fail_msg("%s, %s: pixel %d,%d hits %d at %g, normal %g %g %g", form->name,
             is_double ? "double" : "single", x, y, (int)got->body, got->distance, got->normal.x,
             got->normal.y, got->normal.z);
}

static void compare_exact(const struct form *form, const struct view_camera *camera, int x, int y,
                          const struct hit_pixel *got, bool is_double, struct counts *n) {
    struct form_hit truth = {0};
    const vec3 direction = direction_at(camera, x + 0.5, y + 0.5);
    const bool found = form_first(form, camera->position, direction, 0, &truth);
    if (!is_certain(form, camera, x, y, found, &truth, is_double ? 1e-9 : 1e-3)) {
        n->uncertain++;
        return;
    }
    if (found != (got->body == 0))
        fail_at(form, is_double, x, y, got);
    if (!found)
        return;
    const double steep = fabs(vec3_dot(truth.normal, direction));
    const vec3 normal = truth.enters ? truth.normal : vec3_neg(truth.normal);
    n->hits++;
    n->inside += !truth.enters;
    n->place = fmax(n->place, fabs(got->distance - truth.t) * steep / form_reach(form));
    n->normal = fmax(n->normal, vec3_length(vec3_sub(got->normal, normal)) * steep);
}

// The mesh lies between two rings: a ray that reaches the farther one has passed it.
static void compare_ring(const struct form *form, const struct view_camera *camera, int x, int y,
                         const struct hit_pixel *got, bool is_double, struct counts *n) {
    const double most = form->tolerance * (form->a + form->b) + (is_double ? 0 : 1e-5);
    const double side = form_near_torus(form, camera->position).outside > 0 ? most : -most;
    const vec3 direction = direction_at(camera, x + 0.5, y + 0.5);
    struct form_hit nearer = {0}, farther = {0};
    const bool may = form_first(form, camera->position, direction, side, &nearer),
               must = form_first(form, camera->position, direction, -side, &farther);
    n->uncertain += may != must;
    if ((got->body == 0 && !may) || (got->body != 0 && must))
        fail_at(form, is_double, x, y, got);
    if (got->body != 0)
        return;
    const vec3 at = vec3_add(camera->position, vec3_mul(direction, got->distance));
    const struct form_near near = form_near_torus(form, at);
    const vec3 normal = side > 0 ? near.normal : vec3_neg(near.normal);
    const double bend = most / form->b + most / near.around;
    n->hits++;
    n->inside += side < 0;
    n->place = fmax(n->place, fabs(near.outside) / most);
    n->normal = fmax(n->normal, vec3_length(vec3_sub(got->normal, normal)) / bend);
}

static struct counts look(void **state, const struct form *form, bool is_double) {
    struct gpu *gpu = device_kit_need(state, is_double);
    const bool is_ring = form->kind == FORM_TORUS;
    struct counts n = {0};
    struct mesh room = {0};
    struct kit kit;
    struct flat_scene flat;
    uint64_t random = 1;
    kit_init(&kit);
    kit.is_double = is_double;
    form_add(&kit, form, &room);
    assert_true(kit_flatten(&kit, &flat));
    struct render_settings settings = render_settings_of(&kit.resolved, &flat, &kit.limits);
    settings.width = WIDTH;
    settings.height = HEIGHT;
    struct renderer *renderer = renderer_create(gpu, &flat, &settings);
    assert_non_null(renderer);
    struct hit_pixel *hits = calloc(PIXELS, sizeof *hits);
    assert_non_null(hits);
    for (int i = 0; i < CAMERAS; i++) {
        const struct view_camera camera = random_camera(form, i, &random);
        assert_int_equal(renderer_first_hits(renderer, &camera, 0, hits, NULL), RENDER_DONE);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++)
                (is_ring ? compare_ring : compare_exact)(form, &camera, x, y, &hits[y * WIDTH + x], is_double,
                                                         &n);
    }
    n.rays = CAMERAS * PIXELS;
    free(hits);
    renderer_destroy(renderer);
    flat_finish(&flat);
    kit_finish(&kit);
    arena_finish(&room.arena);
    printf("%-10s %s: %u of %u rays hit, %u from inside, %u uncertain; places off by %.2g, normals by %.2g\n",
           form->name, is_double ? "double" : "single", n.hits, n.rays, n.inside, n.uncertain, n.place,
           n.normal);
    assert_in_range(n.hits, n.rays / 3, n.rays);
    assert_in_range(n.inside, n.rays / 10, n.rays);
    return n;
}

static void check(void **state, const struct form *form) {
    for (int is_double = 0; is_double < 2; is_double++) {
        const struct counts n = look(state, form, is_double);
        assert_in_range(n.uncertain, 0, n.rays / 100);
        // Normals are written as floats.
        if (form->kind == FORM_TORUS)
            assert_true(n.place <= 1 && n.normal <= 1);
        else
            assert_true(n.place < (is_double ? 1e-13 : 1e-5) && n.normal < (is_double ? 1e-7 : 1e-4));
    }
}

static void test_cylinder(void **state) {
    check(state, &CYLINDER);
}

static void test_cone(void **state) {
    check(state, &CONE);
}

static void test_frustum(void **state) {
    check(state, &FRUSTUM);
}

static void test_box(void **state) {
    check(state, &BOX);
}

static void test_ring(void **state) {
    check(state, &RING);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cylinder), cmocka_unit_test(test_cone), cmocka_unit_test(test_frustum),
        cmocka_unit_test(test_box),      cmocka_unit_test(test_ring), cmocka_unit_test(device_kit_silent),
    };
    return cmocka_run_group_tests_name("forms", tests, device_kit_setup, device_kit_teardown);
}
