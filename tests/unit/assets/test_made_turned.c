// Bodies of revolution: closed, of the volume that Pappus says, within their tolerance.
#include "made_kit.h"

#include "core/angle.h"

static struct made_kit kit;

static struct made_lathe lathe_of(const struct ir_pair *points, uint32_t count) {
    return (struct made_lathe){points, count, false, 360, MADE_TOLERANCE};
}

// The exact volume of a turned polygon: 2 pi times the sum over its edges of the moment of area.
static double moment(const struct ir_pair *p, uint32_t count) {
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct ir_pair a = p[i], b = p[(i + 1) % count];
        sum += (a.u * b.v - b.u * a.v) * (a.u + b.u) / 6;
    }
    return fabs(sum);
}

static void assert_near(double value, double expected, double share) {
    if (!(fabs(value - expected) <= share * fabs(expected)))
        fail_msg("%.17g, expected %.17g within %g", value, expected, share);
}

static void test_cone(void **state) {
    (void)state;
    const struct ir_pair cone[] = {{0, 0}, {1, 0}, {0, 2}};
    made_kit_closed(&kit, made_kit_lathe(&kit, lathe_of(cone, 3)));
    assert_near(kit.mesh.volume, PI * 2 / 3, 2e-3);
    assert_true(kit.mesh.volume < PI * 2 / 3);
    assert_true(made_kit_worst_normal(&kit.mesh) > 0.99);
    const struct ir_pair back[] = {{0, 2}, {1, 0}, {0, 0}};
    made_kit_closed(&kit, made_kit_lathe(&kit, lathe_of(back, 3)));
    assert_true(made_kit_worst_normal(&kit.mesh) > 0.99);
    const struct ir_pair loop[] = {{0, 0}, {1, 0}, {0, 2}, {0, 0}};
    for (double angle = 30; angle <= 360; angle += 30) {
        struct made_lathe lathe = lathe_of(loop, 4);
        lathe.angle = angle;
        lathe.tolerance = 1e-5;
        made_kit_closed(&kit, made_kit_lathe(&kit, lathe));
        assert_near(kit.mesh.volume, PI * 2 / 3 * angle / 360, 1e-4);
    }
}

static void test_open(void **state) {
    (void)state;
    const struct ir_pair tube[] = {{1, 0}, {1, 2}};
    made_kit_mesh(&kit, made_kit_lathe(&kit, lathe_of(tube, 2)));
    assert_false(kit.mesh.closed);
    assert_near(made_kit_surface(&kit.mesh), 4 * PI, 2e-3);
    assert_true(made_kit_worst_normal(&kit.mesh) > 0.99);
    struct made_lathe half = lathe_of(tube, 2);
    half.angle = 180;
    made_kit_mesh(&kit, made_kit_lathe(&kit, half));
    assert_near(made_kit_surface(&kit.mesh), 2 * PI, 2e-3);
}

static void test_touches_axis_within(void **state) {
    (void)state;
    const struct ir_pair glass[] = {{0, -1}, {1, -1}, {0, 0}, {1, 1}, {0, 1}};
    const struct ir_pair two[] = {{0, -1}, {1, -1}, {0, -0.5}, {0, 0.5}, {1, 1}, {0, 1}};
    for (double angle = 90; angle <= 360; angle += 90) {
        struct made_lathe lathe = lathe_of(glass, 5);
        lathe.angle = angle;
        made_kit_closed(&kit, made_kit_lathe(&kit, lathe));
        assert_near(kit.mesh.volume, PI * 2 / 3 * angle / 360, 4e-3);
        lathe = lathe_of(two, 6);
        lathe.angle = angle;
        made_kit_closed(&kit, made_kit_lathe(&kit, lathe));
        assert_near(kit.mesh.volume, PI / 3 * angle / 360, 4e-3);
    }
}

// A profile without crossings: heights that only grow, then down again inside for rings.
static uint32_t random_profile(uint64_t *state, struct ir_pair *points, bool ring) {
    const uint32_t count = 2 + (uint32_t)(random_bits(state) % 30);
    double y = random_unit(state) - 0.5;
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++, y += 0.01 + random_unit(state))
        points[n++] = (struct ir_pair){1 + random_unit(state), y};
    if (!ring) {
        points[0].u = points[count - 1].u = 0;
        return n == 2 ? points[n++] = points[1],
                        points[1] = (struct ir_pair){1, (points[0].v + points[2].v) / 2}, n : n;
    }
    for (uint32_t i = count; i-- > 0;)
        points[n++] = (struct ir_pair){0.9 * random_unit(state), points[i].v + 0.001};
    points[n] = points[0];
    return n + 1;
}

