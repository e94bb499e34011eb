// What a mesh encloses and how it is shaded: closedness, volume, the outward side, areas, vertex normals.
#include "assets_scene.h"
#include "core/angle.h"

#include <math.h>
#include <stdio.h>

#define CUBE_VERTICES                                                                                        \
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"                                                                   \
    "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
#define CUBE_SIDES "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"
#define CUBE       CUBE_VERTICES CUBE_SIDES "f 4 1 5 8\n"

static vec3 corner(const struct mesh *mesh, uint32_t t, int k) {
    return mesh->positions[mesh->triangles[t].corners[k]];
}

static void a_cube_is_closed(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, CUBE);
    assert_silent(s);
    assert_true(mesh->closed);
    assert_false(mesh->turned);
    assert_int_equal(mesh->open_edges, 0);
    assert_int_equal(mesh->face_count, 6);
    assert_int_equal(mesh->triangle_count, 12);
    assert_true(fabs(mesh->volume - 1) < 1e-12);
    assert_int_equal(mesh->zero_area, 0);
    assets_scene_end(s);
}

// Every face has vertices of its own, as many programs write them; one zero is negative.
static void equal_positions_are_one(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, "v 0 0 -0\nv 1 0 0\nv 0 1 0\nf 1 3 2\n"
                                                   "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 4 5 6\n"
                                                   "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 7 8 9\n"
                                                   "v 0 1 0\nv 0 0.0 -0.0\nv 0 0 1\nf 10 11 12\n");
    assert_silent(s);
    assert_true(mesh->closed);
    assert_int_equal(mesh->position_count, 12);
    assert_int_equal(mesh->merged[3], 0);
    assert_int_equal(mesh->merged[10], 0);
    assert_int_equal(mesh->merged[11], 5);
    assert_true(fabs(mesh->volume - 1.0 / 6) < 1e-15);
    assets_scene_end(s);
}

static void nearly_equal_positions_are_not(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh =
        assets_scene_mesh(s, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 1.0000000000000002\n"
                             "f 1 3 2\nf 1 2 4\nf 2 3 5\nf 3 1 4\n");
    assert_false(mesh->closed);
    assert_int_equal(mesh->open_edges, 4);
    assert_int_equal(mesh->open_line, 7);
    assets_scene_end(s);
}

static void a_missing_face_opens(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, CUBE_VERTICES CUBE_SIDES);
    assert_false(mesh->closed);
    assert_int_equal(mesh->open_edges, 4);
    assert_int_equal(mesh->open_line, 9);
    assert_true(mesh->volume == 0);
    assets_scene_end(s);
}

static void one_turned_face_opens(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, CUBE_VERTICES CUBE_SIDES "f 8 5 1 4\n");
    assert_false(mesh->closed);
    assert_int_equal(mesh->open_edges, 8); // two of one direction at each of four edges
    assets_scene_end(s);
}

// Two tetrahedra that share an edge, which four faces meet; and a face that stands there twice.
static void edges_are_counted_by_direction(void **state) {
    (void)state;
    static const char *const solid =
        "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 1 1 0\nv -1 0 0\nv -1 -1 0\n"
        "f 1 2 3\nf 2 1 4\nf 1 3 4\nf 3 2 4\nf 1 2 5\nf 2 1 6\nf 1 5 6\nf 5 2 6\n";
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, solid);
    assert_true(mesh->closed);
    assets_scene_end(s);
    s = assets_scene_begin();
    str twice = arena_format(&s->arena, "%sf 1 2 3\n", solid);
    mesh = assets_scene_mesh(s, twice.ptr);
    assert_false(mesh->closed);
    assert_int_equal(mesh->open_edges, 3);
    assets_scene_end(s);
}

