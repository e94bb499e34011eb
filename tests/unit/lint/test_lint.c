// The geometry under the rules about light: what crosses, what coincides, what is inside; and the table of
// rules.
#include "diag/diag.h"
#include "lint/lint.h"
#include "lint/lint_internal.h"

// cmocka needs these before itself.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    RINGS = 24,
    SECTORS = 48,
    POSITIONS_MAX = 4096,
    TRIANGLES_MAX = 8192,
};

struct fixture {
    struct arena arena;
    struct mesh mesh;
    vec3 positions[POSITIONS_MAX];
    uint32_t merged[POSITIONS_MAX];
    struct mesh_triangle triangles[TRIANGLES_MAX];
    uint64_t random;
};

static double random_unit(struct fixture *f) {
    f->random = f->random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(f->random >> 11) * 0x1p-53;
}

static vec3 random_point(struct fixture *f, double size) {
    double x = random_unit(f) - 0.5;
    double y = random_unit(f) - 0.5;
    return vec3_mul((vec3){x, y, random_unit(f) - 0.5}, size);
}

static int setup(void **state) {
    struct fixture *f = calloc(1, sizeof *f);
    if (!f)
        return 1;
    arena_init(&f->arena, (size_t)1 << 30);
    f->mesh.positions = f->positions;
    f->mesh.merged = f->merged;
    f->mesh.triangles = f->triangles;
    f->random = 1;
    *state = f;
    return 0;
}

static int teardown(void **state) {
    struct fixture *f = *state;
    arena_finish(&f->arena);
    free(f);
    return 0;
}

static uint32_t add_position(struct fixture *f, vec3 p) {
    f->merged[f->mesh.position_count] = f->mesh.position_count;
    f->positions[f->mesh.position_count] = p;
    return f->mesh.position_count++;
}

static void add_triangle(struct fixture *f, uint32_t a, uint32_t b, uint32_t c) {
    f->triangles[f->mesh.triangle_count] =
        (struct mesh_triangle){.corners = {a, b, c}, .line = f->mesh.triangle_count + 1};
    f->mesh.triangle_count++;
}

static void measure(struct fixture *f) {
    f->mesh.lower = f->mesh.upper = f->positions[0];
    for (uint32_t i = 0; i < f->mesh.position_count; i++) {
        f->mesh.lower = vec3_min(f->mesh.lower, f->positions[i]);
        f->mesh.upper = vec3_max(f->mesh.upper, f->positions[i]);
    }
    f->mesh.zero_area = 0;
}

// Of six digits, as most files have them.
static double six_digits(double x) {
    char text[32];
    snprintf(text, sizeof text, "%.6g", x);
    return strtod(text, NULL);
}

static vec3 on_sphere(double u, double v, vec3 center, double radius) {
    vec3 p = {sin(v) * cos(u), cos(v), sin(v) * sin(u)};
    p = vec3_add(center, vec3_mul(p, radius));
    return (vec3){six_digits(p.x), six_digits(p.y), six_digits(p.z)};
}

static void add_ball(struct fixture *f, vec3 center, double radius) {
    uint32_t first = f->mesh.position_count;
    for (uint32_t i = 1; i < RINGS; i++)
        for (uint32_t k = 0; k < SECTORS; k++)
            add_position(
                f, on_sphere(6.283185307179586 * k / SECTORS, 3.141592653589793 * i / RINGS, center, radius));
    uint32_t top = add_position(f, on_sphere(0, 0, center, radius));
    uint32_t bottom = add_position(f, on_sphere(0, 3.141592653589793, center, radius));
    for (uint32_t k = 0; k < SECTORS; k++) {
        uint32_t next = (k + 1) % SECTORS;
        uint32_t last = first + (RINGS - 2) * SECTORS;
        add_triangle(f, top, first + next, first + k);
        add_triangle(f, bottom, last + k, last + next);
        for (uint32_t i = 0; i + 2 < RINGS; i++) {
            uint32_t a = first + i * SECTORS;
            add_triangle(f, a + k, a + next, a + SECTORS + k);
            add_triangle(f, a + next, a + SECTORS + next, a + SECTORS + k);
        }
    }
    measure(f);
}

static struct lint_mesh pairs_of(struct fixture *f, bool refracts) {
    struct lint lint = {.arena = &f->arena};
    static const struct lint_body glass;
    struct lint_mesh mesh = {.mesh = &f->mesh, .first_refracting = refracts ? &glass : NULL};
    mesh.tolerance = LINT_RESOLUTION * fmax(vec3_max_abs(f->mesh.lower), vec3_max_abs(f->mesh.upper));
    lint_find_pairs(&lint, &mesh);
    return mesh;
}