static void test_random_profiles(void **state) {
    (void)state;
    uint64_t random = 1;
    for (int i = 0; i < 3000; i++) {
        struct ir_pair points[80];
        const bool ring = i % 2;
        const uint32_t count = random_profile(&random, points, ring);
        struct made_lathe lathe = lathe_of(points, count);
        lathe.angle = i % 3 ? 1 + 359 * random_unit(&random) : 360;
        lathe.tolerance = i % 100 ? 5e-2 : 1e-3;
        made_kit_closed(&kit, made_kit_lathe(&kit, lathe));
        assert_near(kit.mesh.volume, 2 * PI * moment(points, ring ? count - 1 : count) * lathe.angle / 360,
                    5 * lathe.tolerance);
        lathe.smooth = true;
        const bool done = made_kit_lathe(&kit, lathe);
        if (done)
            made_kit_closed(&kit, true);
        else if (kit.made.fault.code != MADE_CURVE && kit.made.fault.code != MADE_CROSSES &&
                 kit.made.fault.code != MADE_TOUCHES)
            fail_msg("%s", kit.made.fault.text);
    }
}

// ---- how far the surface is from the true one

// Of a triangle's point from a torus.
static double torus_distance(vec3 p, double radius, double tube) {
    const double around = hypot(p.x, p.z) - radius;
    return fabs(hypot(around, p.y) - tube);
}

static void test_torus(void **state) {
    (void)state;
    double error_before = INFINITY;
    for (double tolerance = 0.1; tolerance > 1e-4; tolerance /= 4) {
        const struct made_torus torus = {3, 1, tolerance};
        made_kit_closed(&kit, made_kit_torus(&kit, torus));
        double worst = 0;
        for (uint32_t t = 0; t < kit.mesh.triangle_count; t++)
            for (int a = 0; a <= 4; a++)
                for (int b = 0; a + b <= 4; b++) {
                    vec3 p = vec3_mul(made_kit_corner(&kit.mesh, t, 0), a / 4.0);
                    p = vec3_add(p, vec3_mul(made_kit_corner(&kit.mesh, t, 1), b / 4.0));
                    p = vec3_add(p, vec3_mul(made_kit_corner(&kit.mesh, t, 2), (4 - a - b) / 4.0));
                    worst = fmax(worst, torus_distance(p, 3, 1));
                }
        assert_true(worst <= tolerance * 4);
        const double error = fabs(kit.mesh.volume - 2 * PI * PI * 3);
        printf("torus: tolerance %-8g %7u triangles, farthest %.3g of %.3g, volume off by %.3g\n", tolerance,
               kit.mesh.triangle_count, worst, tolerance * 4, error / (2 * PI * PI * 3));
        assert_true(error < error_before);
        error_before = error;
        assert_true(made_kit_worst_normal(&kit.mesh) > 1 - 12 * tolerance);
    }
    assert_near(kit.mesh.volume, 2 * PI * PI * 3, 2e-3);
    assert_near(made_kit_surface(&kit.mesh), 4 * PI * PI * 3, 2e-3);
    made_kit_closed(&kit, made_kit_torus(&kit, (struct made_torus){1, 1, 1e-3}));
    assert_near(kit.mesh.volume, 2 * PI * PI, 4e-3);
}

// Of tori from thin to without a hole: what the tolerance leaves out of area and volume, to first order. A
// chord that is at most `share` of the radius inside a circle is shorter than its arc by share / 3, and a
// polygon of such chords smaller than the circle by 4 / 3 of it; faces between two circles are also less
// steep by up to the share around the axis, where they slope, which is half of it in the mean.
static void test_torus_measures(void **state) {
    (void)state;
    double worst = 0;
    for (double tube = 0.01; tube <= 1; tube *= 1.7782794100389228)
        for (double tolerance = 1e-2; tolerance > 1e-5; tolerance /= 10) {
            made_kit_closed(&kit, made_kit_torus(&kit, (struct made_torus){1, tube, tolerance}));
            const double around = tolerance / 2, share = around + tolerance / 2 * (1 + tube) / tube;
            const double area = made_kit_surface(&kit.mesh) / (4 * PI * PI * tube) - 1;
            const double volume = kit.mesh.volume / (2 * PI * PI * tube * tube) - 1;
            if (!(area <= 0 && area >= -share / 3 - around / 2 && volume <= 0 && volume >= -4 * share / 3))
                fail_msg("tube %g, tolerance %g: area off by %g, volume by %g, share %g", tube, tolerance,
                         area, volume, share);
            worst = fmin(worst, tolerance > 5e-4 && tolerance < 5e-3 ? area : 0);
        }
    printf("torus: area off by %.3g at most with the default tolerance\n", worst);
}