static void inside_out_is_turned(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nvn 1 0 0\nvn 0 1 0\n"
                                                   "f 1//1 2//2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
    assert_true(mesh->closed);
    assert_true(mesh->turned);
    assert_true(fabs(mesh->volume + 8.0 / 6) < 1e-15);
    assert_int_equal(s->sink.count, 1);
    assert_says(
        s, "mesh.obj:1:1: note: the faces of this closed mesh point inwards and were turned outwards [N603]");
    assert_int_equal(s->sink.items[0].at.end, 0); // it is about the whole file
    // Now the bottom looks down, and each corner kept its normal.
    vec3 normal = vec3_cross(vec3_sub(corner(mesh, 0, 1), corner(mesh, 0, 0)),
                             vec3_sub(corner(mesh, 0, 2), corner(mesh, 0, 0)));
    assert_true(normal.z < 0 && normal.x == 0 && normal.y == 0);
    for (int k = 0; k < 3; k++) {
        uint32_t expected = mesh->triangles[0].corners[k] == 0   ? 0
                            : mesh->triangles[0].corners[k] == 1 ? 1
                                                                 : IR_NO_INDEX;
        assert_int_equal(mesh->triangles[0].normals[k], expected);
    }
    assets_scene_end(s);
}

// To the last digits, for edges along no axis.
static void a_volume_is_exact(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    // (3 1 0) x (0 3 1) . (1 0 3) = 28, in sevenths; far from 0.
    const struct mesh *mesh = assets_scene_mesh(s, "v 1 1 1\nv 1.42857142857142857 1.14285714285714286 1\n"
                                                   "v 1 1.42857142857142857 1.14285714285714286\n"
                                                   "v 1.14285714285714286 1 1.42857142857142857\n"
                                                   "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    assert_true(fabs(mesh->volume - 28.0 / 343 / 6) < 1e-15);
    assets_scene_end(s);
}

static void the_side_is_known_at_any_size_and_place(void **state) {
    (void)state;
    static const struct {
        double size, at;
    } cases[] = {{1e-150, 0}, {1e-18, 0}, {1e17, 0}, {1, 1e9}, {1024, -1e12}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int inward = 0; inward < 2; inward++) {
            struct assets_scene *s = assets_scene_begin();
            double a = cases[i].at;
            double b = a + cases[i].size;
            str text = arena_format(
                &s->arena, "v %.17g 0 0\nv %.17g 0 0\nv %.17g %.17g 0\nv %.17g 0 %.17g\n%s", a, b, a,
                cases[i].size, a, cases[i].size,
                inward ? "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n" : "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
            const struct mesh *mesh = assets_scene_mesh(s, text.ptr);
            assert_true(mesh->closed);
            assert_int_equal(mesh->turned, inward);
            assert_int_equal(mesh->zero_area, 0);
            assets_scene_end(s);
        }
    }
}

static void a_sheet_with_a_back_is_not_turned(void **state) {
    (void)state;
    for (int order = 0; order < 2; order++) {
        struct assets_scene *s = assets_scene_begin();
        static const char *const vertices = "v 0.1 0.2 0.7\nv 1.3 0 0.4\nv 0 1.7 .9\nv 0.3 .6 -.2\n";
        str text = arena_format(&s->arena, "%s%s", vertices,
                                order ? "f 1 2 3\nf 1 3 4\nf 3 2 1\nf 4 3 1\n"
                                      : "f 3 2 1\nf 4 3 1\nf 1 2 3\nf 1 3 4\n");
        const struct mesh *mesh = assets_scene_mesh(s, text.ptr);
        assert_silent(s);
        assert_true(mesh->closed);
        assert_false(mesh->turned);
        assets_scene_end(s);
    }
}

static void triangles_without_area_are_counted(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh =
        assets_scene_mesh(s, "v 0 0 0\nv 1 1 1\nv 2 2 2\nv 1 0 0\nf 1 2 3\nf 1 1 2\nf 4 4 4\nf 1 2 4\n");
    assert_int_equal(mesh->triangle_count, 4);
    assert_int_equal(mesh->zero_area, 3);
    assert_false(mesh_has_area(mesh, 0));
    assert_true(mesh_has_area(mesh, 3));
    assets_scene_end(s);
}

// ---- normals

static void assert_near(vec3 a, vec3 b) {
    if (!(vec3_length(vec3_sub(a, b)) < 1e-12))
        fail_msg("(%.17g %.17g %.17g) is not (%.17g %.17g %.17g)", a.x, a.y, a.z, b.x, b.y, b.z);
}

// Weighted by angle, the diagonals of the sides do not show: the corners of a cube look along its diagonals.
static void a_smooth_cube_looks_along_its_diagonals(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, CUBE);
    const vec3 *normals = mesh_smooth_normals(mesh, 180, &s->arena);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            assert_near(normals[3 * t + (uint32_t)k],
                        vec3_unit(vec3_sub(corner(mesh, t, k), (vec3){0.5, 0.5, 0.5})));
    assets_scene_end(s);
}

