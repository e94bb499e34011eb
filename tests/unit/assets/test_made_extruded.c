// Extruded outlines: closed, of the area that even-odd filling has, with holes, concave corners and bevels.
#include "made_kit.h"

#include "core/angle.h"

enum {
    POINTS_MOST = 4096,
    OUTLINES_MOST = 600,
};

static struct made_kit kit;
static struct ir_pair points[POINTS_MOST];
static struct made_outline outlines[OUTLINES_MOST];
static uint32_t point_count, outline_count;

static void begin(void) {
    point_count = outline_count = 0;
}

static void add_point(double x, double y) {
    points[point_count++] = (struct ir_pair){x, y};
}

static void begin_outline(void) {
    outlines[outline_count++] = (struct made_outline){points + point_count, 0};
}

static void end_outline(void) {
    struct made_outline *outline = &outlines[outline_count - 1];
    outline->count = (uint32_t)(points + point_count - outline->points);
}

// A star around a middle, with radii of `least` to `most`, turning left or right.
static void add_star(uint64_t *random, double x, double y, double least, double most, uint32_t count) {
    const double side = random_bits(random) % 2 ? 1 : -1;
    begin_outline();
    for (uint32_t i = 0; i < count; i++) {
        const double angle = side * 2 * PI * i / count, radius = least + (most - least) * random_unit(random);
        add_point(x + radius * cos(angle), y + radius * sin(angle));
    }
    end_outline();
}

static void add_box(double x, double y, double width, double height) {
    begin_outline();
    add_point(x, y);
    add_point(x + width, y);
    add_point(x + width, y + height);
    add_point(x, y + height);
    end_outline();
}

static struct made_extrude all(void) {
    return (struct made_extrude){outlines, outline_count, false, 2, 0, MADE_TOLERANCE};
}

static bool is_inside(struct ir_pair p) {
    bool inside = false;
    for (uint32_t o = 0; o < outline_count; o++)
        for (uint32_t i = 0; i < outlines[o].count; i++) {
            const struct ir_pair a = outlines[o].points[i],
                                 b = outlines[o].points[(i + 1) % outlines[o].count];
            if ((a.v > p.v) != (b.v > p.v) && p.u < a.u + (b.u - a.u) * (p.v - a.v) / (b.v - a.v))
                inside = !inside;
        }
    return inside;
}

static double cross(vec3 a, vec3 b, struct ir_pair p) {
    return (b.x - a.x) * (p.v - a.y) - (b.y - a.y) * (p.u - a.x);
}

// How many triangles of the front are over a point.
static int cover(struct ir_pair p, double front) {
    int count = 0;
    for (uint32_t t = 0; t < kit.mesh.triangle_count; t++) {
        const vec3 a = made_kit_corner(&kit.mesh, t, 0), b = made_kit_corner(&kit.mesh, t, 1),
                   c = made_kit_corner(&kit.mesh, t, 2);
        if (a.z == front && b.z == front && c.z == front)
            count += cross(a, b, p) > 0 && cross(b, c, p) > 0 && cross(c, a, p) > 0;
    }
    return count;
}

static double outline_area(const struct made_outline *outline) {
    double sum = 0;
    for (uint32_t i = 0; i < outline->count; i++) {
        const struct ir_pair a = outline->points[i], b = outline->points[(i + 1) % outline->count];
        sum += (a.u * b.v - b.u * a.v) / 2;
    }
    return fabs(sum);
}

static double perimeter(const struct made_outline *outline) {
    double sum = 0;
    for (uint32_t i = 0; i < outline->count; i++) {
        const struct ir_pair a = outline->points[i], b = outline->points[(i + 1) % outline->count];
        sum += hypot(b.u - a.u, b.v - a.v);
    }
    return sum;
}

static void assert_near(double value, double expected, double share) {
    if (!(fabs(value - expected) <= share * fabs(expected)))
        fail_msg("%.17g, expected %.17g within %g", value, expected, share);
}

