// Polygons of every shape: always n - 2 triangles, and for simple ones exactly their area, none turned.
#include "assets/triangulate.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct polygon {
    uint32_t n;
    vec3 *corners;
    uint32_t *cuts;
};

struct fixture {
    struct arena arena;
    struct triangulator triangulator;
};

static int set_up(void **state) {
    struct fixture *f = calloc(1, sizeof *f);
    if (!f)
        return -1;
    arena_init(&f->arena, SIZE_MAX);
    triangulate_init(&f->triangulator, &f->arena);
    *state = f;
    return 0;
}

static int tear_down(void **state) {
    struct fixture *f = *state;
    arena_finish(&f->arena);
    free(f);
    return 0;
}

static struct polygon make(struct fixture *f, uint32_t n) {
    return (struct polygon){n, ARENA_ARRAY(&f->arena, vec3, n),
                            ARENA_ARRAY(&f->arena, uint32_t, 3 * (size_t)n)};
}

// Puts plane coordinates into space: the plane is turned by `view`, 0 to 5: three axes, two sides.
static vec3 place(double x, double y, int view) {
    vec3 sides[3] = {{x, y, 0.25 * x - 0.5 * y}, {0.25 * x - 0.5 * y, x, y}, {y, 0.25 * x - 0.5 * y, x}};
    vec3 p = sides[view % 3];
    return view < 3 ? p : (vec3){-p.x, p.y, p.z};
}

static vec3 newell(const struct polygon *p) {
    vec3 sum = {0, 0, 0};
    for (uint32_t i = 0; i < p->n; i++)
        sum = vec3_add(sum, vec3_cross(p->corners[i], p->corners[(i + 1) % p->n]));
    return vec3_mul(sum, 0.5);
}

static vec3 area_of(const struct polygon *p, uint32_t triangle) {
    const uint32_t *c = p->cuts + 3 * triangle;
    return vec3_mul(vec3_cross(vec3_sub(p->corners[c[1]], p->corners[c[0]]),
                               vec3_sub(p->corners[c[2]], p->corners[c[0]])),
                    0.5);
}

// Corners in range and different, and every directed edge inside once in each direction: with its outline
// turned back the polygon is closed.
static void assert_cut_once(const struct polygon *p) {
    uint32_t count = 0;
    uint32_t(*edges)[2] = malloc(3 * (size_t)p->n * sizeof *edges);
    for (uint32_t t = 0; t + 2 < p->n; t++) {
        for (int k = 0; k < 3; k++) {
            uint32_t a = p->cuts[3 * t + (uint32_t)k];
            uint32_t b = p->cuts[3 * t + (uint32_t)(k + 1) % 3];
            assert_true(a < p->n && b < p->n && a != b);
            if ((a + 1) % p->n != b)
                memcpy(edges[count++], (uint32_t[2]){a, b}, sizeof edges[0]);
        }
    }
    for (uint32_t i = 0; i < count && p->n <= 200; i++) {
        uint32_t opposite = 0;
        for (uint32_t j = 0; j < count; j++)
            opposite += edges[j][0] == edges[i][1] && edges[j][1] == edges[i][0];
        assert_int_equal(opposite, 1);
    }
    free(edges);
    assert_int_equal(count, 2 * (p->n - 3));
}

// The triangles cover the polygon without overlap: none is turned, and their areas sum to its own.
static void assert_covers(struct fixture *f, struct polygon *p, bool strictly) {
    memset(p->cuts, 0xFF, 3 * (size_t)p->n * sizeof *p->cuts);
    triangulate(&f->triangulator, p->corners, p->n, p->cuts);
    assert_cut_once(p);
    vec3 whole = newell(p);
    double expected = vec3_length(whole);
    double sum = 0;
    for (uint32_t t = 0; t + 2 < p->n; t++) {
        vec3 area = area_of(p, t);
        if (vec3_dot(area, whole) < -1e-12 * expected * expected)
            fail_msg("triangle %u is turned", t);
        if (strictly && !(vec3_length(area) > 0))
            fail_msg("triangle %u has no area", t);
        sum += vec3_length(area);
    }
    if (fabs(sum - expected) > 1e-9 * expected)
        fail_msg("areas sum to %.17g, the polygon has %.17g", sum, expected);
}