// Edges of exactly the crease angle are not sharper than it.
static void a_creased_cube_has_edges(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, CUBE);
    const vec3 *creased = mesh_smooth_normals(mesh, 89.9, &s->arena);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        const vec3 face = vec3_unit(vec3_cross(vec3_sub(corner(mesh, t, 1), corner(mesh, t, 0)),
                                               vec3_sub(corner(mesh, t, 2), corner(mesh, t, 0))));
        for (uint32_t k = 0; k < 3; k++)
            assert_near(creased[3 * t + k], face);
    }
    assert_memory_equal(mesh_smooth_normals(mesh, 90, &s->arena), mesh_smooth_normals(mesh, 180, &s->arena),
                        3 * mesh->triangle_count * sizeof(vec3));
    assets_scene_end(s);
}

// Eight faces around a peak. Edges come in the order of their ends: pairs of faces are joined, then pairs of
// pairs, then all.
static void faces_are_joined_in_any_order(void **state) {
    (void)state;
    static const int ends[9] = {1, 3, 5, 7, 2, 6, 4, 0, 8}; // the spoke of each vertex on the rim
    int vertex[9];
    struct assets_scene *s = assets_scene_begin();
    struct strbuf text;
    strbuf_init(&text);
    strbuf_cstr(&text, "v 0 0.25 0\n");
    for (int i = 0; i < 9; i++) {
        const double angle = 40 * RADIANS * ends[i];
        strbuf_format(&text, "v %.17g 0 %.17g\n", cos(angle), -sin(angle));
        vertex[ends[i]] = i + 2;
    }
    for (int i = 0; i < 8; i++)
        strbuf_format(&text, "f 1 %d %d\n", vertex[i], vertex[i + 1]);
    const struct mesh *mesh = assets_scene_mesh(s, text.data);
    const vec3 *creased = mesh_smooth_normals(mesh, 40, &s->arena),
               *all = mesh_smooth_normals(mesh, 180, &s->arena);
    for (uint32_t i = 0; i < 3 * 8; i++)
        assert_near(creased[i], all[i]);
    strbuf_finish(&text);
    assets_scene_end(s);
}

// Two flat faces, and a wing that an edge of 60 degrees joins to one of them.
static void creases_end_inside_a_fan(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, "v 0 0 0\nv 1 0 0\nv 0 0 -1\nv 0 0.86602540378 0.5\n"
                                                   "v -1 0 0\nf 1 2 3\nf 1 4 2\nf 1 3 5\n");
    const vec3 *normals = mesh_smooth_normals(mesh, 59, &s->arena);
    assert_near(normals[0], (vec3){0, 1, 0});
    assert_true(vec3_length(vec3_sub(normals[3], (vec3){0, 0.5, -0.86602540378})) < 1e-9);
    assert_near(normals[6], (vec3){0, 1, 0});
    const vec3 *joined = mesh_smooth_normals(mesh, 180, &s->arena);
    assert_true(vec3_length(vec3_sub(joined[0], normals[0])) > 0.1);
    assets_scene_end(s);
}

