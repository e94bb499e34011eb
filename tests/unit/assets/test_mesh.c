// Reading OBJ: forms of lines, numbers, indices, groups, and every fault at its place.
#include "assets_scene.h"
#include "diag/codes/file.h"

#include <math.h>
#include <stdio.h>

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void assert_vec(vec3 v, double x, double y, double z) {
    if (v.x != x || v.y != y || v.z != z)
        fail_msg("(%.17g %.17g %.17g) is not (%.17g %.17g %.17g)", v.x, v.y, v.z, x, y, z);
}

static void a_triangle_is_read(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, "# a comment\n\n" TRIANGLE "\tf  1 2\t3  # behind\n");
    assert_silent(s);
    assert_int_equal(mesh->triangle_count, 1);
    assert_int_equal(mesh->face_count, 1);
    assert_int_equal(mesh->triangles[0].line, 6);
    assert_int_equal(mesh->triangles[0].normals[1], IR_NO_INDEX);
    assert_vec(mesh->positions[mesh->triangles[0].corners[2]], 0, 1, 0);
    assert_vec(mesh->upper, 1, 1, 0);
    assert_false(mesh->closed);
    assert_int_equal(mesh->open_edges, 3);
    assert_int_equal(s->assets.triangle_count, 1);
    assets_scene_end(s);
}

static void every_line_end_and_a_missing_one_are_read(void **state) {
    (void)state;
    static const char *const texts[] = {
        "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\n\r\nf 1 2 3\r\n",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\r\rf 1 2 3\r",
        "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 3",
        "v 0 0 0\nv 1 \\\n0 0\nv 0 1 0\nf 1 \\\r\n2 3",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct assets_scene *s = assets_scene_begin();
        const struct mesh *mesh = assets_scene_mesh(s, texts[i]);
        assert_silent(s);
        assert_int_equal(mesh->triangle_count, 1);
        assert_int_equal(mesh->triangles[0].line, 5);
        assert_vec(mesh->positions[1], 1, 0, 0);
        assets_scene_end(s);
    }
}

static void a_comment_does_not_continue(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, "# C:\\\n" TRIANGLE "f 1 2 3\n");
    assert_silent(s);
    assert_int_equal(mesh->triangles[0].line, 5);
    assets_scene_end(s);
}

static void numbers_are_exact(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double value;
    } cases[] = {
        {"1.", 1},
        {".5", 0.5},
        {"+3", 3},
        {"007.25", 7.25},
        {"-0", 0},
        {"1e3", 1000},
        {"-1.5E-3", -0.0015},
        {"0.1", 0.1},
        {"123456789.123456789", 123456789.123456789},
        {"0.12345678901234567", 0.12345678901234567},
        {"9007199254740993", 9007199254740992.0}, // a tie, to even
        {"0.3000000000000000444089209850062616169452667236328125", 0.30000000000000004},
        {"4.35", 4.35},
        {"1e-22", 1e-22},
        {"1e-23", 1e-23},
        {"1000000000000000000", 1e18},
        {"1e-400", 0},
        {"2.2250738585072011e-308", 2.2250738585072011e-308},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct assets_scene *s = assets_scene_begin();
        str text = arena_format(&s->arena, "v 0 0 %s\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", cases[i].text);
        const struct mesh *mesh = assets_scene_mesh(s, text.ptr);
        assert_silent(s);
        if (mesh->positions[0].z != cases[i].value ||
            signbit(mesh->positions[0].z) != signbit(cases[i].value))
            fail_msg("%s read as %.17g", cases[i].text, mesh->positions[0].z);
        assets_scene_end(s);
    }
}