static void test_box(void **state) {
    (void)state;
    begin();
    add_box(-1, -1, 2, 3);
    made_kit_closed(&kit, made_kit_extrude(&kit, all()));
    assert_true(kit.mesh.volume == 12 && kit.mesh.triangle_count == 12);
    assert_true(kit.mesh.lower.z == 0 && kit.mesh.upper.z == 2);
    assert_near(made_kit_worst_normal(&kit.mesh), 1, 1e-15);
    add_point(-1, -1); // the first point again
    outlines[0].count++;
    made_kit_closed(&kit, made_kit_extrude(&kit, all()));
    assert_true(kit.mesh.volume == 12 && kit.mesh.triangle_count == 12);
}

// Volume and area of a box with all edges of both ends cut: those of its slices, and of its faces.
static void test_bevel(void **state) {
    (void)state;
    begin();
    add_box(0, 0, 4, 3);
    add_box(1, 1, 1, 1);
    for (double bevel = 0.1; bevel <= 0.91; bevel += 0.1) {
        struct made_extrude extrude = all();
        extrude.bevel = bevel;
        const bool done = made_kit_extrude(&kit, extrude);
        if (bevel > 0.5) {
            made_kit_refused(&kit, done, MADE_BEVEL);
            assert_true(kit.made.fault.most <= 0.5 && kit.made.fault.most > 0.49);
            extrude.bevel = kit.made.fault.most;
            made_kit_closed(&kit, made_kit_extrude(&kit, extrude));
            continue;
        }
        if (bevel > 0.49) // the sides touch
            continue;
        made_kit_closed(&kit, done);
        const double b = bevel;
        const double outer = 12 * 2 - 2 * (14 * b * b / 2 - 4 * b * b * b / 3);
        const double inner = 1 * 2 + 2 * (4 * b * b / 2 + 4 * b * b * b / 3);
        assert_near(kit.mesh.volume, outer - inner, 1e-12);
        // Both ends, the four strips at 45 degrees around each, and the sides between them.
        const double ends = (4 - 2 * b) * (3 - 2 * b) - (1 + 2 * b) * (1 + 2 * b);
        const double strips = sqrt(2) * b * ((14 - 4 * b) + (4 + 4 * b)), sides = (2 - 2 * b) * (14 + 4);
        assert_near(made_kit_surface(&kit.mesh), 2 * ends + 2 * strips + sides, 1e-12);
        assert_true(made_kit_worst_normal(&kit.mesh) > 1 - 1e-12);
    }
    struct made_extrude extrude = all();
    extrude.bevel = 0.2;
    extrude.height = 0.4;
    made_kit_closed(&kit, made_kit_extrude(&kit, extrude));
    extrude.bevel = 0.21;
    made_kit_refused(&kit, made_kit_extrude(&kit, extrude), MADE_BEVEL);
    assert_true(kit.made.fault.most == 0.2);
}

// A hole whose tip is so sharp that the cosine of its angle is 1, or rounded to more: the corner of its bevel
// is far outside the box, or at no place.
static void test_bevel_of_a_needle(void **state) {
    (void)state;
    for (double along = 1; along < 20; along++)
        for (double across = 1; across < 20; across++) {
            begin();
            add_box(-1e6, -1e6, 3e7, 3e7);
            begin_outline();
            add_point(0, 0);
            add_point(along * 1e6, across * 1e6);
            add_point(along * 1e6, across * 1e6 + 0x1p-7);
            end_outline();
            struct made_extrude extrude = all();
            made_kit_closed(&kit, made_kit_extrude(&kit, extrude));
            extrude.bevel = 0.25;
            made_kit_refused(&kit, made_kit_extrude(&kit, extrude), MADE_BEVEL);
            assert_true(kit.made.fault.most < 0.25);
        }
}

// What is nearer to 0 than products of two coordinates can tell counts as 0.
static void test_tiny_numbers(void **state) {
    (void)state;
    begin();
    add_box(0, 0, 2, 3);
    points[0].u = -1e-300;
    points[1].v = 1e-300;
    points[3].u = 1e-300;
    made_kit_closed(&kit, made_kit_extrude(&kit, all()));
    assert_true(kit.mesh.volume == 12 && kit.mesh.triangle_count == 12);
    begin();
    add_box(0, 0, 1e-300, 1e-300);
    made_kit_refused(&kit, made_kit_extrude(&kit, all()), MADE_POINTS_FEW);
}