// At each corner that of the true surface there, whatever the facets.
static void test_torus_normals(void **state) {
    (void)state;
    for (double tube = 0.02; tube <= 2; tube *= 10)
        for (double tolerance = 1e-1; tolerance > 1e-4; tolerance /= 10) {
            made_kit_closed(&kit, made_kit_torus(&kit, (struct made_torus){2, tube, tolerance}));
            double worst = 0;
            for (uint32_t t = 0; t < kit.mesh.triangle_count; t++)
                for (int k = 0; k < 3; k++) {
                    const vec3 at = made_kit_corner(&kit.mesh, t, k);
                    const double away = hypot(at.x, at.z), part = (away - 2) / tube;
                    const vec3 normal = {at.x / away * part, at.y / tube, at.z / away * part};
                    if (away > 1e-6) // on the axis a torus without a hole has two
                        worst = fmax(worst, vec3_length(vec3_sub(
                                                kit.mesh.normals[kit.mesh.triangles[t].normals[k]], normal)));
                }
            if (!(worst < 1e-13))
                fail_msg("tube %g, tolerance %g: a normal is off by %g", tube, tolerance, worst);
        }
}

// A frustum of so many sides: facets and all in closed form, and as near to the round one as its tolerance
// says.
static void test_frustum(void **state) {
    (void)state;
    const double low = 1.5, high = 0.6, height = 2, slant = hypot(height, low - high);
    const struct ir_pair points[] = {{0, -1}, {low, -1}, {high, -1 + height}, {0, -1 + height}};
    const double round_area = PI * (low * low + high * high + (low + high) * slant);
    const double round_volume = PI / 3 * height * (low * low + low * high + high * high);
    for (double tolerance = 1e-1; tolerance > 1e-6; tolerance /= 10) {
        struct made_lathe lathe = lathe_of(points, 4);
        lathe.tolerance = tolerance;
        made_kit_closed(&kit, made_kit_lathe(&kit, lathe));
        const double sides = kit.mesh.triangle_count / 4, half = PI / sides;
        assert_int_equal(kit.mesh.triangle_count % 4, 0); // two of the side and one of each end
        const double sector = sin(half) * cos(half), pitch = hypot(height, (low - high) * cos(half));
        const double area = sides * (sector * (low * low + high * high) + sin(half) * (low + high) * pitch);
        assert_near(made_kit_surface(&kit.mesh), area, 1e-13);
        assert_near(kit.mesh.volume, sides * sector * round_volume / PI, 1e-13);
        assert_near(area, round_area, 4 * tolerance / 3);
        assert_near(kit.mesh.volume, round_volume, 4 * tolerance / 3);
        for (uint32_t t = 0; t < kit.mesh.triangle_count; t++)
            for (int k = 0; k < 3; k++) {
                const vec3 at = made_kit_corner(&kit.mesh, t, k), face = made_kit_area(&kit.mesh, t),
                           normal = kit.mesh.normals[kit.mesh.triangles[t].normals[k]];
                const double away = hypot(at.x, at.z), ring = height / slant;
                const bool is_end = face.x == 0 && face.z == 0;
                const vec3 expected =
                    is_end ? (vec3){0, at.y < 0 ? -1 : 1, 0}
                           : (vec3){ring * at.x / away, (low - high) / slant, ring * at.z / away};
                assert_true(vec3_length(vec3_sub(normal, expected)) < 1e-14);
            }
    }
}