// A ball far from the origin, where six digits leave its triangles little: rounded, and still good.
static void good_meshes_are_silent(void **state) {
    struct fixture *f = *state;
    double distances[] = {0, 1, 30};
    for (size_t i = 0; i < sizeof distances / sizeof *distances; i++) {
        f->mesh.position_count = f->mesh.triangle_count = 0;
        add_ball(f, (vec3){distances[i], -distances[i], 0.3}, 1);
        struct lint_mesh mesh = pairs_of(f, true);
        assert_int_equal(mesh.tree.count, f->mesh.triangle_count);
        assert_int_equal(mesh.crossings.count, 0);
        assert_int_equal(mesh.overlaps.count, 0);
    }
}

// Neighbours in one plane, as flat faces have them, whatever the direction of the plane.
static void flat_neighbours_are_silent(void **state) {
    struct fixture *f = *state;
    vec3 u = vec3_unit((vec3){1, 0.3, -0.7});
    vec3 v = vec3_unit(vec3_cross(u, (vec3){0.2, 1, 0.4}));
    for (uint32_t i = 0; i <= 20; i++)
        for (uint32_t k = 0; k <= 20; k++)
            add_position(f, vec3_add(vec3_mul(u, i / 7.0), vec3_mul(v, k / 3.0)));
    for (uint32_t i = 0; i < 20; i++)
        for (uint32_t k = 0; k < 20; k++) {
            uint32_t a = i * 21 + k;
            add_triangle(f, a, a + 21, a + 22);
            add_triangle(f, a, a + 22, a + 1);
        }
    measure(f);
    struct lint_mesh mesh = pairs_of(f, true);
    assert_int_equal(mesh.crossings.count, 0);
    assert_int_equal(mesh.overlaps.count, 0);
}

static void crossing_balls_are_found(void **state) {
    struct fixture *f = *state;
    add_ball(f, (vec3){0, 0, 0}, 1);
    add_ball(f, (vec3){1.2, 0.1, 0}, 1);
    struct lint_mesh mesh = pairs_of(f, true);
    // The circle in which they meet crosses some four triangles a sector on each.
    assert_in_range(mesh.crossings.count, 100, 600);
    assert_true(mesh.crossings.first < mesh.crossings.second);
    // What does not refract may cross.
    mesh = pairs_of(f, false);
    assert_int_equal(mesh.crossings.count, 0);
}

// Every pair by hand gives the same count as the tree.
static void the_tree_misses_no_pair(void **state) {
    struct fixture *f = *state;
    for (uint32_t i = 0; i < 300; i++) {
        vec3 at = random_point(f, 4);
        uint32_t a = add_position(f, vec3_add(at, random_point(f, 1)));
        uint32_t b = add_position(f, vec3_add(at, random_point(f, 1)));
        add_triangle(f, a, b, add_position(f, vec3_add(at, random_point(f, 1))));
    }
    measure(f);
    struct lint_mesh mesh = pairs_of(f, true);
    uint32_t count = 0;
    uint32_t first = UINT32_MAX;
    for (uint32_t i = 0; i < f->mesh.triangle_count; i++) {
        struct lint_face a = lint_face_of(lint_mesh_triangle(&f->mesh, i));
        bool crossed = false;
        for (uint32_t k = 0; k < f->mesh.triangle_count; k++) {
            struct lint_face b = lint_face_of(lint_mesh_triangle(&f->mesh, k));
            crossed = crossed || (k != i && lint_faces_cross(&a, &b, mesh.tolerance));
        }
        count += crossed;
        first = crossed && i < first ? i : first;
    }
    assert_in_range(count, 20, 300);
    assert_int_equal(mesh.crossings.count, count);
    assert_int_equal(mesh.crossings.first, first);
}

// Triangles with the same corners are told by their place on the curve, without a look at the others.
static void twins_are_crowded(void **state) {
    struct fixture *f = *state;
    struct lint_tree tree;
    add_ball(f, (vec3){0, 3, 0}, 1);
    lint_tree_build(&tree, &f->mesh, &f->arena);
    assert_non_null(tree.crowded);
    assert_int_equal(tree.crowded_count, 0);
    const uint32_t count = f->mesh.triangle_count;
    const uint32_t *c = f->triangles[7].corners;
    add_triangle(f, c[0], c[1], c[2]);
    c = f->triangles[40].corners;
    add_triangle(f, c[2], c[1], c[0]);
    lint_tree_build(&tree, &f->mesh, &f->arena);
    const uint32_t expected[] = {7, 40, count, count + 1};
    assert_int_equal(tree.crowded_count, 4);
    assert_memory_equal(tree.crowded, expected, sizeof expected);
}

static struct lint_face face(vec3 a, vec3 b, vec3 c) {
    return lint_face_of((struct lint_triangle){{a, b, c}});
}