// Stars with stars in them, side by side: their area, and what covers each point.
static void test_random_outlines(void **state) {
    (void)state;
    uint64_t random = 7;
    for (int i = 0; i < 2000; i++) {
        begin();
        const uint32_t count = 3 + (uint32_t)(random_bits(&random) % 40);
        double area = 0, around = 0;
        for (int k = 0; k < 1 + i % 4; k++) {
            add_star(&random, 5 * k, k % 2, 1.2, 2.4, count + 4);
            add_star(&random, 5 * k + 0.02, k % 2, 0.3, 0.6, count + 2);
            add_star(&random, 5 * k, k % 2, 0.1, 0.12, count);
            for (int o = 0; o < 3; o++)
                area += (o == 1 ? -1 : 1) * outline_area(&outlines[outline_count - 3 + (uint32_t)o]);
        }
        for (uint32_t o = 0; o < outline_count; o++)
            around += perimeter(&outlines[o]);
        struct made_extrude extrude = all();
        made_kit_closed(&kit, made_kit_extrude(&kit, extrude));
        assert_near(kit.mesh.volume, 2 * area, 1e-12);
        assert_near(made_kit_surface(&kit.mesh), 2 * area + 2 * around, 1e-12);
        for (int k = 0; k < 20; k++) {
            const struct ir_pair p = {8 * random_unit(&random) - 2, 4 * random_unit(&random) - 2};
            assert_int_equal(cover(p, 2), is_inside(p));
        }
        extrude.smooth = true;
        extrude.tolerance = 0.02;
        if (made_kit_extrude(&kit, extrude))
            made_kit_closed(&kit, true);
        else
            assert_true(kit.made.fault.code == MADE_CROSSES || kit.made.fault.code == MADE_TOUCHES);
        extrude.smooth = false;
        extrude.bevel = 0.05 * random_unit(&random);
        if (made_kit_extrude(&kit, extrude)) {
            made_kit_closed(&kit, true);
            continue;
        }
        made_kit_refused(&kit, false, MADE_BEVEL);
        assert_true(kit.made.fault.most < extrude.bevel);
        extrude.bevel = kit.made.fault.most;
        if (extrude.bevel > 0)
            made_kit_closed(&kit, made_kit_extrude(&kit, extrude));
    }
}

// The next point of the only outline that is at another place.
static struct ir_pair next_point(uint32_t i) {
    uint32_t next = (i + 1) % point_count;
    while (points[next].u == points[i].u && points[next].v == points[i].v)
        next = (next + 1) % point_count;
    return points[next];
}

static void assert_on_line(struct ir_pair a, struct ir_pair b, struct ir_pair p) {
    assert_true(fabs((b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u)) < 1e-12);
    assert_true((p.u - a.u) * (p.u - b.u) <= 1e-12 && (p.v - a.v) * (p.v - b.v) <= 1e-12);
}

// Random points joined in any order mostly cross: whatever is built is closed, and crossings are where it
// says.
static void test_random_crossings(void **state) {
    (void)state;
    uint64_t random = 3;
    uint32_t built = 0, refused = 0;
    for (int i = 0; i < 20000; i++) {
        begin();
        begin_outline();
        const uint32_t count = 3 + (uint32_t)(random_bits(&random) % 5);
        for (uint32_t k = 0; k < count; k++)
            add_point((double)(random_bits(&random) % 9), (double)(random_bits(&random) % 9));
        end_outline();
        if (made_kit_extrude(&kit, all())) {
            made_kit_closed(&kit, true);
            assert_near(kit.mesh.volume, 2 * outline_area(&outlines[0]), 1e-12);
            built++;
            continue;
        }
        const struct made_fault *fault = &kit.made.fault;
        assert_true(fault->code == MADE_CROSSES || fault->code == MADE_TOUCHES ||
                    fault->code == MADE_POINTS_FEW);
        refused++;
        if (fault->code != MADE_CROSSES)
            continue;
        for (int w = 0; w < 2; w++)
            assert_on_line(points[fault->points[w]], next_point(fault->points[w]), fault->place);
    }
    printf("outlines in any order: %u built, %u refused\n", built, refused);
    assert_true(built > 3000 && refused > 3000);
}

