// Damaged OBJ and MTL files: an error at a place, or a mesh that holds together; never a crash, never without
// end.
#include "assets_scene.h"

#include <math.h>

static const char obj_text[] =
    "mtllib own.mtl\n# comment\nv 0 0 0\nv 1 0 0 1\nv 1 1.5e0 0\nv 0 1 0 .1 .2 .3\nv 0.5 -.5 1e-3\n"
    "vt 0 0\nvn 0 0 1\nvn 1 0 0\no thing\ng part\ns 1\nusemtl red\nf 1/1/1 2/1/1 3/1/1 4/1/1\n"
    "f 1//1 5//2 2//1\nusemtl blue\\\n green\nf -1 -2 \\\n -3\nf 1 2 3 4 5\nl 1 2\np 1\n"
    "curv 0 1 1 2\nf 1 2 9\n";
static const char mtl_text[] =
    "newmtl red\nKd 1 0 0\nKs .5 .5 .5\nNs 20\nd 0.5\nillum 3\nmap_Kd a.png\nnewmtl blue\nTr 1\n";

// What flattening relies on.
static void assert_holds_together(const struct mesh *mesh) {
    uint32_t zero_area = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        const struct mesh_triangle *triangle = &mesh->triangles[t];
        assert_true(triangle->group < mesh->group_count && triangle->line > 0);
        for (int k = 0; k < 3; k++) {
            assert_true(triangle->corners[k] < mesh->position_count);
            assert_true(triangle->normals[k] == IR_NO_INDEX || triangle->normals[k] < mesh->normal_count);
        }
        zero_area += !mesh_has_area(mesh, t);
    }
    for (uint32_t i = 0; i < mesh->position_count; i++)
        assert_true(mesh->merged[i] <= i && vec3_max_abs(mesh->positions[i]) <= 1e18);
    assert_int_equal(zero_area, mesh->zero_area);
    assert_int_equal(mesh->closed, mesh->open_edges == 0);
    assert_true(mesh->triangle_count > 0 && mesh->closed == (mesh->open_line == 0));
}

static void load(const char *obj, size_t obj_size, const char *mtl, size_t mtl_size) {
    struct assets_scene *s = assets_scene_begin();
    // Blocks of the exact size, so that reading beyond them is seen.
    char *mesh_bytes = malloc(obj_size ? obj_size : 1);
    char *mtl_bytes = malloc(mtl_size ? mtl_size : 1);
    memcpy(mesh_bytes, obj, obj_size);
    memcpy(mtl_bytes, mtl, mtl_size);
    assets_scene_bytes(s, "mesh.obj", mesh_bytes, obj_size);
    assets_scene_bytes(s, "own.mtl", mtl_bytes, mtl_size);
    s->limits.value[LIMIT_MESH_MEMORY] = 1 << 20;
    assets_scene_model(s, "mesh.obj");
    assets_scene_load(s);
    const struct mesh *mesh = s->assets.models[0].mesh;
    if (mesh)
        assert_holds_together(mesh);
    else
        assert_true(s->sink.errors > 0);
    if (mesh) {
        const vec3 *normals = mesh_smooth_normals(mesh, 180, &s->arena);
        for (uint32_t i = 0; i < 3 * mesh->triangle_count; i++)
            assert_true(vec3_is_zero(normals[i]) || fabs(vec3_length(normals[i]) - 1) < 1e-9);
    }
    assert_true(strlen(assets_scene_text(s)) < 20000);
    assets_scene_end(s);
    free(mesh_bytes);
    free(mtl_bytes);
}

static void every_prefix(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof obj_text; n++)
        load(obj_text, n, mtl_text, sizeof mtl_text - 1);
    for (size_t n = 0; n < sizeof mtl_text; n++)
        load(obj_text, sizeof obj_text - 9, mtl_text, n);
}

static void every_byte_replaced(void **state) {
    (void)state;
    static const char replacements[] = {'\0', '\n', '\r', ' ', '\\', '-',       '9',
                                        '/',  '#',  'f',  '.', 'e',  (char)0xFF};
    for (size_t at = 0; at < sizeof obj_text - 1; at++)
        for (size_t r = 0; r < sizeof replacements; r++) {
            char copy[sizeof obj_text];
            memcpy(copy, obj_text, sizeof copy);
            copy[at] = replacements[r];
            load(copy, sizeof copy - 1, mtl_text, sizeof mtl_text - 1);
        }
    for (size_t at = 0; at < sizeof mtl_text - 1; at++)
        for (size_t r = 0; r < sizeof replacements; r++) {
            char copy[sizeof mtl_text];
            memcpy(copy, mtl_text, sizeof copy);
            copy[at] = replacements[r];
            load(obj_text, sizeof obj_text - 9, copy, sizeof copy - 1);
        }
}

// Large files of one kind of line: linear work, and no more messages than a sink keeps.
static void monotonous_files(void **state) {
    (void)state;
    static const char *const lines[] = {"f 1 2\n",        "f 9 9 9\n", "f\n",           "v\n",
                                        "v nan 0 0\n",    "garbage\n", "usemtl a\n",    "\\\n",
                                        "mtllib x.mtl\n", "\r",        "f 1 1 1 1 1\n", "#\n",
                                        "vn 0 0 0\n",     "\x01",      "f 1",           " 1",
                                        "l 1 2\n"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        struct strbuf text;
        strbuf_init(&text);
        strbuf_cstr(&text, "v 0 0 0\nf 1 1 1\n");
        while (text.len < 300000)
            strbuf_cstr(&text, lines[i]);
        struct assets_scene *s = assets_scene_begin();
        assets_scene_bytes(s, "mesh.obj", text.data, text.len);
        assets_scene_model(s, "mesh.obj");
        assets_scene_load(s);
        assert_in_range(s->sink.count, 0, DIAG_KEPT_MAX);
        assets_scene_end(s);
        strbuf_finish(&text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_prefix),
        cmocka_unit_test(every_byte_replaced),
        cmocka_unit_test(monotonous_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