static void faces_in_one_plane(void **state) {
    (void)state;
    struct lint_face floor = face((vec3){0, 0, 0}, (vec3){4, 0, 0}, (vec3){0, 0, 4});
    struct lint_face within = face((vec3){1, 0, 1}, (vec3){1.5, 0, 1}, (vec3){1, 0, 1.5});
    struct lint_face above = face((vec3){1, 1e-3, 1}, (vec3){1.5, 1e-3, 1}, (vec3){1, 1e-3, 1.5});
    struct lint_face beside = face((vec3){4, 0, 0}, (vec3){4, 0, 4}, (vec3){0, 0, 4});
    struct lint_face folded = face((vec3){4, 0, 0}, (vec3){1, 0, 1}, (vec3){0, 0, 4});
    struct lint_face needle = face((vec3){1, 0, 1}, (vec3){2, 0, 1}, (vec3){1, 0, 1 + 1e-9});
    assert_true(lint_faces_coincide(&floor, &within, 1e-6, 1e-6));
    assert_true(lint_faces_coincide(&within, &floor, 1e-6, 1e-6));
    assert_false(lint_faces_coincide(&floor, &above, 1e-6, 1e-6));
    assert_false(lint_faces_coincide(&floor, &beside, 1e-6, 1e-6));
    assert_true(lint_faces_coincide(&floor, &folded, 1e-6, 1e-6));
    assert_false(lint_faces_coincide(&floor, &needle, 1e-6, 1e-6));
}

// Two boxes whose edges touch cross nothing; one that stands a little into the other does.
static void touching_is_not_crossing(void **state) {
    (void)state;
    struct lint_face wall = face((vec3){0, 0, 0}, (vec3){0, 2, 0}, (vec3){0, 0, 2});
    struct lint_face touching = face((vec3){0, 0.5, 0.5}, (vec3){1, 1, 0.5}, (vec3){1, 0.5, 1});
    struct lint_face standing = face((vec3){-0.1, 0.5, 0.5}, (vec3){1, 1, 0.5}, (vec3){1, 0.5, 1});
    struct lint_face rounded = face((vec3){-1e-7, 0.5, 0.5}, (vec3){1, 1, 0.5}, (vec3){1, 0.5, 1});
    assert_false(lint_faces_cross(&wall, &touching, 1e-6));
    assert_true(lint_faces_cross(&wall, &standing, 1e-6));
    assert_true(lint_faces_cross(&standing, &wall, 1e-6));
    assert_false(lint_faces_cross(&wall, &rounded, 1e-6));
}

static void inside_is_told_from_outside(void **state) {
    struct fixture *f = *state;
    add_ball(f, (vec3){0.5, 0, 0}, 1);
    struct lint_tree tree;
    lint_tree_build(&tree, &f->mesh, &f->arena);
    uint32_t inside = 0;
    for (int i = 0; i < 4000; i++) {
        vec3 p = random_point(f, 3);
        double r = vec3_length(vec3_sub(p, (vec3){0.5, 0, 0}));
        // Between the ball and its triangles nobody knows.
        if (r > 0.99 && r < 1.01)
            continue;
        assert_int_equal(lint_tree_winding(&tree, p), r < 1 ? 1 : 0);
        inside += r < 1;
    }
    assert_in_range(inside, 300, 1500);
    assert_int_equal(lint_tree_winding(&tree, (vec3){0.5, 0, 0}), 1);
}

static void distance_to_a_triangle(void **state) {
    (void)state;
    struct lint_triangle t = {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}};
    assert_true(fabs(lint_triangle_distance(&t, (vec3){0.5, 0.5, 3}) - 3) < 1e-12);
    assert_true(fabs(lint_triangle_distance(&t, (vec3){-3, 0, 4}) - 5) < 1e-12);
    assert_true(fabs(lint_triangle_distance(&t, (vec3){2, 2, 0}) - sqrt(2)) < 1e-12);
}

// The table is in the order of the codes, and every rule has its words in docs/lint.md.
static void rules_are_documented(void **state) {
    (void)state;
    static char text[1 << 17];
    FILE *file = fopen("docs/lint.md", "rb");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    const char *at = text;
    for (const struct lint_rule *rule = lint_rules; rule->run; rule++) {
        const struct diag_info *info = diag_info(rule->code);
        char heading[64];
        snprintf(heading, sizeof heading, "\n## %s: ", info->code);
        assert_int_not_equal(info->severity, DIAG_ERROR);
        at = strstr(at, heading);
        if (!at)
            fail_msg("docs/lint.md has no heading for %s behind those before it", info->code);
        assert_true(rule->level == LINT_CHEAP || rule->level == LINT_ALL);
    }
}

#define GEOMETRY(test) cmocka_unit_test_setup_teardown(test, setup, teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        GEOMETRY(good_meshes_are_silent),           GEOMETRY(flat_neighbours_are_silent),
        GEOMETRY(crossing_balls_are_found),         GEOMETRY(the_tree_misses_no_pair),
        cmocka_unit_test(faces_in_one_plane),       GEOMETRY(twins_are_crowded),
        cmocka_unit_test(touching_is_not_crossing), GEOMETRY(inside_is_told_from_outside),
        cmocka_unit_test(distance_to_a_triangle),   cmocka_unit_test(rules_are_documented),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