// The same with every corner as the first, in both directions, in six planes, at three sizes.
static void assert_covers_anyhow(struct fixture *f, const double (*points)[2], uint32_t n, bool strictly) {
    static const double sizes[] = {1, 0x1p-60, 0x1p40};
    struct polygon p = make(f, n);
    for (uint32_t first = 0; first < n; first++)
        for (int view = 0; view < 12; view++) {
            for (uint32_t i = 0; i < n; i++) {
                const double *q = points[view < 6 ? (first + i) % n : (first + n - i) % n];
                p.corners[i] = vec3_mul(place(q[0], q[1], view % 6), sizes[(first + (uint32_t)view) % 3]);
            }
            assert_covers(f, &p, strictly);
        }
}
#define COVERS(f, points, strictly)                                                                          \
    assert_covers_anyhow(f, points, sizeof(points) / sizeof((points)[0]), strictly)

static void quadrilaterals(void **state) {
    static const double square[][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    static const double dart[][2] = {{0, 0}, {2, -1}, {0.5, 0}, {2, 1}};
    static const double with_flat_corner[][2] = {{0, 0}, {1, 0}, {2, 0}, {1, 3}};
    COVERS(*state, square, true);
    COVERS(*state, dart, true);
    COVERS(*state, with_flat_corner, true);
}

static void concave_shapes(void **state) {
    static const double l_shape[][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    static const double u_shape[][2] = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
    static const double arrow[][2] = {{0, 0}, {4, 2}, {0, 4}, {1, 2.5}, {-3, 2.5}, {-3, 1.5}, {1, 1.5}};
    static const double star[][2] = {{0, 3},  {-.5, 1}, {-3, 1}, {-1, 0}, {-2, -3},
                                     {0, -1}, {2, -3},  {1, 0},  {3, 1},  {.5, 1}};
    COVERS(*state, l_shape, true);
    COVERS(*state, u_shape, true);
    COVERS(*state, arrow, true);
    COVERS(*state, star, true);
}

static void corners_on_straight_edges(void **state) {
    static const double triangle[][2] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {2, 1},
                                         {1, 2}, {0, 3}, {0, 2}, {0, 1}};
    static const double plus[][2] = {{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2},
                                     {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
    COVERS(*state, triangle, true);
    COVERS(*state, plus, true);
}

// Outlines with holes, joined by a cut that runs there and back.
static void keyholes(void **state) {
    static const double frame[][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0},
                                      {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
    static const double two_holes[][2] = {{0, 0}, {9, 0}, {9, 4}, {5, 4}, {6, 3}, {8, 2}, {6, 1}, {6, 3},
                                          {5, 4}, {3, 4}, {3, 1}, {1, 2}, {3, 3}, {3, 4}, {0, 4}};
    COVERS(*state, frame, false);
    COVERS(*state, two_holes, false);
}

static void touching_outlines(void **state) {
    // Two squares that meet in a corner, and an outline whose teeth touch its back.
    static const double corner_to_corner[][2] = {{0, 0}, {1, 0}, {1, 1}, {2, 1},
                                                 {2, 2}, {1, 2}, {1, 1}, {0, 1}};
    static const double teeth[][2] = {{0, 0}, {6, 0}, {6, 2}, {5, 0}, {4, 2}, {2, 2}, {1, 0}, {0, 2}};
    COVERS(*state, corner_to_corner, false);
    COVERS(*state, teeth, false);
}

// An outline that crosses itself, where each ear has others on its rim: of those the ones with others inside
// are not cut.
static void corners_on_every_rim(void **state) {
    static const double crossing[][2] = {{0, 3}, {1, 1}, {1, 3}, {2, 1}, {1, 2},
                                         {2, 3}, {0, 3}, {3, 0}, {2, 3}};
    struct polygon p = make(*state, 9);
    for (uint32_t i = 0; i < p.n; i++)
        p.corners[i] = place(crossing[i][0], crossing[i][1], 0);
    assert_covers(*state, &p, false);
}

static uint64_t next_random(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

static double uniform(uint64_t *state) {
    return (double)(next_random(state) >> 11) / 9007199254740992.0;
}

static void random_stars(void **state) {
    struct fixture *f = *state;
    uint64_t random = 1234567;
    for (int round = 0; round < 400; round++) {
        uint32_t n = 5 + (uint32_t)(next_random(&random) % 60);
        struct polygon p = make(f, n);
        for (uint32_t i = 0; i < n; i++) {
            double angle = 6.283185307179586 * (i + 0.8 * uniform(&random)) / n;
            double radius = 0.05 + uniform(&random);
            p.corners[i] = place(radius * cos(angle), radius * sin(angle), round % 6);
        }
        assert_covers(f, &p, false);
    }
}

// A strip wound into a spiral: nearly every corner is reflex, and ears are long and thin.
static struct polygon spiral(struct fixture *f, uint32_t half) {
    struct polygon p = make(f, 2 * half);
    for (uint32_t i = 0; i < half; i++) {
        double angle = 60.0 * i / half;
        p.corners[i] = place((1 + angle) * cos(angle), (1 + angle) * sin(angle), 0);
        p.corners[2 * half - 1 - i] = place((3 + angle) * cos(angle), (3 + angle) * sin(angle), 0);
    }
    return p;
}

static struct polygon comb(struct fixture *f, uint32_t teeth) {
    struct polygon p = make(f, 2 * teeth + 1);
    for (uint32_t i = 0; i < teeth; i++) {
        p.corners[2 * i] = place(i, 0, 0);
        p.corners[2 * i + 1] = place(i + 0.5, 1, 0);
    }
    p.corners[2 * teeth] = place(teeth / 2.0, teeth, 0);
    // Counter-clockwise, the tips of the teeth are reflex.
    return p;
}

static void large_polygons(void **state) {
    struct fixture *f = *state;
    struct polygon shapes[] = {spiral(f, 100), spiral(f, 30000), comb(f, 90), comb(f, 30000)};
    for (int i = 0; i < 4; i++)
        assert_covers(f, &shapes[i], false);
}

static void a_large_convex_polygon(void **state) {
    struct fixture *f = *state;
    struct polygon p = make(f, 1000);
    for (uint32_t i = 0; i < p.n; i++)
        p.corners[i] = place(cos(6.283185307179586 * i / p.n), sin(6.283185307179586 * i / p.n), 4);
    assert_covers(f, &p, true);
}

// No shape at all: still n - 2 triangles over the right edges.
static void degenerate_polygons(void **state) {
    struct fixture *f = *state;
    static const uint32_t sizes[] = {3, 4, 5, 8, 33, 150};
    uint64_t random = 99;
    for (int kind = 0; kind < 6; kind++)
        for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
            struct polygon p = make(f, sizes[i]);
            for (uint32_t k = 0; k < p.n; k++) {
                double x = uniform(&random), y = uniform(&random);
                uint32_t pentagram = k * 2 % p.n;
                p.corners[k] = kind == 0   ? (vec3){1, 2, 3}
                               : kind == 1 ? (vec3){x, 2 * x, 3 * x}
                               : kind == 2 ? place(x, y, 2)
                               : kind == 3 ? (vec3){x, y, uniform(&random)}
                               : kind == 4
                                   ? place(cos(6.28 * pentagram / p.n), sin(6.28 * pentagram / p.n), 1)
                                   : place((double)(k % 3), (double)(k / 3 % 2), 5);
            }
            triangulate(&f->triangulator, p.corners, p.n, p.cuts);
            assert_cut_once(&p);
        }
}

static void random_tangles_end_in_time(void **state) {
    struct fixture *f = *state;
    uint64_t random = 7;
    struct polygon p = make(f, 65536);
    for (uint32_t k = 0; k < p.n; k++)
        p.corners[k] = place(uniform(&random), uniform(&random), 0);
    triangulate(&f->triangulator, p.corners, p.n, p.cuts);
    assert_cut_once(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(quadrilaterals, set_up, tear_down),
        cmocka_unit_test_setup_teardown(concave_shapes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(corners_on_straight_edges, set_up, tear_down),
        cmocka_unit_test_setup_teardown(keyholes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(touching_outlines, set_up, tear_down),
        cmocka_unit_test_setup_teardown(corners_on_every_rim, set_up, tear_down),
        cmocka_unit_test_setup_teardown(random_stars, set_up, tear_down),
        cmocka_unit_test_setup_teardown(large_polygons, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_large_convex_polygon, set_up, tear_down),
        cmocka_unit_test_setup_teardown(degenerate_polygons, set_up, tear_down),
        cmocka_unit_test_setup_teardown(random_tangles_end_in_time, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