// A ridge over x = 0 between a flat half and a wall: at the ends of the ridge the flat half has two
// triangles, with 45 degrees each, and the wall one of 90 and one of 45 + 45; all weigh as much as their
// angle.
static void angles_weigh(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 0 -1 0\n"
                                                   "f 1 2 3\nf 1 3 4\nf 2 1 5\n");
    const vec3 *normals = mesh_smooth_normals(mesh, 180, &s->arena);
    double quarter = acos(0); // 90 degrees
    // At vertex 1: up with 45 + 45, towards -x with 90.
    assert_near(normals[0], vec3_unit((vec3){-quarter, quarter, 0}));
    assert_near(normals[7], normals[0]);
    // At vertex 2: up with 90, towards -x with 45.
    assert_near(normals[1], vec3_unit((vec3){-quarter / 2, quarter, 0}));
    // At vertex 5 the wall is alone.
    assert_near(normals[8], (vec3){-1, 0, 0});
    assets_scene_end(s);
}

static void split_vertices_are_summed_too(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 0 0\nv 0 -1 0\nv 0 0 1\n"
                                                   "f 1 2 3\nf 4 5 6\n");
    const vec3 *normals = mesh_smooth_normals(mesh, 180, &s->arena);
    assert_near(normals[0], vec3_unit((vec3){-1, 1, 0}));
    assert_near(normals[3], normals[0]);
    assets_scene_end(s);
}

static void normals_of_the_file_are_kept(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh =
        assets_scene_mesh(s, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 3 0 4\nvn 0 0 0\nf 1//1 2//2 3\n");
    const vec3 *normals = mesh_smooth_normals(mesh, 180, &s->arena);
    assert_near(normals[0], (vec3){0.6, 0, 0.8});
    assert_near(normals[1], (vec3){0, 0, 1});
    assert_near(normals[2], (vec3){0, 0, 1});
    assets_scene_end(s);
}

// One corner without a normal is enough, whichever it is.
static void a_lacking_normal_is_computed(void **state) {
    (void)state;
    static const char *const faces[] = {"f 1 2//1 3//1\n", "f 1//1 2 3//1\n", "f 1//1 2//1 3\n"};
    for (uint32_t k = 0; k < 3; k++) {
        struct assets_scene *s = assets_scene_begin();
        str text = arena_format(&s->arena, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 3 0 4\n%s", faces[k]);
        const vec3 *normals = mesh_smooth_normals(assets_scene_mesh(s, text.ptr), 180, &s->arena);
        for (uint32_t i = 0; i < 3; i++)
            assert_near(normals[i], i == k ? (vec3){0, 0, 1} : (vec3){0.6, 0, 0.8});
        assets_scene_end(s);
    }
}

static void what_cancels_is_zero(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, "v 0.1 0.2 0.7\nv 1.3 0 0.4\nv 0 1.7 .9\nv 1 1 1\n"
                                                   "f 1 2 3\nf 3 2 1\nf 4 4 4\n");
    const vec3 *normals = mesh_smooth_normals(mesh, 180, &s->arena);
    for (uint32_t i = 0; i < 9; i++)
        assert_true(vec3_is_zero(normals[i]));
    assets_scene_end(s);
}

// One face against two that fill its angle from behind: what is left is only rounding, and no direction.
static void rounding_is_no_normal(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, "v .1 .2 .3\nv .8 .3 .7\nv -.1 1.1 .8\nv .4 .475 .625\n"
                                                   "f 1 2 3\nf 1 4 2\nf 1 3 4\n");
    const vec3 *normals = mesh_smooth_normals(mesh, 180, &s->arena);
    for (uint32_t t = 0; t < 3; t++)
        assert_true(vec3_is_zero(normals[3 * t]));
    assets_scene_end(s);
}