static void test_circle(void **state) {
    (void)state;
    for (uint32_t count = 8; count <= 32; count *= 2) {
        begin();
        begin_outline();
        for (uint32_t i = 0; i < count; i++)
            add_point(cos(2 * PI * i / count), sin(2 * PI * i / count));
        end_outline();
        struct made_extrude extrude = all();
        extrude.smooth = true;
        extrude.tolerance = 1e-5;
        made_kit_closed(&kit, made_kit_extrude(&kit, extrude));
        printf("curve through %u points of a circle: area off by %.3g\n", count,
               kit.mesh.volume / (2 * PI) - 1);
        assert_near(kit.mesh.volume, 2 * PI, 40 / pow(count, 3));
        assert_true(made_kit_worst_normal(&kit.mesh) > 0.999);
    }
}

static void test_faults(void **state) {
    (void)state;
    begin();
    made_kit_refused(&kit, made_kit_extrude(&kit, all()), MADE_EMPTY);
    add_box(0, 0, 2, 2);
    add_box(1, 1, 2, 2);
    made_kit_refused(&kit, made_kit_extrude(&kit, all()), MADE_CROSSES);
    assert_true(kit.made.fault.outlines[0] == 0 && kit.made.fault.outlines[1] == 1);
    assert_true(kit.made.fault.place.u + kit.made.fault.place.v == 3);
    printf("%s\n", kit.made.fault.text);
    begin();
    add_box(0, 0, 2, 2);
    add_box(2, 2, 2, 2);
    made_kit_refused(&kit, made_kit_extrude(&kit, all()), MADE_TOUCHES);
    printf("%s\n", kit.made.fault.text);
    begin();
    add_box(0, 0, 2, 2);
    add_box(0.5, 2, 1, 1);
    made_kit_refused(&kit, made_kit_extrude(&kit, all()), MADE_TOUCHES);
    printf("%s\n", kit.made.fault.text);
    begin();
    add_box(0, 0, 2, 0);
    made_kit_refused(&kit, made_kit_extrude(&kit, all()), MADE_POINTS_FEW);
    begin();
    add_box(0, 0, INFINITY, 1);
    made_kit_refused(&kit, made_kit_extrude(&kit, all()), MADE_NUMBER);
    assert_true(kit.made.fault.outlines[0] == 0 && kit.made.fault.points[0] == 1);
}

static void test_speed(void **state) {
    (void)state;
    begin();
    add_box(-1, -1, 34, 34);
    for (int i = 0; i < 500; i++)
        add_box(1.5 * (i % 20) + 0.25, 1.2 * (int)(i / 20) + 0.1, 0.9, 0.7);
    const double before = made_kit_ms();
    const bool done = made_kit_extrude(&kit, all());
    const double took = made_kit_ms() - before;
    made_kit_closed(&kit, done);
    assert_near(kit.mesh.volume, 2 * (34 * 34 - 500 * 0.63), 1e-9);
    printf("extrude: 500 holes, %u triangles in %.2f ms\n", kit.mesh.triangle_count, took);
    uint64_t random = 9;
    begin();
    add_star(&random, 0, 0, 1, 2, 4000);
    const double start = made_kit_ms();
    made_kit_closed(&kit, made_kit_extrude(&kit, all()));
    printf("extrude: 4000 points in %.2f ms\n", made_kit_ms() - start);
}

static int finish(void **state) {
    (void)state;
    made_kit_finish(&kit);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_box),
        cmocka_unit_test(test_bevel),
        cmocka_unit_test(test_bevel_of_a_needle),
        cmocka_unit_test(test_tiny_numbers),
        cmocka_unit_test(test_circle),
        cmocka_unit_test(test_random_outlines),
        cmocka_unit_test(test_faults),
        cmocka_unit_test(test_random_crossings),
        cmocka_unit_test(test_speed),
    };
    return cmocka_run_group_tests(tests, NULL, finish);
}