// A curve through points of a circle: poles are round and on the axis.
static void test_smooth(void **state) {
    (void)state;
    struct ir_pair points[65];
    for (int i = 0; i <= 64; i++) {
        const struct vec3_turn turn = vec3_turn_of(180.0 * i / 64);
        points[i] = (struct ir_pair){turn.sine, -turn.cosine};
    }
    struct made_lathe lathe = {points, 65, true, 360, 1e-3};
    made_kit_closed(&kit, made_kit_lathe(&kit, lathe));
    assert_near(kit.mesh.volume, 4 * PI / 3, 4e-3);
    double worst = 1;
    for (uint32_t t = 0; t < kit.mesh.triangle_count; t++)
        for (int k = 0; k < 3; k++)
            worst = fmin(worst, vec3_dot(kit.mesh.normals[kit.mesh.triangles[t].normals[k]],
                                         vec3_unit(made_kit_corner(&kit.mesh, t, k))));
    assert_true(worst > 1 - 1e-5);
    const struct ir_pair few[] = {{0, -1}, {1, 0}, {0, 1}};
    made_kit_closed(&kit, made_kit_lathe(&kit, (struct made_lathe){few, 3, true, 200, 1e-3}));
    const struct ir_pair pointed[] = {{0, -1}, {0, -1}, {1, 0}, {0, 1}, {0, 1}};
    made_kit_closed(&kit, made_kit_lathe(&kit, (struct made_lathe){pointed, 5, true, 360, 1e-3}));
}

// What is nearer to 0 than products of two coordinates can tell counts as 0.
static void test_tiny_numbers(void **state) {
    (void)state;
    const struct ir_pair cone[] = {{1e-300, 0}, {1, -1e-300}, {0, 2}};
    const struct ir_pair ring[] = {{24, 9.5}, {9.5, -1e-300}, {9.5, 0}, {24, 9.5}};
    const struct ir_pair axis[] = {{1e-300, 0}, {1e-200, 1}};
    made_kit_closed(&kit, made_kit_lathe(&kit, (struct made_lathe){cone, 3, false, 100, 1e-3}));
    made_kit_refused(&kit, made_kit_lathe(&kit, lathe_of(ring, 4)), MADE_POINTS_FEW);
    made_kit_refused(&kit, made_kit_lathe(&kit, lathe_of(axis, 2)), MADE_AXIS);
}

// ---- faults

static void test_faults(void **state) {
    (void)state;
    const struct ir_pair fine[] = {{0, 0}, {1, 0}, {0, 2}};
    const struct ir_pair negative[] = {{0, 0}, {1, 0}, {-1, 2}};
    const struct ir_pair axis[] = {{0, 0}, {0, 1}};
    const struct ir_pair same[] = {{1, 0}, {1, 0}};
    const struct ir_pair nan[] = {{0, 0}, {NAN, 0}, {0, 2}};
    const struct ir_pair crossing[] = {{0, 0}, {2, 0}, {2, 2}, {1, -1}, {0, 3}};
    const struct ir_pair touching[] = {{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 3}};
    const struct ir_pair meeting[] = {{0, 0}, {2, 0}, {2, 2}, {2, 0}, {0, 3}};
    const struct ir_pair overshoot[] = {{2, 0}, {0.05, 1}, {0.05, 1.5}, {2, 1.6}};
    made_kit_refused(&kit, made_kit_lathe(&kit, lathe_of(fine, 0)), MADE_POINTS_FEW);
    made_kit_refused(&kit, made_kit_lathe(&kit, lathe_of(same, 2)), MADE_POINTS_FEW);
    made_kit_refused(&kit, made_kit_lathe(&kit, lathe_of(negative, 3)), MADE_RADIUS);
    assert_int_equal(kit.made.fault.points[0], 2);
    made_kit_refused(&kit, made_kit_lathe(&kit, lathe_of(axis, 2)), MADE_AXIS);
    made_kit_refused(&kit, made_kit_lathe(&kit, lathe_of(nan, 3)), MADE_NUMBER);
    made_kit_refused(&kit, made_kit_lathe(&kit, lathe_of(crossing, 5)), MADE_CROSSES);
    assert_int_equal(kit.made.fault.points[0], 0);
    assert_true(kit.made.fault.place.v == 0);
    made_kit_refused(&kit, made_kit_lathe(&kit, lathe_of(touching, 5)), MADE_TOUCHES);
    assert_true(kit.made.fault.place.u == 1 && kit.made.fault.place.v == 0);
    made_kit_refused(&kit, made_kit_lathe(&kit, lathe_of(meeting, 5)), MADE_TOUCHES);
    assert_int_equal(kit.made.fault.points[0], 1);
    assert_int_equal(kit.made.fault.points[1], 3);
    made_kit_refused(&kit, made_kit_lathe(&kit, (struct made_lathe){overshoot, 4, true, 360, 1e-3}),
                     MADE_CURVE);
    for (int i = 0; i < 4; i++) {
        const double angles[] = {0, 361, NAN, 360}, tolerances[] = {1e-3, 1e-3, 1e-3, 0};
        const struct made_lathe lathe = {fine, 3, false, angles[i], tolerances[i]};
        made_kit_refused(&kit, made_kit_lathe(&kit, lathe), MADE_RANGE);
    }
    made_kit_refused(&kit, made_kit_torus(&kit, (struct made_torus){1, 1.5, 1e-3}), MADE_TUBE);
    made_kit_refused(&kit, made_kit_torus(&kit, (struct made_torus){0, 0, 1e-3}), MADE_RANGE);
    struct made_to to = made_kit_to(&kit);
    to.triangles_most = 0;
    const struct made_lathe lathe = lathe_of(fine, 3);
    made_kit_refused(&kit, made_build_lathe(&lathe, &to, &kit.made), MADE_TRIANGLES);
    const uint64_t counted = kit.made.triangle_count;
    made_kit_closed(&kit, made_kit_lathe(&kit, lathe));
    assert_int_equal(counted, kit.mesh.triangle_count);
}

