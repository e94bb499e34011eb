// What of a scene asks for double precision: the features that are measured, and those that are not.
#include "flat_kit.h"
#include "random.h"
#include "tracer/flatten/precision_internal.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void measure(struct kit *kit, struct precision_report *report) {
    kit_resolve(kit);
    const struct flat_input input = {.scene = &kit->resolved,
                                     .view = &kit->view,
                                     .origin = kit->origin,
                                     .limits = &kit->limits,
                                     .sink = &kit->sink};
    assert_true(precision_measure(&input, report));
}

static void put_sphere(struct kit *kit, vec3 center, double radius) {
    struct ir_sphere *sphere = kit_sphere(kit);
    sphere->center = center;
    sphere->radius = radius;
}

static void put_rectangle(struct kit *kit, vec3 corner, vec3 u, vec3 v) {
    struct ir_rectangle *r = kit_rectangle(kit);
    r->corner = corner;
    r->edge_u = u;
    r->edge_v = v;
}

static double steps_of(double length, double distance) {
    return length / (distance * 0x1p-24);
}

static void expect_near(double got, double wanted) {
    if (!(fabs(got - wanted) <= 1e-9 * fabs(wanted)))
        fail_msg("%.17g is not %.17g", got, wanted);
}

static void test_nothing(void **state) {
    (void)state;
    struct kit kit;
    struct precision_report report;
    kit_init(&kit);
    measure(&kit, &report);
    assert_true(report.suffices && report.all_pairs);
    for (int i = 0; i < PRECISION_FEATURES; i++)
        assert_false(report.least[i].any);
    kit_finish(&kit);
}

// A sphere is enough where a hundredth of its radius has 16 steps: at 4096 radii, not at 16384.
static void test_sphere(void **state) {
    (void)state;
    for (int far = 0; far < 2; far++) {
        struct kit kit;
        struct precision_report report;
        kit_init(&kit);
        kit.origin = (vec3){1, 2, 3};
        const double distance = far ? 32768 : 8192;
        put_sphere(&kit, (vec3){1 + distance, 2, 3}, 2);
        measure(&kit, &report);
        const struct precision_measure *size = &report.least[PRECISION_SIZE];
        assert_true(size->any && size->body == 0 && report.decides == PRECISION_SIZE);
        expect_near(size->distance, distance + 2);
        expect_near(size->steps, steps_of(2 * PRECISION_SPHERE_PART, distance + 2));
        assert_int_equal(report.suffices, !far);
        kit_finish(&kit);
    }
}

// The shortest edge of all meshes, named by body and triangle.
static void test_edge(void **state) {
    (void)state;
    static const vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1e-7, 0, 1}};
    static const uint32_t faces[][3] = {{0, 1, 2}, {0, 0, 1}, {0, 3, 4}};
    for (int fine = 0; fine < 2; fine++) {
        struct kit kit;
        struct precision_report report;
        kit_init(&kit);
        put_sphere(&kit, (vec3){0, 5, 0}, 1);
        kit_model(&kit, kit_mesh(&kit, positions, 5, faces, fine ? 3 : 2, false))->translation =
            (vec3){0, 0, -4};
        measure(&kit, &report);
        const struct precision_measure *edge = &report.least[PRECISION_EDGE];
        assert_true(edge->any && edge->body == 1);
        // The triangle without area has an edge of no length, which does not count.
        assert_int_equal(edge->triangle, fine ? 2 : 0);
        expect_near(edge->length, fine ? 1e-7 : 1);
        expect_near(edge->distance, 4);
        assert_int_equal(report.suffices, !fine);
        kit_finish(&kit);
    }
}