// Two faces back to back, but for an angle of 2^-20: their sum is small, and has a direction.
static void a_small_sum_is_a_normal(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh =
        assets_scene_mesh(s, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 1 0.00000095367431640625\nf 1 2 3\nf 1 4 2\n");
    const vec3 *normals = mesh_smooth_normals(mesh, 180, &s->arena);
    assert_true(vec3_length(vec3_sub(normals[0], (vec3){0, cos(0x1p-21), sin(0x1p-21)})) < 1e-9);
    assets_scene_end(s);
}

// A needle of 2^-30 with its point first: the normal is known from its right angle, not from its point.
static void a_needle_has_an_exact_normal(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(
        s, "v 0 0 0\nv 3 1 2\nv 3.000000000931322574615478515625 0.999999999068677425384521484375 "
           "1.999999999068677425384521484375\nf 1 2 3\n");
    const vec3 *normals = mesh_smooth_normals(mesh, 180, &s->arena);
    assert_near(normals[0], vec3_unit((vec3){1, 5, -4}));
    assets_scene_end(s);
}

// Moved by 2^20 and scaled by 2^-20: the same bits.
static void normals_move_and_scale_exactly(void **state) {
    (void)state;
    vec3 first[36];
    for (int round = 0; round < 3; round++) {
        struct assets_scene *s = assets_scene_begin();
        struct strbuf text;
        strbuf_init(&text);
        double scale = round == 1 ? 0x1p-20 : 1;
        double move = round == 2 ? 0x1p20 : 0;
        static const double points[8][3] = {{0, 0, 0},    {1.25, 0, .5}, {1, 1.5, 0}, {0, 1, .25},
                                            {.125, 0, 1}, {1, .75, 1},   {1, 1, 1.5}, {0, 1.0625, 1}};
        for (int i = 0; i < 8; i++)
            strbuf_format(&text, "v %.17g %.17g %.17g\n", points[i][0] * scale + move,
                          points[i][1] * scale + move, points[i][2] * scale + move);
        strbuf_cstr(&text, CUBE_SIDES "f 4 1 5 8\n");
        const struct mesh *mesh = assets_scene_mesh(s, text.data);
        const vec3 *normals = mesh_smooth_normals(mesh, 180, &s->arena);
        if (round == 0)
            memcpy(first, normals, sizeof first);
        assert_memory_equal(first, normals, sizeof first);
        strbuf_finish(&text);
        assets_scene_end(s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_is_closed),
        cmocka_unit_test(equal_positions_are_one),
        cmocka_unit_test(nearly_equal_positions_are_not),
        cmocka_unit_test(a_missing_face_opens),
        cmocka_unit_test(one_turned_face_opens),
        cmocka_unit_test(edges_are_counted_by_direction),
        cmocka_unit_test(inside_out_is_turned),
        cmocka_unit_test(the_side_is_known_at_any_size_and_place),
        cmocka_unit_test(a_sheet_with_a_back_is_not_turned),
        cmocka_unit_test(triangles_without_area_are_counted),
        cmocka_unit_test(a_smooth_cube_looks_along_its_diagonals),
        cmocka_unit_test(a_creased_cube_has_edges),
        cmocka_unit_test(creases_end_inside_a_fan),
        cmocka_unit_test(faces_are_joined_in_any_order),
        cmocka_unit_test(angles_weigh),
        cmocka_unit_test(split_vertices_are_summed_too),
        cmocka_unit_test(normals_of_the_file_are_kept),
        cmocka_unit_test(a_volume_is_exact),
        cmocka_unit_test(a_lacking_normal_is_computed),
        cmocka_unit_test(what_cancels_is_zero),
        cmocka_unit_test(rounding_is_no_normal),
        cmocka_unit_test(a_small_sum_is_a_normal),
        cmocka_unit_test(a_needle_has_an_exact_normal),
        cmocka_unit_test(normals_move_and_scale_exactly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
