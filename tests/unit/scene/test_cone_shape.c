// What scene/shape.h says of cylinders and cones, against their definition: 100 000 lines and places.
#include "core/splitmix.h"
#include "scene/shape.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum {
    COUNT = 100000
};
#define PI 3.14159265358979323846

static double between(uint64_t *state, double low, double high) {
    return low + (high - low) * (double)(splitmix_next(state) >> 11) * 0x1p-53;
}

static vec3 any_vector(uint64_t *state, double size) {
    const double x = between(state, -size, size), y = between(state, -size, size);
    return (vec3){x, y, between(state, -size, size)};
}

// Sizes and ratios over six powers of ten; one in four a cylinder, one in four with a tip.
static struct scene_body any_cone(uint64_t *state) {
    const double size = pow(10, between(state, -3, 3));
    const vec3 axis = any_vector(state, 1), from = any_vector(state, 3 * size);
    const uint64_t kind = splitmix_next(state) % 4;
    struct scene_body body = {
        .shape = SCENE_CONE, .closed = true, .height = size * pow(10, between(state, -3, 3))};
    const double radius = size * between(state, 0.1, 1);
    body.radius_to = kind == 0 ? radius : kind == 1 ? 0 : size * between(state, 0.1, 1);
    scene_body_place(&body, (affine3){scene_cone_frame(axis), from}, radius);
    return body;
}

// The largest of the three conditions of its inside, each as a length.
static double outside(const struct scene_body *body, vec3 point) {
    const vec3 p = shape_into_frame(body, vec3_sub(point, body->object_to_world.offset));
    const double slope = (body->radius_to - body->radius) / body->height;
    const double side = (hypot(p.x, p.z) - body->radius - slope * p.y) / hypot(1, slope);
    return fmax(side, fmax(-p.y, p.y - body->height));
}

static double reach_of(const struct scene_body *body, vec3 point) {
    return vec3_max_abs(point) + vec3_max_abs(body->lower) + vec3_max_abs(body->upper);
}

static void frames_are_rotations(void **state) {
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < COUNT; i++) {
        const vec3 axis = any_vector(&seed, 1);
        const mat3 frame = scene_cone_frame(axis);
        assert_true(fabs(mat3_determinant(frame) - 1) < 1e-14);
        assert_true(vec3_length(vec3_sub(mat3_column(frame, 1), vec3_unit(axis))) < 1e-14);
    }
    const mat3 upright = scene_cone_frame((vec3){0, 2, 0});
    for (int k = 0; k < 9; k++)
        assert_true(upright.m[k / 3][k % 3] == (k % 4 == 0));
}

// Whether the line crosses the body; its ends inside it are on the surface, and what is between them is not
// outside.
static bool crosses_where_it_should(const struct scene_body *body, vec3 from, vec3 d) {
    const struct shape_cone cone = shape_cone_of(body);
    const double size = body->height + body->radius + body->radius_to;
    const double slack = 64 * 0x1p-53 * (reach_of(body, from) + 5 * size);
    double t[2];
    bool side[2];
    if (!shape_cone_crossing(&cone, from, d, t, side)) { // nowhere deep inside
        for (int k = 0; k <= 20; k++)
            assert_true(outside(body, vec3_add(from, vec3_mul(d, k * 0.5))) > -slack);
        return false;
    }
    assert_true(t[0] <= t[1]);
    for (int k = 0; k < 2; k++)
        assert_true(fabs(outside(body, vec3_add(from, vec3_mul(d, t[k])))) <= slack);
    assert_true(outside(body, vec3_add(from, vec3_mul(d, (t[0] + t[1]) / 2))) <= slack);
    return true;
}