// A model may have gaps of 1e-4 of its size: 16 steps at a hundred sizes.
static void test_model_size(void **state) {
    (void)state;
    for (int far = 0; far < 2; far++) {
        struct kit kit;
        struct precision_report report;
        kit_init(&kit);
        kit_model(&kit, kit_icosphere(&kit, 1, 0));
        kit.origin = (vec3){0, 0, 3.4 * (far ? 110 : 100)}; // the box's diagonal is 2 sqrt 3 at most
        measure(&kit, &report);
        assert_int_equal(report.suffices, !far);
        assert_int_equal(report.decides, PRECISION_SIZE);
        kit_finish(&kit);
    }
}

static bool gap_suffices(struct kit *kit, double gap) {
    struct precision_report report;
    measure(kit, &report);
    if (gap > 0) {
        assert_true(report.least[PRECISION_GAP].any);
        assert_true(fabs(report.least[PRECISION_GAP].length - gap) < 1e-3 * gap);
    } else {
        assert_false(report.least[PRECISION_GAP].any);
    }
    kit_finish(kit);
    return report.suffices;
}

static bool plates(double gap) {
    struct kit kit;
    kit_init(&kit);
    put_rectangle(&kit, (vec3){-0.5, 0, -2}, (vec3){1, 0.5, 0}, (vec3){0.5, 1, 0.25});
    const struct ir_rectangle *first = &kit.scene.rectangles.items[0];
    const vec3 normal = vec3_unit(vec3_cross(first->edge_u, first->edge_v));
    put_rectangle(&kit, vec3_add(first->corner, vec3_mul(normal, gap)), first->edge_v, first->edge_u);
    return gap_suffices(&kit, gap);
}

static bool shells(double gap) {
    struct kit kit;
    kit_init(&kit);
    put_sphere(&kit, (vec3){0, 0, -3}, 1);
    put_sphere(&kit, (vec3){0, 0, -3}, 1 + gap);
    return gap_suffices(&kit, gap);
}

static bool ball_on_floor(double gap) {
    struct kit kit;
    kit_init(&kit);
    put_rectangle(&kit, (vec3){-5, -1, 0}, (vec3){10, 0, 0}, (vec3){0, 0, -10});
    put_sphere(&kit, (vec3){0, -0.5 + gap, -3}, 0.5);
    return gap_suffices(&kit, gap);
}

