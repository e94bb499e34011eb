// PLY and STL: the same mesh from every form of file, what is said of wrong ones, and files that are damaged.
#include "assets_scene.h"
#include "core/splitmix.h"
#include "diag/codes/file.h"
#include "mesh_kit.h"

#include <math.h>
#include <stdio.h>

// A cube, one side of which is two triangles.
static const double cube_positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, -0.0, 1, 0,
                                        0, 0, 1, 1, 0, 1, 1, 1, 1, 0,    1, 1.25};
static const uint32_t cube_corners[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1,
                                        2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 3, 4, 7};
static const uint32_t cube_counts[] = {4, 4, 4, 4, 4, 3, 3};
// STL has triangles only.
static const uint32_t cut_corners[] = {0, 3, 2, 0, 2, 1, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                       1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

static struct mesh_kit cube(bool single, bool extras, bool cut) {
    return (struct mesh_kit){.positions = cube_positions,
                             .vertex_count = 8,
                             .corners = cut ? cut_corners : cube_corners,
                             .counts = cut ? NULL : cube_counts,
                             .face_count = cut ? 12 : 7,
                             .single = single,
                             .extras = extras};
}

static struct strbuf written(struct mesh_kit mesh, enum mesh_kit_form form) {
    struct strbuf bytes;
    strbuf_init(&bytes);
    mesh_kit_write(&mesh, form, &bytes);
    assert_false(bytes.failed);
    return bytes;
}

static const struct mesh *load(struct assets_scene *s, const char *name, const void *bytes, size_t count) {
    assets_scene_bytes(s, name, bytes, count);
    assets_scene_model(s, name);
    assets_scene_load(s);
    return s->assets.models[0].mesh;
}

static const struct mesh *load_text(struct assets_scene *s, const char *name, const char *text) {
    return load(s, name, text, strlen(text));
}

// ---- the same mesh

static void assert_same_corners(const struct mesh *a, const struct mesh *b) {
    assert_int_equal(a->triangle_count, b->triangle_count);
    for (uint32_t t = 0; t < a->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            const vec3 p = a->positions[a->triangles[t].corners[k]];
            const vec3 q = b->positions[b->triangles[t].corners[k]];
            assert_memory_equal(&p, &q, sizeof p);
        }
}

static void every_form_is_the_same_mesh(void **state) {
    (void)state;
    for (int i = 0; i < 8; i++) {
        const struct mesh_kit kit = cube(i & 1, i & 2, i & 4);
        struct assets_scene *expected = assets_scene_begin();
        struct strbuf obj = written(kit, MESH_KIT_OBJ);
        const struct mesh *from_obj = load(expected, "m.obj", obj.data, obj.len);
        for (enum mesh_kit_form form = MESH_KIT_PLY_TEXT; form < MESH_KIT_FORMS; form++) {
            struct assets_scene *s = assets_scene_begin();
            struct strbuf bytes = written(kit, form);
            const struct mesh *mesh = load(s, mesh_kit_names[form], bytes.data, bytes.len);
            const bool is_stl = form >= MESH_KIT_STL_TEXT;
            if (is_stl && !(i & 4))
                assert_int_equal(
                    assets_scene_count(s, DIAG_MESH_CURVED) + assets_scene_count(s, DIAG_MESH_BENT), 0);
            assert_non_null(mesh);
            assert_true(mesh->closed);
            assert_int_equal(mesh->position_count, 8);
            if (!is_stl || (i & 4)) // a bent side is cut along either diagonal
                assert_same_corners(mesh, from_obj);
            assert_true(fabs(mesh->volume) > 1);
            strbuf_finish(&bytes);
            assets_scene_end(s);
        }
        strbuf_finish(&obj);
        assets_scene_end(expected);
    }
}

// ---- PLY

#define PLY_HEAD     "ply\nformat ascii 1.0\n"
#define PLY_XYZ      "property float x\nproperty float y\nproperty float z\n"
#define PLY_FACE     "property list uchar int vertex_indices\nend_header\n"
#define PLY_TRIANGLE PLY_HEAD "element vertex 3\n" PLY_XYZ "element face 1\n" PLY_FACE "0 0 0\n1 0 0\n0 1 0\n"

static const struct {
    const char *text, *said;
} ply_faults[] = {
    {"", "byte 0: a PLY file begins with a line 'ply' [E610]"},
    {"v 0 0 0\n", "byte 0: a PLY file begins with a line 'ply' [E610]"},
    {"ply\nformat ascii 1.0\nfoo\n", "m.ply:3:1: error: 'foo' cannot begin a line of a PLY header [E610]"},
    {"ply\nformat\n", "m.ply:2:1: error: this line ends where something should be ascii"},
    {"ply\nformat binary\n", "m.ply:2:8: error: 'binary' should be ascii, binary_little_endian"},
    {"ply\nend_header\n", "m.ply:1:1: error: the header has no line 'format' [E610]"},
    {PLY_HEAD "element vertex\n", "m.ply:3:1: error: this line ends where something should be the number"},
    {PLY_HEAD "element vertex -3\n", "m.ply:3:16: error: '-3' should be the number of elements"},
    {PLY_HEAD "element vertex 4294967295\n", "'4294967295' is more than 4294967294"},
    {PLY_HEAD "property float x\n", "m.ply:3:1: error: 'property' belongs after an element"},
    {PLY_HEAD "element vertex 3\nproperty floot x\n", "m.ply:4:10: error: 'floot' should be a type: char"},
    {PLY_HEAD "element vertex 3\nproperty list uchar x\n", "m.ply:4:21: error: 'x' should be a type"},
    {PLY_HEAD "element vertex 3.0\n", "m.ply:3:16: error: '3.0' should be the number of elements"},
    {PLY_HEAD "element face 1\nproperty list float int vertex_indices\n",
     "m.ply:4:15: error: 'float' cannot count the items of a list: choose a whole type, such as uchar "
     "[E610]"},
    {PLY_HEAD "element face 1\nproperty list float64 float x\n", "m.ply:4:15: error: 'float64' cannot count"},
    {PLY_HEAD "element vertex 1\n" PLY_XYZ
              "element face 1\nproperty list uchar float vertex_indices\nend_header\n0 0 0\n3 0 0 0\n",
     "m.ply:7:1: error: the 'vertex_indices' of 'face' must be whole numbers, such as int [E610]"},
    {PLY_HEAD "element vertex 3\nproperty float\n", "m.ply:4:1: error: this line ends where something should "
                                                    "be the property's name"},
    {PLY_HEAD "element vertex 3\n", "the header does not end with 'end_header'"},
    {PLY_HEAD "element vertex 3\n" PLY_XYZ "end_header\n0 0 0\n0 0 0\n0 0 0\n",
     "the mesh has no faces [E614]"},
    {PLY_HEAD "element vertex 3\n" PLY_XYZ "end_header\n0 0 0\n0 0 0\n0 0 0\n", "it has 3 points"},
    {PLY_HEAD "element face 1\n" PLY_FACE "3 0 1 2\n", "the file has faces, and no 'vertex' [E610]"},
    {PLY_HEAD "element vertex 1\nproperty float x\nelement face 1\n" PLY_FACE "1\n3 0 0 0\n",
     "m.ply:3:1: error: a vertex has no property 'y' [E610]"},
    {PLY_HEAD "element vertex 1\n" PLY_XYZ "element face 1\nproperty int a\nend_header\n1 1 1\n3\n",
     "m.ply:7:1: error: 'face' has no list 'vertex_indices' [E610]"},
    {PLY_HEAD "element vertex 4000000000\n" PLY_XYZ "element face 1\n" PLY_FACE "0 0 0\n",
     "m.ply:3:1: error: 4000000000 of 'vertex' are announced, and the file has room for 1 at most"},
    {PLY_TRIANGLE "3 0 1 3\n",
     "m.ply:13:7: error: '3' is not a vertex: the file has 3, counted from 0 [E612]"},
    {PLY_TRIANGLE "3 0 1 -1\n", "m.ply:13:7: error: '-1' is not a vertex"},
    {PLY_TRIANGLE "3 0 1 1.5\n", "m.ply:13:7: error: '1.5' is not a vertex"},
    {PLY_TRIANGLE "3 0 1 x\n", "m.ply:13:7: error: 'x' is not a number [E611]"},
    {PLY_TRIANGLE "3 0 1\n", "m.ply:13:1: error: the line has fewer values than the header says [E610]"},
    {PLY_TRIANGLE "3 0 1 2 0\n", "m.ply:13:1: error: the line has more values than the header says [E610]"},
    {PLY_TRIANGLE "2 0 1\n", "m.ply:13:1: error: a face with fewer than three corners [E613]"},
    {PLY_TRIANGLE "-3 0 1 2\n",
     "m.ply:13:1: error: the number of a list's items is wrong in 'face' number 1"},
    {PLY_TRIANGLE "99999 0 1 2\n", "m.ply:13:1: error: the line ends in 'face' number 1 of 1 [E610]"},
    {PLY_HEAD "element vertex 2\n" PLY_XYZ "element face 1\n" PLY_FACE "0 0 0\n1 inf 0\n3 0 1 0\n",
     "m.ply:11:3: error: 'inf' is infinite"},
    {PLY_HEAD "element vertex 2\n" PLY_XYZ "element face 1\n" PLY_FACE "0 0 0\n1 1e19 0\n3 0 1 0\n",
     "m.ply:11:3: error: '1e19' is not a number up to 1e18 [E611]"},
    {PLY_HEAD "element vertex 2\n" PLY_XYZ "element face 1\n" PLY_FACE "0 0 0\n\n1 1\n3 0 1 0\n",
     "m.ply:12:1: error: the line has fewer values than the header says [E610]"},
    {PLY_TRIANGLE "3 0 1 2\nrest\n", "5 bytes after the last face are not read [W606]"},
    {PLY_TRIANGLE "3 0 1 3\n", "scene.yaml:1:7: note: the mesh is named here"},
};

static void faults_of_ply_are_placed(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof ply_faults / sizeof *ply_faults; i++) {
        struct assets_scene *s = assets_scene_begin();
        load_text(s, "m.ply", ply_faults[i].text);
        assert_says(s, ply_faults[i].said);
        assets_scene_end(s);
    }
}