static void lines_run_inside_where_they_should(void **state) {
    (void)state;
    uint64_t seed = 2;
    uint32_t found = 0;
    for (int i = 0; i < COUNT; i++) {
        const struct scene_body body = any_cone(&seed);
        const double size = body.height + body.radius + body.radius_to;
        const vec3 to = vec3_add(shape_middle(&body), any_vector(&seed, size / 2));
        const vec3 from = vec3_add(to, any_vector(&seed, 5 * size));
        const vec3 d = vec3_mul(vec3_sub(to, from), between(&seed, 0.1, 3));
        found += crosses_where_it_should(&body, from, d);
    }
    assert_in_range(found, COUNT / 4, COUNT);
}

// Nearly across the axis, to the last bit of a direction and beyond; half of the lines go through the axis.
static void lines_run_across(void **state) {
    (void)state;
    uint64_t seed = 4;
    for (int i = 0; i < COUNT; i++) {
        const struct scene_body body = any_cone(&seed);
        const double y = body.height * between(&seed, 0.1, 0.9), turn = between(&seed, 0, 2 * PI);
        const double r = body.radius + (body.radius_to - body.radius) * (y / body.height);
        const double off = i % 2 ? r * between(&seed, 0, 0.9) : 0;
        const double tilt = i % 16 ? pow(10, between(&seed, -20, -2)) : 0;
        const vec3 to = {-off * sin(turn), y, off * cos(turn)}, d = {cos(turn), tilt, sin(turn)};
        const vec3 from = vec3_sub(to, vec3_mul(d, r * between(&seed, -0.1, 3)));
        assert_true(crosses_where_it_should(&body, affine3_apply(body.object_to_world, from),
                                            mat3_apply(body.object_to_world.linear, d)));
    }
}

static void distances_are_those_to_the_surface(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < COUNT; i++) {
        const struct scene_body body = any_cone(&seed);
        const struct shape_cone cone = shape_cone_of(&body);
        const double size = body.height + body.radius + body.radius_to;
        const vec3 point = vec3_add(shape_middle(&body), any_vector(&seed, size));
        const double distance = shape_cone_distance(&cone, point), deep = outside(&body, point);
        const double slack = 64 * 0x1p-53 * (reach_of(&body, point) + size);
        // Inside the nearest face is the surface's nearest place; outside no face is farther.
        assert_true(deep < 0 ? fabs(distance - deep) <= slack : distance >= deep - slack);
        // No place of the surface is nearer.
        const double y = between(&seed, 0, body.height), turn = between(&seed, 0, 2 * PI);
        const double r = body.radius + (body.radius_to - body.radius) * (y / body.height);
        const vec3 on = affine3_apply(body.object_to_world, (vec3){r * cos(turn), y, r * sin(turn)});
        assert_true(vec3_length(vec3_sub(on, point)) >= fabs(distance) - slack);
        assert_true(on.x >= body.lower.x - slack && on.x <= body.upper.x + slack);
        assert_true(on.y >= body.lower.y - slack && on.y <= body.upper.y + slack);
        assert_true(on.z >= body.lower.z - slack && on.z <= body.upper.z + slack);
    }
}

// A cylinder's, a whole cone's, and that of a cone from which the tip is cut off.
static void volumes_are_known(void **state) {
    (void)state;
    struct scene_body body = {.shape = SCENE_CONE, .radius = 2, .radius_to = 2, .height = 3};
    assert_true(fabs(shape_volume(&body) - 12 * PI) < 1e-12);
    body.radius_to = 0;
    assert_true(fabs(shape_volume(&body) - 4 * PI) < 1e-12);
    const double whole = shape_volume(&body);
    body.radius_to = 1;
    body.height = 1.5;
    assert_true(fabs(shape_volume(&body) - whole * 7 / 8) < 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_are_rotations), cmocka_unit_test(lines_run_inside_where_they_should),
        cmocka_unit_test(lines_run_across),     cmocka_unit_test(distances_are_those_to_the_surface),
        cmocka_unit_test(volumes_are_known),
    };
    return cmocka_run_group_tests_name("cone_shape", tests, NULL, NULL);
}