// A model's box is as low as its lowest vertex.
static bool box_on_floor(double gap) {
    static const vec3 positions[] = {{0, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 1, 1}};
    static const uint32_t faces[][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    struct kit kit;
    kit_init(&kit);
    put_rectangle(&kit, (vec3){-5, -1, 0}, (vec3){10, 0, 0}, (vec3){0, 0, -10});
    kit_model(&kit, kit_mesh(&kit, positions, 4, faces, 4, true))->translation = (vec3){0, -1 + gap, -3};
    return gap_suffices(&kit, gap);
}

// A rectangle tilted by 45 degrees and a sphere above a place of it, whose boxes overlap: only their shapes
// tell how close they are. (`s`, `t`): where, along the edges.
static bool ball_on_slope(double s, double t, double gap, double seen) {
    struct kit kit;
    kit_init(&kit);
    const vec3 corner = {0, 0, -4}, u = {1, 0, 1}, v = {0, 1, 0};
    put_rectangle(&kit, corner, u, v);
    const vec3 foot = vec3_add(corner, vec3_add(vec3_mul(u, s), vec3_mul(v, t)));
    put_sphere(&kit, vec3_add(foot, (vec3){-0.5, 0, 0.5}), sqrt(0.5) - gap);
    return gap_suffices(&kit, seen);
}

// Two such rectangles, one above the other and `s` and `t` edges aside; their boxes overlap too.
static bool slopes(double s, double t, double seen) {
    struct kit kit;
    kit_init(&kit);
    const vec3 corner = {0, 0, -4}, u = {1, 0, 1}, v = {0, 1, 0};
    put_rectangle(&kit, corner, u, v);
    const vec3 aside = vec3_add(corner, vec3_add(vec3_mul(u, s), vec3_mul(v, t)));
    put_rectangle(&kit, vec3_add(aside, (vec3){-0x1p-14, 0, 0x1p-14}), u, v);
    return gap_suffices(&kit, seen);
}

// What faces a rectangle at its edge, or past it, is as close as the shapes or the boxes say.
static void test_slope(void **state) {
    (void)state;
    static const double edges[4][2] = {{0, 0.5}, {1, 0.5}, {0.5, 0}, {0.5, 1}};
    for (int i = 0; i < 4; i++) {
        const double s = edges[i][0], t = edges[i][1];
        assert_true(ball_on_slope(s, t, 1e-4, 1e-4));
        assert_false(ball_on_slope(s, t, 1e-7, 1e-7));
        const double out = 0x1p-20;
        assert_true(
            ball_on_slope(s + (s == 1) * out - (s == 0) * out, t + (t == 1) * out - (t == 0) * out, 1e-7, 0));
        // Side by side they face each other nowhere: it is the boxes that are apart, or touch.
        const double along = s == 0.5 ? 0 : 2 * s - 1, up = t == 0.5 ? 0 : 2 * t - 1;
        assert_true(slopes(along, up, s == 0.5 ? 0 : 0x1p-14));
        assert_true(slopes(0.99 * along, 0.99 * up, sqrt(2) * 0x1p-14));
    }
}

// Boxes apart by a length that a float does not hold.
static void test_box_gap(void **state) {
    (void)state;
    static const vec3 positions[] = {{0, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 1, 1}};
    static const uint32_t faces[][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    struct kit kit;
    struct precision_report report;
    kit_init(&kit);
    for (int i = 0; i < 2; i++)
        kit_model(&kit, kit_mesh(&kit, positions, 4, faces, 4, true))->translation =
            (vec3){0, -4 + i * (1 + 0x1p-13 + 0x1p-40), -3};
    measure(&kit, &report);
    assert_true(report.least[PRECISION_GAP].length == 0x1p-13 + 0x1p-40);
    kit_finish(&kit);
}

// A million units away a floor at 0.1 and a ball of radius 0.3 at 0.4 are 10^-10 apart, or not.
static bool far_ball_on_floor(void) {
    struct kit kit;
    kit_init(&kit);
    kit.origin = kit.view.camera.position = (vec3){1e6, 1e6 + 2.3, 1e6};
    put_rectangle(&kit, (vec3){1e6 - 5, 1e6 + 0.1, 1e6}, (vec3){10, 0, 0}, (vec3){0, 0, -10});
    put_sphere(&kit, (vec3){1e6, 1e6 + 0.4, 1e6 - 3}, 0.3);
    return gap_suffices(&kit, 0);
}

// Two floors 2^-31 apart, all numbers exact, in a scene moved up by `move`.
static bool is_moved_gap_seen(double move) {
    struct kit kit;
    struct precision_report report;
    kit_init(&kit);
    kit.origin = kit.view.camera.position = (vec3){0, move, 0};
    put_rectangle(&kit, (vec3){-1, move - 1, -1}, (vec3){2, 0, 0}, (vec3){0, 0, -2});
    put_rectangle(&kit, (vec3){-1, move - 1 + 0x1p-31, -1}, (vec3){2, 0, 0}, (vec3){0, 0, -2});
    measure(&kit, &report);
    kit_finish(&kit);
    return report.least[PRECISION_GAP].any && report.least[PRECISION_GAP].length == 0x1p-31 &&
           !report.suffices;
}

// A move that rounds nothing keeps the verdict, until the gap is what rounding leaves there.
static void test_moved_gap(void **state) {
    (void)state;
    assert_true(is_moved_gap_seen(0) && is_moved_gap_seen(0x1p10) && is_moved_gap_seen(0x1p18));
    assert_false(is_moved_gap_seen(0x1p20));
}

static void test_gap(void **state) {
    (void)state;
    // 16 steps at a distance of about 3 are 2.9e-6.
    assert_true(plates(1e-4) && shells(1e-4) && ball_on_floor(1e-4) && box_on_floor(1e-4));
    assert_false(plates(1e-7) || shells(1e-7) || ball_on_floor(1e-7) || box_on_floor(1e-7));
    // What touches has no gap; nor what the program's own arithmetic tears apart.
    assert_true(plates(0) && shells(0) && ball_on_floor(0) && box_on_floor(0));
    assert_true(far_ball_on_floor());
}

// The camera above a plane: fine at 2^13 times its height, not at 10^6.
static void test_height(void **state) {
    (void)state;
    for (int large = 0; large < 2; large++) {
        struct kit kit;
        struct precision_report report;
        const double half = large ? 5e5 : 0x1p12;
        kit_init(&kit);
        put_rectangle(&kit, (vec3){-half, -1, half}, (vec3){2 * half, 0, 0}, (vec3){0, 0, -2 * half});
        measure(&kit, &report);
        const struct precision_measure *height = &report.least[PRECISION_HEIGHT];
        assert_true(height->any && height->body == 0);
        expect_near(height->length, 1);
        assert_int_equal(report.suffices, !large);
        // From beside it is only far away.
        kit.origin = kit.view.camera.position = (vec3){3 * half, 0, 0};
        measure(&kit, &report);
        assert_false(report.least[PRECISION_HEIGHT].any);
        kit_finish(&kit);
    }
}

static double component_of(int axis, int wanted) {
    return axis == wanted;
}

// A plane across any axis, and a camera one unit above it that is `past` a side of it along another.
static bool is_seen_from_above(int axis, int side, double past) {
    struct kit kit;
    struct precision_report report;
    kit_init(&kit);
    const int other = 3 - axis - side % 3;
    const vec3 across = {component_of(axis, 0), component_of(axis, 1), component_of(axis, 2)};
    const vec3 u = {component_of(side % 3, 0), component_of(side % 3, 1), component_of(side % 3, 2)};
    const vec3 v = {component_of(other, 0), component_of(other, 1), component_of(other, 2)};
    put_rectangle(&kit, vec3_mul(vec3_add(u, v), -8), vec3_mul(u, 16), vec3_mul(v, 16));
    const double along = (side < 3 ? 1 : -1) * (8 + past);
    kit.origin = kit.view.camera.position = vec3_add(across, vec3_mul(u, along));
    measure(&kit, &report);
    kit_finish(&kit);
    return report.least[PRECISION_HEIGHT].any;
}

// A camera is above a plane as far as it is high past its sides, and no farther.
static void test_above(void **state) {
    (void)state;
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 6; side++)
            if (side % 3 != axis) {
                assert_true(is_seen_from_above(axis, side, 0.5));
                assert_false(is_seen_from_above(axis, side, 1.5));
            }
}

// Too many bodies in one place: the search ends, and says so.
static void test_crowd(void **state) {
    (void)state;
    enum {
        COUNT = 4000
    };
    struct kit kit;
    struct precision_report report;
    kit_init(&kit);
    struct ir_sphere *spheres = ARENA_ARRAY(&kit.arena, struct ir_sphere, COUNT);
    for (int i = 0; i < COUNT; i++) {
        spheres[i].center = (vec3){0.001 * (i % 20), 0.001 * (i / 20 % 20), -3 + 0.001 * (i / 400)};
        spheres[i].radius = 1;
    }
    kit.scene.spheres.items = spheres;
    kit.scene.spheres.count = COUNT;
    measure(&kit, &report);
    assert_false(report.all_pairs);
    kit.scene.spheres.count = 100;
    measure(&kit, &report);
    assert_true(report.all_pairs);
    kit_finish(&kit);
}

// ---- meshes of several models

static struct mesh *ball(struct kit *kit) {
    struct mesh *mesh = kit_icosphere(kit, 3, 0);
    mesh->lower = (vec3){-1, -1, -1};
    mesh->upper = (vec3){1, 1, 1};
    return mesh;
}

// So many balls around the camera, each turned, stretched and elsewhere: of one mesh, or each of its own.
static void measure_balls(bool shared, uint64_t seed, struct precision_report *report) {
    struct kit kit;
    uint64_t random = seed;
    kit_init(&kit);
    struct mesh *one = ball(&kit);
    for (int i = 0; i < KIT_MAX; i++) {
        struct ir_model *model = kit_model(&kit, shared ? one : ball(&kit));
        const double size = exp2(4 * random_unit(&random) - 2), far = exp2(3 * random_unit(&random));
        model->scale = (vec3){size, -size, size * (1 + random_unit(&random))};
        model->rotation = vec3_mul(random_direction(&random), 90);
        model->translation = vec3_mul(random_direction(&random), 6 * far);
    }
    kit.origin = (vec3){0.5, 0, 0};
    measure(&kit, report);
    kit_finish(&kit);
}

// What a mesh was measured at in one body says of another which triangles need no look, and changes nothing.
static void test_shared_meshes(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        struct precision_report own, shared;
        memset(&own, 0, sizeof own);
        memset(&shared, 0, sizeof shared);
        measure_balls(false, seed, &own);
        measure_balls(true, seed, &shared);
        for (int kind = 0; kind < PRECISION_FEATURES; kind++) {
            const struct precision_measure *a = &own.least[kind], *b = &shared.least[kind];
            assert_true(a->any == b->any && a->length == b->length && a->steps == b->steps);
            assert_true(a->body == b->body && a->other == b->other && a->triangle == b->triangle);
        }
        assert_true(own.least[PRECISION_EDGE].any && own.least[PRECISION_HEIGHT].any);
    }
}

