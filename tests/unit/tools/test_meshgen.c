// The proofs of glint-meshgen find every flaw that they are there for, and its outlines are cut whole.
#include "core/angle.h"
#include "tools/meshgen/mesh.h"
#include "tools/meshgen/outline.h"
#include "tools/meshgen/verify.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// A tetrahedron of volume 1/6, outward.
static void add_tetrahedron(struct mesh *mesh, double shift_x) {
    int o = mesh_vertex(mesh, (vec3){shift_x, 0, 0}), x = mesh_vertex(mesh, (vec3){shift_x + 1, 0, 0});
    int y = mesh_vertex(mesh, (vec3){shift_x, 1, 0}), z = mesh_vertex(mesh, (vec3){shift_x, 0, 1});
    mesh_triangle(mesh, o, y, x);
    mesh_triangle(mesh, o, x, z);
    mesh_triangle(mesh, o, z, y);
    mesh_triangle(mesh, x, y, z);
}

static struct verify_result verified(struct mesh *mesh) {
    struct verify_result result;
    assert_true(verify_mesh(mesh, &result));
    mesh_finish(mesh);
    return result;
}

static void whole_mesh_passes(void **state) {
    (void)state;
    struct mesh mesh;
    mesh_init(&mesh);
    add_tetrahedron(&mesh, 0);
    add_tetrahedron(&mesh, 5);
    struct verify_result result = verified(&mesh);
    assert_true(verify_passed(&result));
    assert_int_equal(result.parts, 2);
    assert_true(fabs(result.volume - 1.0 / 3) < 1e-12);
}

static void missing_face_is_found(void **state) {
    (void)state;
    struct mesh mesh;
    mesh_init(&mesh);
    add_tetrahedron(&mesh, 0);
    mesh.face_count--;
    struct verify_result result = verified(&mesh);
    assert_int_equal(result.open_edges, 3);
    assert_false(verify_passed(&result));
}

static void inward_part_is_found(void **state) {
    (void)state;
    struct mesh mesh;
    mesh_init(&mesh);
    add_tetrahedron(&mesh, 0);
    add_tetrahedron(&mesh, 5);
    for (int f = 4; f < 8; f++) {
        int swapped = mesh.faces[f].corners[0];
        mesh.faces[f].corners[0] = mesh.faces[f].corners[1];
        mesh.faces[f].corners[1] = swapped;
    }
    struct verify_result result = verified(&mesh);
    assert_int_equal(result.open_edges, 0);
    assert_int_equal(result.inward_parts, 1);
    assert_false(verify_passed(&result));
}

static void bent_and_flat_faces_are_found(void **state) {
    (void)state;
    struct mesh mesh;
    mesh_init(&mesh);
    int a = mesh_vertex(&mesh, (vec3){0, 0, 0}), b = mesh_vertex(&mesh, (vec3){1, 0, 0});
    int c = mesh_vertex(&mesh, (vec3){1, 1, 0.1}), d = mesh_vertex(&mesh, (vec3){0, 1, 0});
    int e = mesh_vertex(&mesh, (vec3){0.5, 0, 0});
    mesh_quad(&mesh, a, b, c, d);
    mesh_triangle(&mesh, a, e, b);
    struct verify_result result = verified(&mesh);
    assert_int_equal(result.flat_triangles, 1);
    assert_int_equal(result.bent_faces, 2);
}

static void inward_normal_is_found(void **state) {
    (void)state;
    struct mesh mesh;
    mesh_init(&mesh);
    int a = mesh_vertex_normal(&mesh, (vec3){0, 0, 0}, (vec3){0, 0, 1});
    int b = mesh_vertex_normal(&mesh, (vec3){1, 0, 0}, (vec3){0, 0, -1});
    int c = mesh_vertex_normal(&mesh, (vec3){0, 1, 0}, (vec3){0, 0.1, 1});
    mesh_triangle(&mesh, a, b, c);
    assert_int_equal(verified(&mesh).bad_normals, 1);
}

// A square of side 4 with a round hole of radius 1: the triangles' areas add up to what is left.
static void outline_with_a_hole_is_cut_whole(void **state) {
    (void)state;
    static struct outline outline;
    static int triangles[OUTLINE_TRIANGLES_MAX][3];
    outline_init(&outline);
    outline_point(&outline, -2, -2);
    outline_point(&outline, 2, -2);
    outline_point(&outline, 2, 2);
    outline_point(&outline, -2, 2);
    outline_close(&outline);
    outline_arc(&outline, (vec2){0, 0}, 1, 0, -360);
    outline_close(&outline);
    int hole_points = outline.starts[2] - outline.starts[1];
    int count = outline_triangulate(&outline, 0, triangles);
    assert_int_equal(count, 4 + hole_points);
    double area = 0;
    for (int i = 0; i < count; i++) {
        vec2 a = outline.points[triangles[i][0]], b = outline.points[triangles[i][1]];
        vec2 c = outline.points[triangles[i][2]];
        double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        assert_true(twice > 0);
        area += 0.5 * twice;
    }
    double hole = 0.5 * hole_points * sin(2 * PI / hole_points);
    assert_true(fabs(area - (16 - hole)) < 1e-9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_mesh_passes),      cmocka_unit_test(missing_face_is_found),
        cmocka_unit_test(inward_part_is_found),   cmocka_unit_test(bent_and_flat_faces_are_found),
        cmocka_unit_test(inward_normal_is_found), cmocka_unit_test(outline_with_a_hole_is_cut_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