static void faults_of_bytes_are_placed(void **state) {
    (void)state;
    struct strbuf bytes = written(cube(true, false, true), MESH_KIT_PLY_LITTLE);
    const size_t body = bytes.len - 8 * 12 - 12 * 13;
    struct {
        size_t at;
        const char *value, *said;
        char expected[64];
    } cases[] = {
        {body + 12 + 4, "\0\0\300\177", "nan is not a number up to 1e18 [E611]", ""},
        {body + 8 * 12 + 1, "\10\0\0\0", "8 is not a vertex: the file has 8, counted from 0 [E612]", ""},
        {body + 8 * 12 + 13 + 1 + 4, "\377\377\377\377", "-1 is not a vertex", ""},
        {body + 8 * 12 + 11 * 13, "\4\0\0\0", "the file ends in 'face' number 12 of 12 [E610]", ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct assets_scene *s = assets_scene_begin();
        char *copy = malloc(bytes.len);
        memcpy(copy, bytes.data, bytes.len);
        memcpy(copy + cases[i].at, cases[i].value, 4);
        snprintf(cases[i].expected, sizeof cases[i].expected, "byte %zu: %.40s", cases[i].at, cases[i].said);
        assert_null(load(s, "m.ply", copy, bytes.len));
        assert_says(s, cases[i].expected);
        assert_says(s, "scene.yaml:1:7: note: the mesh is named here");
        free(copy);
        assets_scene_end(s);
    }
    strbuf_finish(&bytes);
}

static void line_ends_are_those_of_the_first_line(void **state) {
    (void)state;
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    for (int i = 0; i < 3; i++) {
        struct strbuf text;
        strbuf_init(&text);
        for (const char *c = PLY_TRIANGLE "3 0 1 2\n"; *c; c++)
            strbuf_str(&text, *c == '\n' ? str_from(ends[i]) : (str){c, 1});
        struct assets_scene *s = assets_scene_begin();
        assert_non_null(load(s, "m.ply", text.data, text.len));
        assert_silent(s);
        assets_scene_end(s);
        strbuf_finish(&text);
    }
    // The first byte of the first vertex is a line feed, after a header whose lines end in carriage returns.
    static const char head[] = "ply\rformat binary_little_endian 1.0\relement vertex 3\rproperty uchar x\r"
                               "property uchar y\rproperty uchar z\relement face 1\r"
                               "property list uchar uchar vertex_index\rend_header\r"
                               "\n\0\0\1\2\3\4\7\6\3\0\1\2";
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = load(s, "m.ply", head, sizeof head - 1);
    assert_non_null(mesh);
    assert_true(mesh->positions[0].x == 10 && mesh->positions[2].y == 7);
    assets_scene_end(s);
}

static void normals_and_colors(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh = load_text(
        s, "m.ply",
        PLY_HEAD "element vertex 3\nproperty float nx\nproperty float ny\nproperty float nz\n" PLY_XYZ
                 "property uchar red\nelement face 1\n" PLY_FACE
                 "0 0 2 0 0 0 9\nnan 0 1 1 0 0 9\n0 0 0 0 1 0 9\n3 0 1 2\n");
    assert_non_null(mesh);
    assert_says(s, "the mesh has colours of its own, which are not used");
    assert_int_equal(s->sink.count, 1);
    assert_int_equal(mesh->triangles[0].normals[0], 0);
    assert_true(mesh->normals[0].z == 1);
    assert_int_equal(mesh->triangles[0].normals[1], IR_NO_INDEX);
    assert_int_equal(mesh->triangles[0].normals[2], IR_NO_INDEX);
    assert_int_equal(mesh->losses[MESH_LOSS_NORMALS].count, 2);
    assets_scene_end(s);
}

static void strips_are_triangles(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    // A strip of two triangles, one that only turns, and another strip; then a face.
    const struct mesh *mesh = load_text(
        s, "m.ply",
        PLY_HEAD "element tristrips 1\nproperty list int int vertex_indices\nelement vertex 4\n" PLY_XYZ
                 "element face 1\n" PLY_FACE "9 0 1 2 3 3 -1 2 1 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 1 3 2\n");
    static const uint32_t expected[4][3] = {{1, 3, 2}, {0, 1, 2}, {2, 1, 3}, {2, 1, 0}};
    assert_non_null(mesh);
    assert_int_equal(mesh->triangle_count, 4);
    for (int t = 0; t < 4; t++)
        assert_memory_equal(mesh->triangles[t].corners, expected[t], sizeof expected[t]);
    assets_scene_end(s);
}

// ---- STL

#define STL_FACET(vertices) "facet normal 0 0 1\nouter loop\n" vertices "endloop\nendfacet\n"
#define STL_TRIANGLE        STL_FACET("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n")

static void faults_of_stl_are_placed(void **state) {
    (void)state;
    static const struct {
        const char *text, *said;
    } cases[] = {
        {"", "the mesh has no faces [E614]"},
        {"solid\nendsolid\n", "the mesh has no faces [E614]"},
        {"hello\n", "m.stl:1:1: error: 'hello' is not expected here: this is the place for 'solid' [E610]"},
        {"solid x\nvertex 1 2 3\n", "m.stl:2:1: error: 'vertex' is not expected here: this is the place for "
                                    "'facet' or 'endsolid' [E610]"},
        {"solid x\n" STL_FACET("vertex 0 0 0\nvertex 1 0 0\n"),
         "m.stl:2:1: error: a facet with 2 corners [E613]"},
        {"solid x\n" STL_FACET("vertex 0 0\nvertex 1 0 0\nvertex 2 0 0\n"),
         "m.stl:4:1: error: a vertex has three numbers [E610]"},
        {"solid x\n" STL_FACET("vertex 0 0 0\nvertex 1 0,5 0\nvertex 2 0 0\n"), "m.stl:5:10: error: '0,5' "},
        {"solid x\n" STL_FACET("vertex 0 0 0\nvertex 1 0 -1e20\nvertex 2 0 0\n"),
         "m.stl:5:12: error: '-1e20' is larger than 1e18 [E611]"},
        {"solid x\n" STL_TRIANGLE, "m.stl:8:1: error: the file ends within a solid: 'endsolid' is missing"},
        {"solid x\nfacet normal 0 0 1\nouter loop\n",
         "m.stl:3:1: error: the file ends within a facet [E610]"},
        {"solid x\nfacet normal 0 0 1\nouter loop\n", "scene.yaml:1:7: note: the mesh is named here"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct assets_scene *s = assets_scene_begin();
        assert_null(load_text(s, "m.stl", cases[i].text));
        assert_says(s, cases[i].said);
        assets_scene_end(s);
    }
}

static void binary_is_told_by_its_bytes(void **state) {
    (void)state;
    struct mesh_kit kit = cube(true, true, true);
    struct strbuf bytes = written(kit, MESH_KIT_STL_BINARY);
    struct assets_scene *s = assets_scene_begin();
    assert_memory_equal(bytes.data, "solid ", 6);
    const struct mesh *mesh = load(s, "m.stl", bytes.data, bytes.len);
    assert_silent(s);
    assert_true(mesh->is_binary && mesh->closed);
    assert_int_equal(mesh->triangle_count, 12);
    assets_scene_end(s);
    // Shorter and longer than it says, and with a number that is none.
    s = assets_scene_begin();
    assert_null(load(s, "m.stl", bytes.data, bytes.len - 1));
    assert_says(s, "byte 80: 12 facets are announced, and the file ends after 11 [E610]");
    assets_scene_end(s);
    s = assets_scene_begin();
    strbuf_cstr(&bytes, "rest");
    assert_non_null(load(s, "m.stl", bytes.data, bytes.len));
    assert_says(s, "4 bytes after the last face are not read [W606]");
    assets_scene_end(s);
    s = assets_scene_begin();
    memcpy(bytes.data + 84 + 50 + 12 + 4, "\0\0\200\377", 4);
    assert_null(load(s, "m.stl", bytes.data, bytes.len));
    assert_says(s, "byte 150: -inf in facet 2 is not a number up to 1e18 [E611]");
    assets_scene_end(s);
    strbuf_finish(&bytes);
}

// Bytes and text are joined by tables of their own. In turn: few positions, so that most facets repeat one;
// as many as the table is made for; and no two the same, so that it grows.
static void joined_as_text_is(void **state) {
    (void)state;
    enum {
        FACETS = 2000
    };
    static const unsigned kinds[] = {3, 10, 1U << 20};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        static double positions[9 * FACETS];
        static uint32_t corners[3 * FACETS];
        uint64_t random = 5;
        for (size_t i = 0; i < 9 * (size_t)FACETS; i++)
            positions[i] =
                i % 3 == 2 && splitmix_next(&random) % 2 ? -0.0 : (double)(splitmix_next(&random) % kinds[k]);
        for (uint32_t i = 0; i < 3 * FACETS; i++)
            corners[i] = i;
        const struct mesh_kit kit = {.positions = positions,
                                     .vertex_count = 3 * FACETS,
                                     .corners = corners,
                                     .face_count = FACETS,
                                     .single = true};
        struct assets_scene *scenes[2];
        const struct mesh *meshes[2];
        for (int i = 0; i < 2; i++) {
            const enum mesh_kit_form form = i ? MESH_KIT_STL_BINARY : MESH_KIT_STL_TEXT;
            struct strbuf bytes = written(kit, form);
            scenes[i] = assets_scene_begin();
            meshes[i] = load(scenes[i], mesh_kit_names[form], bytes.data, bytes.len);
            assert_non_null(meshes[i]);
            assert_int_equal(meshes[i]->is_binary, i);
            strbuf_finish(&bytes);
        }
        assert_same_corners(meshes[0], meshes[1]);
        assert_int_equal(meshes[0]->position_count, meshes[1]->position_count);
        assert_memory_equal(meshes[0]->positions, meshes[1]->positions,
                            meshes[0]->position_count * sizeof *meshes[0]->positions);
        for (int i = 0; i < 2; i++)
            assets_scene_end(scenes[i]);
    }
}

// A colour in the bytes after a facet, or for all of them in the header.
static void attributes_are_noted(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct strbuf bytes = written(cube(true, false, true), MESH_KIT_STL_BINARY);
        if (i)
            memcpy(bytes.data + 80 - 10, "COLOR=\377\200\0\377", 10);
        else
            bytes.data[84 + 48] = 1;
        struct assets_scene *s = assets_scene_begin();
        assert_non_null(load(s, "m.stl", bytes.data, bytes.len));
        assert_says(s, "note: the mesh has colours of its own, which are not used");
        assets_scene_end(s);
        strbuf_finish(&bytes);
    }
}