static void test_pieces(void **state) {
    (void)state;
    struct kit kit;
    kit_init(&kit);
    struct mesh *mesh = ball(&kit);
    struct precision_pieces pieces;
    assert_true(precision_pieces_make(mesh, &pieces));
    assert_int_equal(pieces.count, mesh->triangle_count / PRECISION_PIECE);
    const struct flat_input input = {.view = &kit.view, .origin = kit.origin};
    const affine3 map = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {100, 0, 0}};
    const struct precision_view view = precision_view_of(&input, &map, mesh);
    struct precision_report found = {0};
    assert_false(precision_is_beyond(&view, &pieces.whole, &found));
    precision_note(&found.least[PRECISION_EDGE],
                   (struct precision_measure){.length = 1e-3, .part = 1, .distance = 100});
    precision_note(&found.least[PRECISION_HEIGHT],
                   (struct precision_measure){.length = 1, .part = PRECISION_HEIGHT_PART, .distance = 1});
    assert_true(precision_is_beyond(&view, &pieces.whole, &found));
    // An edge as long as the mesh's shortest, no farther away.
    found.least[PRECISION_EDGE].any = false;
    precision_note(&found.least[PRECISION_EDGE],
                   (struct precision_measure){.length = pieces.whole.shortest, .part = 1, .distance = 100});
    assert_false(precision_is_beyond(&view, &pieces.whole, &found));
    precision_pieces_finish(&pieces);
    kit_finish(&kit);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shared_meshes), cmocka_unit_test(test_pieces),
        cmocka_unit_test(test_nothing),       cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_edge),          cmocka_unit_test(test_model_size),
        cmocka_unit_test(test_gap),           cmocka_unit_test(test_moved_gap),
        cmocka_unit_test(test_height),        cmocka_unit_test(test_crowd),
        cmocka_unit_test(test_slope),         cmocka_unit_test(test_box_gap),
        cmocka_unit_test(test_above),
    };
    return cmocka_run_group_tests_name("precision", tests, NULL, NULL);
}