static void random_numbers_read_as_strtod_does(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    struct strbuf text;
    strbuf_init(&text);
    static double expected[3000];
    uint64_t random = 88172645463325252u;
    for (int i = 0; i < 3000; i++) {
        random ^= random << 13, random ^= random >> 7, random ^= random << 17;
        char word[64];
        double value = ((double)(random >> 11) / 9007199254740992.0 - 0.5) * pow(10, (int)(random % 30) - 15);
        snprintf(word, sizeof word, i % 2 ? "%.*e" : "%.*f", (int)(random >> 32) % 20, value);
        expected[i] = strtod(word, NULL) + 0.0;
        strbuf_format(&text, "%s%s%s", i % 3 ? " " : "v ", word, i % 3 == 2 ? "\n" : "");
    }
    for (int i = 1; i <= 998; i++)
        strbuf_format(&text, "f %d %d %d\n", i, i + 1, i + 2);
    const struct mesh *mesh = assets_scene_mesh(s, text.data);
    assert_silent(s);
    for (int i = 0; i < 1000; i++)
        assert_vec(mesh->positions[i], expected[3 * i], expected[3 * i + 1], expected[3 * i + 2]);
    strbuf_finish(&text);
    assets_scene_end(s);
}

static void corners_take_all_their_forms(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh =
        assets_scene_mesh(s, TRIANGLE "vt 0 0\nvn 0 0 2\nvn 0 0 0\n"
                                      "f 1 2 3\nf 1/1 2/1 3/1\nf 1//1 2//1 3//2\n"
                                      "f 1/1/1 2/9/1 3/1/-2\nf -3 -2 -1\nf 1// 2/1/ 3/\n");
    assert_silent(s);
    assert_int_equal(mesh->triangle_count, 6);
    for (uint32_t i = 0; i < 6; i++)
        for (uint32_t k = 0; k < 3; k++)
            assert_int_equal(mesh->triangles[i].corners[k], k);
    assert_int_equal(mesh->triangles[1].normals[0], IR_NO_INDEX);
    assert_int_equal(mesh->triangles[2].normals[0], 0);
    assert_int_equal(mesh->triangles[2].normals[2], IR_NO_INDEX); // of length 0
    assert_int_equal(mesh->triangles[3].normals[2], 0);
    assert_vec(mesh->normals[0], 0, 0, 1);
    assets_scene_end(s);
}

static void a_weight_after_a_vertex_is_ignored(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, "v 0 0 0 1\nv 1 0 0 0.5\nv 0 1 0\nf 1 2 3\n");
    assert_silent(s);
    assert_vec(mesh->positions[1], 1, 0, 0);
    assets_scene_end(s);
}

static void a_colour_after_a_vertex_is_told(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, "v 0 0 0 1\nv 1 0 0 .5 .5 .5\nv 0 1 0 1 0 0 1\nf 1 2 3\n");
    assert_int_equal(s->sink.count, 1);
    assert_says(s, "mesh.obj:2:1: warning: the colours of 2 vertices are not drawn [W606]");
    assert_vec(mesh->positions[1], 1, 0, 0);
    assets_scene_end(s);
}

static void images_of_faces_are_told(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    assert_non_null(assets_scene_mesh(s, TRIANGLE "usemap a.png\nf 1 2 3\nusemap off\nmaplib b\n"));
    assert_int_equal(s->sink.count, 1);
    assert_says(s, "mesh.obj:4:1: warning: the image of 1 'usemap' line is not drawn [W606]");
    assets_scene_end(s);
}

// Where a file of six digits rounds, and whatever the size.
static void faces_that_are_flat_enough_are_not_told(void **state) {
    static const char *const flat[] = {
        "v 0 0 0\nv 1 0 0\nv 1 1 0.003\nv 0 1 0\nf 1 2 3 4\n",
        "v 0 0 1000\nv 0.01 0 1000\nv 0.01 0.01 1000.001\nv 0 0.01 1000\nf 1 2 3 4\n",
        "v 0 0 0\nv 1e-9 0 0\nv 1e-9 1e-9 0\nv 0 1e-9 0\nf 1 2 3 4\n",
        "v 0 0 0\nv 1 0 0\nv 0 0 0\nv 1 0 0\nf 1 2 3 4\n",
    };
    (void)state;
    for (size_t i = 0; i < sizeof flat / sizeof flat[0]; i++) {
        struct assets_scene *s = assets_scene_begin();
        assert_non_null(assets_scene_mesh(s, flat[i]));
        assert_silent(s);
        assets_scene_end(s);
    }
}