// A list of faces is what it says, or its first fault.
static void test_faces(void **state) {
    (void)state;
    const vec3 vertices[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    uint32_t corners[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const uint32_t firsts[] = {0, 3, 6, 9};
    const struct ir_pair coordinates[] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    struct made_faces faces = {vertices, 4, corners, 12, firsts, 4, coordinates, 4};
    struct made_to to = made_kit_to(&kit);
    made_kit_closed(&kit, made_build_faces(&faces, &to, &kit.made));
    assert_near(kit.mesh.volume, 1.0 / 6, 1e-15);
    assert_true(kit.made.textured.coordinates.count == 4);
    faces.coordinate_count = 3;
    made_kit_refused(&kit, made_build_faces(&faces, &to, &kit.made), MADE_COORDINATES);
    faces.coordinate_count = 4;
    corners[4] = 4;
    made_kit_refused(&kit, made_build_faces(&faces, &to, &kit.made), MADE_INDEX);
    assert_int_equal(kit.made.fault.outlines[0], 1);
    assert_int_equal(kit.made.fault.points[0], 1);
    faces.corner_count = 11;
    made_kit_refused(&kit, made_build_faces(&faces, &to, &kit.made), MADE_INDEX);
    corners[4] = 1;
    made_kit_refused(&kit, made_build_faces(&faces, &to, &kit.made), MADE_CORNERS_FEW);
    faces.face_count = 0;
    made_kit_refused(&kit, made_build_faces(&faces, &to, &kit.made), MADE_EMPTY);
}

static void test_speed(void **state) {
    (void)state;
    struct ir_pair points[4096];
    for (uint32_t count = 200; count <= 4096; count *= 4) {
        for (uint32_t i = 0; i < count; i++)
            points[i] = (struct ir_pair){i % (count - 1) ? 2 + sin(i * 0.1) : 0, i * 0.01};
        const double begin = made_kit_ms();
        const bool done = made_kit_lathe(&kit, lathe_of(points, count));
        const double took = made_kit_ms() - begin;
        made_kit_closed(&kit, done);
        printf("lathe: %u points, %u triangles in %.2f ms\n", count, kit.mesh.triangle_count, took);
        assert_true(took < 5000);
    }
}

static int finish(void **state) {
    (void)state;
    made_kit_finish(&kit);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cone),           cmocka_unit_test(test_open),
        cmocka_unit_test(test_torus),          cmocka_unit_test(test_touches_axis_within),
        cmocka_unit_test(test_smooth),         cmocka_unit_test(test_random_profiles),
        cmocka_unit_test(test_tiny_numbers),   cmocka_unit_test(test_faults),
        cmocka_unit_test(test_faces),          cmocka_unit_test(test_speed),
        cmocka_unit_test(test_torus_measures), cmocka_unit_test(test_torus_normals),
        cmocka_unit_test(test_frustum),
    };
    return cmocka_run_group_tests(tests, NULL, finish);
}