// Solids with names are groups; one by itself is none, whatever its name.
static void solids_are_groups(void **state) {
    (void)state;
    struct assets_scene *s = assets_scene_begin();
    const struct mesh *mesh =
        load_text(s, "m.stl",
                  "SOLID left side\n" STL_TRIANGLE "EndSolid left side\n"
                  "solid empty\nendsolid\nsolid right\n" STL_TRIANGLE "endsolid right\n");
    assert_non_null(mesh);
    assert_silent(s);
    assert_int_equal(mesh->group_count, 2);
    assert_true(str_equal_cstr(mesh->groups[0].name, "left side"));
    assert_true(str_equal_cstr(mesh->groups[1].name, "right"));
    assert_int_equal(mesh->position_count, 3);
    assets_scene_end(s);
    s = assets_scene_begin();
    mesh = load_text(s, "m.stl", "solid by itself\n" STL_TRIANGLE "endsolid\n");
    assert_silent(s);
    assert_int_equal(mesh->groups[0].name.len, 0);
    assets_scene_end(s);
}

// ---- limits

static void limits_hold(void **state) {
    (void)state;
    static const struct {
        enum limit limit;
        uint64_t value;
        const char *said;
    } cases[] = {
        {LIMIT_MESH_TRIANGLES, 11, "the mesh exceeds the limit mesh-triangles of 11 [E501]"},
        {LIMIT_MESH_CORNERS, 3, "the mesh exceeds the limit mesh-corners of 3 [E501]"},
        {LIMIT_MESH_BYTES, 100, "the limit mesh-bytes is 100"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (enum mesh_kit_form form = MESH_KIT_PLY_TEXT; form < MESH_KIT_FORMS; form++) {
            struct strbuf bytes = written(cube(true, false, false), form);
            struct assets_scene *s = assets_scene_begin();
            s->limits.value[cases[i].limit] = cases[i].value;
            const struct mesh *mesh = load(s, mesh_kit_names[form], bytes.data, bytes.len);
            if (cases[i].limit == LIMIT_MESH_CORNERS && form >= MESH_KIT_STL_TEXT) {
                assert_non_null(mesh);
            } else {
                assert_null(mesh);
                assert_says(s, cases[i].said);
            }
            assets_scene_end(s);
            strbuf_finish(&bytes);
        }
}

// ---- damaged files

static bool holds_together(const struct mesh *mesh) {
    bool holds = mesh->triangle_count > 0 && mesh->closed == (mesh->open_edges == 0);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            const struct mesh_triangle *triangle = &mesh->triangles[t];
            holds = holds && triangle->group < mesh->group_count && triangle->line > 0 &&
                    triangle->corners[k] < mesh->position_count &&
                    (triangle->normals[k] == IR_NO_INDEX || triangle->normals[k] < mesh->normal_count);
        }
    return holds;
}

// Whether there is a mesh, or an error; a block of the exact size, so that reading beyond it is seen.
static bool is_read(const char *name, const char *data, size_t count) {
    struct assets_scene *s = assets_scene_begin();
    char *bytes = malloc(count ? count : 1);
    memcpy(bytes, data, count);
    s->limits.value[LIMIT_MESH_MEMORY] = 1 << 20;
    const struct mesh *mesh = load(s, name, bytes, count);
    assert_true(mesh ? holds_together(mesh) : s->sink.errors > 0);
    assert_true(strlen(assets_scene_text(s)) < 20000);
    assets_scene_end(s);
    free(bytes);
    return mesh;
}

static void every_prefix_and_every_byte(void **state) {
    (void)state;
    static const char replacements[] = {'\0', '\n', ' ', '-', '9', '.', 'e', (char)0x7F, (char)0xFF};
    for (enum mesh_kit_form form = MESH_KIT_PLY_TEXT; form < MESH_KIT_FORMS; form++) {
        struct strbuf bytes = written(cube(true, true, false), form);
        // A text says all without the end of its last line, without the name after `endsolid`, and without
        // the last digit of what nobody reads.
        const size_t spare = form == MESH_KIT_STL_TEXT   ? strlen(" kit\n")
                             : form == MESH_KIT_PLY_TEXT ? strlen("7\n")
                                                         : 0;
        for (size_t n = 0; n < bytes.len; n++)
            assert_int_equal(is_read(mesh_kit_names[form], bytes.data, n), n >= bytes.len - spare);
        for (size_t at = 0; at < bytes.len; at++)
            for (size_t r = 0; r < sizeof replacements; r++) {
                const char before = bytes.data[at];
                bytes.data[at] = replacements[r];
                is_read(mesh_kit_names[form], bytes.data, bytes.len);
                bytes.data[at] = before;
            }
        strbuf_finish(&bytes);
    }
}

// Those that fuzzing begins with, five of each format; test_gltf_robust.c has those of glTF.
static void every_prefix_of_five_files(void **state) {
    (void)state;
    static const char *const names[] = {"ply/all_words.ply", "ply/text.ply",       "ply/little.ply",
                                        "ply/big.ply",       "ply/strips.ply",     "stl/binary.stl",
                                        "stl/text.stl",      "stl/two_solids.stl", "stl/capitals.stl",
                                        "stl/colors.stl",    "obj/frame.obj",      "obj/tetrahedron.obj",
                                        "obj/corners.obj",   "obj/relative.obj",   "obj/materials.obj"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[4096], bytes[4096];
        snprintf(path, sizeof path, "tests/fuzz/seeds/%s", names[i]);
        FILE *file = fopen(path, "rb");
        assert_non_null(file);
        const size_t size = fread(bytes, 1, sizeof bytes, file);
        assert_int_equal(fclose(file), 0);
        assert_true(size > 0 && size < sizeof bytes && is_read(names[i] + 4, bytes, size));
        assert_false(is_read(names[i] + 4, bytes, 0));
        for (size_t n = 1; n < size; n++)
            is_read(names[i] + 4, bytes, n);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_form_is_the_same_mesh),
        cmocka_unit_test(faults_of_ply_are_placed),
        cmocka_unit_test(faults_of_bytes_are_placed),
        cmocka_unit_test(line_ends_are_those_of_the_first_line),
        cmocka_unit_test(normals_and_colors),
        cmocka_unit_test(strips_are_triangles),
        cmocka_unit_test(faults_of_stl_are_placed),
        cmocka_unit_test(binary_is_told_by_its_bytes),
        cmocka_unit_test(joined_as_text_is),
        cmocka_unit_test(attributes_are_noted),
        cmocka_unit_test(solids_are_groups),
        cmocka_unit_test(limits_hold),
        cmocka_unit_test(every_prefix_and_every_byte),
        cmocka_unit_test(every_prefix_of_five_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