static void vertices_may_follow_their_face(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, "f 1//1 2//1 3//1\n" TRIANGLE "vn 0 0 1\n");
    assert_silent(s);
    assert_int_equal(mesh->triangle_count, 1);
    assets_scene_end(s);
}

static void unused_positions_are_dropped(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(s, "v 9 9 9\n" TRIANGLE "v -9 -9 -9\nf 2 3 4\n");
    assert_int_equal(mesh->position_count, 3);
    assert_vec(mesh->lower, 0, 0, 0);
    assert_vec(mesh->upper, 1, 1, 0);
    assert_vec(mesh->positions[mesh->triangles[0].corners[1]], 1, 0, 0);
    assets_scene_end(s);
}

static void faces_are_grouped_by_material(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    s->scene.models.count = 0;
    assets_scene_material(s, "own", 0);
    assets_scene_file(s, "mesh.obj",
                      TRIANGLE
                      "f 1 2 3\nusemtl Material #25\nf 1 2 3\nusemtl unused\nusemtl  red \nf 1 2 3\n"
                      "usemtl Material #25\nf 1 2 3\nusemtl\nf 1 2 3\ng part\no thing\ns off\nf 1 2 3\n");
    assets_scene_model(s, "mesh.obj")->material.index = 0;
    assets_scene_load(s);
    assert_silent(s);
    const struct mesh *mesh = s->assets.models[0].mesh;
    static const uint32_t groups[] = {0, 1, 2, 1, 0, 0};
    for (uint32_t i = 0; i < 6; i++)
        assert_int_equal(mesh->triangles[i].group, groups[i]);
    assert_int_equal(mesh->group_count, 3);
    assert_true(str_equal_cstr(mesh->groups[0].name, ""));
    assert_true(str_equal_cstr(mesh->groups[1].name, "Material #25"));
    assert_true(str_equal_cstr(mesh->groups[2].name, "red"));
    assert_int_equal(mesh->groups[1].line, 5);
    assets_scene_end(s);
}

static void points_and_curves_are_one_warning(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = assets_scene_mesh(
        s, TRIANGLE "f 1 2 3\n  l 1 2 \\\n 3\np 1\ncstype bezier\ndeg 3\ncurv 0 1 1 2 3\nparm u 0 1\nend\n");
    assert_non_null(mesh);
    assert_int_equal(s->sink.count, 1);
    assert_says(s, "mesh.obj:5:3: warning: 3 points, lines or curves are not drawn [W606]");
    assert_says(s, "scene.yaml:1:7: note: the mesh is named here");
    assets_scene_end(s);
}

// ---- faults

static void expect(const char *text, const char *message) {
    struct assets_scene *s = assets_scene_begin();
    assert_null(assets_scene_mesh(s, text));
    assert_says(s, message);
    assert_says(s, "scene.yaml:1:7: note: the mesh is named here");
    assert_int_equal(s->sink.errors, 1);
    assert_int_equal(s->assets.triangle_count, 0);
    assets_scene_end(s);
}

static void bad_numbers_are_shown(void **state) {
    (void)state;
    expect("v 0 nan 0\n" TRIANGLE "f 1 2 3\n", "mesh.obj:1:5: error: 'nan' is not a finite number [E611]\n"
                                               "     1 | v 0 nan 0\n"
                                               "       |     ^~~\n");
    expect(TRIANGLE "v -inf 0 0\nf 1 2 3\n", "mesh.obj:4:3: error: '-inf' is infinite");
    expect(TRIANGLE "v 0,5 0 0\nf 1 2 3\n", "mesh.obj:4:3: error: '0,5' has a decimal comma");
    expect(TRIANGLE "v 0 0 0x10\nf 1 2 3\n", "mesh.obj:4:7: error: '0x10' is hexadecimal");
    expect(TRIANGLE "v 0 0 1e19\nf 1 2 3\n", "mesh.obj:4:7: error: '1e19' is larger than 1e18");
    expect(TRIANGLE "v 0 0 1e999\nf 1 2 3\n", "mesh.obj:4:7: error: '1e999' is too large");
    expect(TRIANGLE "v 0 0 1.2.3\nf 1 2 3\n", "mesh.obj:4:7: error: '1.2.3' is not a number");
    expect(TRIANGLE "v 0 0 1e\nf 1 2 3\n", "mesh.obj:4:7: error: '1e'");
    expect(TRIANGLE "vn 0 0 x\nf 1 2 3\n", "mesh.obj:4:8: error: 'x' is not a number [E611]");
    expect(TRIANGLE "v 0 0\nf 1 2 3\n", "mesh.obj:4:1: error: 'v' needs three numbers [E610]");
}

static void bad_indices_are_shown(void **state) {
    (void)state;
    expect(TRIANGLE "f 1 2 4\n", "mesh.obj:4:7: error: index 4: the file defines 3 vertices [E612]\n"
                                 "     4 | f 1 2 4\n"
                                 "       |       ^\n");
    expect(TRIANGLE "f 1 0 3\n", "mesh.obj:4:5: error: index 0: vertices count from 1 [E612]");
    expect(TRIANGLE "f -1 -2 -4\n",
           "mesh.obj:4:9: error: index -4 goes back further than the 3 vertices so far [E612]");
    expect(TRIANGLE "vn 0 0 1\n f 1//1 2//2 3//1\n",
           "mesh.obj:5:12: error: index 2: the file defines 1 normals [E612]");
    expect(TRIANGLE "f 1 2 \\\n 99999999999999999999\n", "mesh.obj:5:2: error: index");
    expect(TRIANGLE "f 1 2 \\\n 77\n", "mesh.obj:5:2: error: index 77: the file defines 3 vertices [E612]");
}

#define LONG_WORD "3abcdefghijklmnopqrstuvwxyz01234"

static void bad_lines_are_shown(void **state) {
    (void)state;
    expect(TRIANGLE "f 1 2\n", "mesh.obj:4:1: error: a face with 2 corners [E613]");
    expect(TRIANGLE "f\nf 1 2 3\n", "mesh.obj:4:1: error: a face with 0 corners [E613]");
    expect(TRIANGLE "f 1 2 3x\n",
           "mesh.obj:4:7: error: '3x' is not a corner; write V, V/VT, V//VN or V/VT/VN [E610]");
    expect(TRIANGLE "f 1 2 3/1/1/1\n", "mesh.obj:4:7: error: '3/1/1/1' is not a corner");
    expect(TRIANGLE "f 1 2 3/a\n", "mesh.obj:4:7: error: '3/a' is not a corner");
    expect(TRIANGLE "f 1 2 1.5\n", "mesh.obj:4:7: error: '1.5' is not a corner");
    expect(TRIANGLE "wow 1\nf 1 2 3\n",
           "mesh.obj:4:1: error: 'wow' cannot begin a line of an OBJ file [E610]");
    // Of a word that may be a whole binary file, the beginning.
    expect(TRIANGLE "f 1 2 " LONG_WORD LONG_WORD LONG_WORD "\n",
           "mesh.obj:4:7: error: '" LONG_WORD LONG_WORD "' is not a corner");
    expect(TRIANGLE, "mesh.obj:1:1: error: the mesh has no faces [E614]");
    expect("", "mesh.obj:1:1: error: the mesh has no faces [E614]");
    expect(TRIANGLE "\x1b[31m\xff\n", "mesh.obj:4:1: error: '?[31m?' cannot begin a line");
}

static void each_of_many_faults_has_its_place(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    struct strbuf text;
    strbuf_init(&text);
    strbuf_cstr(&text, TRIANGLE "v nan nan nan\nf 1 2\nf 1 2\nf 1 2 9\n");
    for (int i = 0; i < 1000; i++)
        strbuf_cstr(&text, "f 1 2 7\n");
    assert_null(assets_scene_mesh(s, text.data));
    assert_int_equal(assets_scene_count(s, DIAG_MESH_NUMBER), 3);
    assert_int_equal(assets_scene_count(s, DIAG_MESH_FACE), 2);
    assert_int_equal(assets_scene_count(s, DIAG_MESH_INDEX), 1001);
    assert_int_equal(s->sink.errors, 1006);
    assert_says(s, "mesh.obj:1007:7: error: index 7: the file defines 4 vertices [E612]");
    strbuf_finish(&text);
    assets_scene_end(s);
}

static void limits_are_kept(void **state) {
    (void)state;
    static const struct {
        enum limit limit;
        uint64_t value;
        const char *text;
        const char *message;
        const char *help;
    } cases[] = {
        {LIMIT_MESH_CORNERS, 4, TRIANGLE "f 1 2 3 1\nf 1 2 3 1 2\n",
         "mesh.obj:5:1: error: the mesh exceeds the limit mesh-corners of 4 [E501]",
         "--limit mesh-corners=8"},
        {LIMIT_MESH_TRIANGLES, 3, TRIANGLE "f 1 2 3\nf 1 2 3 1\nf 1 2 3\n",
         "mesh.obj:6:1: error: the mesh exceeds the limit mesh-triangles of 3 [E501]",
         "--limit mesh-triangles=6"},
        {LIMIT_MESH_BYTES, 20, TRIANGLE "f 1 2 3\n",
         "scene.yaml:1:7: error: the mesh 'mesh.obj' has 32 bytes; the limit mesh-bytes is 20 [E501]",
         "--limit mesh-bytes=32"},
        {LIMIT_MESH_MEMORY, 100, TRIANGLE "f 1 2 3\n",
         "scene.yaml:1:7: error: the mesh 'mesh.obj' needs more memory than the limit mesh-memory of 100 "
         "bytes [E501]",
         "--limit mesh-memory=BYTES"},
        {LIMIT_SCENE_TRIANGLES, 1, TRIANGLE "f 1 2 3 1\n",
         "scene.yaml:1:7: error: with this mesh of 2 triangles the scene has 2; the limit scene-triangles is "
         "1 [E501]",
         "--limit scene-triangles=2"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct assets_scene *s = assets_scene_begin();
        s->limits.value[cases[i].limit] = cases[i].value;
        assert_null(assets_scene_mesh(s, cases[i].text));
        assert_says(s, cases[i].message);
        assert_says(s, cases[i].help);
        assert_int_equal(s->sink.errors, 1);
        assets_scene_end(s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_triangle_is_read),
        cmocka_unit_test(every_line_end_and_a_missing_one_are_read),
        cmocka_unit_test(a_comment_does_not_continue),
        cmocka_unit_test(numbers_are_exact),
        cmocka_unit_test(random_numbers_read_as_strtod_does),
        cmocka_unit_test(corners_take_all_their_forms),
        cmocka_unit_test(a_weight_after_a_vertex_is_ignored),
        cmocka_unit_test(a_colour_after_a_vertex_is_told),
        cmocka_unit_test(images_of_faces_are_told),
        cmocka_unit_test(faces_that_are_flat_enough_are_not_told),
        cmocka_unit_test(vertices_may_follow_their_face),
        cmocka_unit_test(unused_positions_are_dropped),
        cmocka_unit_test(faces_are_grouped_by_material),
        cmocka_unit_test(points_and_curves_are_one_warning),
        cmocka_unit_test(bad_numbers_are_shown),
        cmocka_unit_test(bad_indices_are_shown),
        cmocka_unit_test(bad_lines_are_shown),
        cmocka_unit_test(each_of_many_faults_has_its_place),
        cmocka_unit_test(limits_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
