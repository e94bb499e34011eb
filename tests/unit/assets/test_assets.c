// Files that a scene names: found, refused, shared, kept over a reload, and given back when memory ends.
#include "assets_scene.h"

#include "core/parallel.h"
#include "core/timeline.h"
#include "diag/codes/file.h"
#include "scratch.h"

#include <utime.h>

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"

struct fixture {
    struct scratch scratch;
    struct assets_scene *s;
};

// The scene lies in the scratch folder's scene/.
static int set_up(void **state) {
    struct fixture *f = calloc(1, sizeof *f);
    if (!f || !scratch_make(&f->scratch) || mkdir(scratch_path(&f->scratch, "scene"), 0777) != 0)
        return -1;
    scratch_write(&f->scratch, "scene/dragon.obj", TRIANGLE);
    *state = f;
    return 0;
}

static int tear_down(void **state) {
    struct fixture *f = *state;
    scratch_finish(&f->scratch);
    free(f);
    return 0;
}

static struct assets_scene *begin_in(struct fixture *f, struct asset_store *store) {
    struct assets_scene *s = store ? assets_scene_begin_in(store) : assets_scene_begin();
    s->files.roots.count = 0;
    assert_int_equal(files_add_root(&s->files, str_from(scratch_path(&f->scratch, "scene"))), FILE_OK);
    return s;
}

// A model whose scene file lies in the folder.
static struct ir_model *add_model(struct fixture *f, struct assets_scene *s, const char *mesh) {
    struct ir_model *model = assets_scene_model(s, mesh);
    span at = ir_place_value(&s->origin, &model->head, &SCHEMA_MODEL, "mesh");
    s->sources.items[at.source].path =
        arena_copy(&s->arena, str_from(scratch_path(&f->scratch, "scene/scene.yaml")));
    return model;
}

static void expect(struct fixture *f, const char *mesh, const char *message, const char *help) {
    struct assets_scene *s = begin_in(f, NULL);
    add_model(f, s, mesh);
    assets_scene_load(s);
    assert_null(s->assets.models[0].mesh);
    assert_int_equal(s->sink.count, 1);
    assert_says(s, "scene/scene.yaml:1:7: error: ");
    assert_says(s, message);
    assert_says(s, help);
    assets_scene_end(s);
}

static void a_file_is_read_beside_its_scene(void **state) {
    struct fixture *f = *state;
    struct assets_scene *s = begin_in(f, NULL);
    add_model(f, s, "dragon.obj");
    assets_scene_load(s);
    assert_silent(s);
    assert_int_equal(s->assets.models[0].mesh->triangle_count, 1);
    assert_int_equal(s->files.log.count, 1);
    assets_scene_end(s);
}

// Beside the file that names it, not beside the scene that includes that file.
static void a_file_is_read_beside_what_names_it(void **state) {
    struct fixture *f = *state;
    struct assets_scene *s = begin_in(f, NULL);
    add_model(f, s, "dragon.obj");
    const str main = str_from(scratch_path(&f->scratch, "main.yaml"));
    ARENA_PUSH(&s->arena, &s->origin.files)->source =
        source_add(&s->sources, SOURCE_KIND_FILE, arena_copy(&s->arena, main), STR(""));
    assets_scene_load(s);
    assert_silent(s);
    assert_non_null(s->assets.models[0].mesh);
    assets_scene_end(s);
}

// Meshes are read side by side; what is said of them, in which order, and what was read in which order is as
// if it had been one after the other.
static void meshes_side_by_side(void **state) {
    static const char *const names[] = {"dragon.obj", "cut.obj",  "sheet.obj", "gone.obj",
                                        "other.obj",  "line.obj", "dragon.obj"};
    struct fixture *f = *state;
    scratch_write(&f->scratch, "scene/cut.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n");
    scratch_write(&f->scratch, "scene/sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    scratch_write(&f->scratch, "scene/other.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n");
    scratch_write(&f->scratch, "scene/line.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n");
    struct assets_scene *s = begin_in(f, NULL);
    struct timeline timeline = {0};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        add_model(f, s, names[i]);
    s->timeline = &timeline;
    assets_scene_load(s);
    // The faulty one is read again, for what is wrong with it.
    assert_int_equal(timeline.count, parallel_processors() > 1 ? 6 : 5);
    const diag_code codes[] = {DIAG_FILE_MISSING, DIAG_MESH_INDEX, DIAG_MESH_DROPPED}; // sorted by file
    assert_int_equal(s->sink.count, 3);
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(s->sink.items[i].code, codes[i]);
    const uint32_t triangles[] = {1, 0, 2, 0, 1, 1, 1};
    for (size_t i = 0; i < 7; i++)
        assert_int_equal(s->assets.models[i].mesh ? s->assets.models[i].mesh->triangle_count : 0,
                         triangles[i]);
    assert_ptr_equal(s->assets.models[0].mesh, s->assets.models[6].mesh);
    assert_int_equal(s->files.log.count, 5);
    const char *const logged[] = {"dragon.obj", "cut.obj", "sheet.obj", "other.obj", "line.obj"};
    for (size_t i = 0; i < 5; i++)
        assert_true(str_equal(path_base(s->files.log.items[i].path), str_from(logged[i])));
    assets_scene_end(s);
}

static void missing_files_name_the_nearest(void **state) {
    struct fixture *f = *state;
    expect(f, "dragn.obj", "the mesh 'dragn.obj' does not exist [E601]",
           "= help: did you mean 'dragon.obj'?");
    expect(f, "Dragon.OBJ", "the mesh 'Dragon.OBJ' does not exist [E601]",
           "= help: did you mean 'dragon.obj'?");
    expect(f, "./teapot.obj", "the mesh './teapot.obj' does not exist [E601]", "--asset-path DIR");
    expect(f, "no/such/dragon.obj", "does not exist [E601]", "--asset-path DIR");
}

static void what_is_no_file_is_refused_at_once(void **state) {
    struct fixture *f = *state;
    mkdir(scratch_path(&f->scratch, "scene/folder.obj"), 0777);
    mkfifo(scratch_path(&f->scratch, "scene/pipe.obj"), 0666);
    assert_int_equal(symlink("/dev/zero", scratch_path(&f->scratch, "scene/zero.obj")), 0);
    expect(f, "folder.obj", "the mesh 'folder.obj' is not a regular file [E603]", "");
    expect(f, "pipe.obj", "the mesh 'pipe.obj' is not a regular file [E603]", "");
    expect(f, "zero.obj", "the mesh 'zero.obj' is not a regular file [E603]", "");
    expect(f, "/dev/zero", "the mesh '/dev/zero' is not a regular file [E603]", "");
}

static void files_outside_are_refused(void **state) {
    struct fixture *f = *state;
    scratch_write(&f->scratch, "secret.obj", TRIANGLE);
    assert_int_equal(symlink("../secret.obj", scratch_path(&f->scratch, "scene/link.obj")), 0);
    expect(f, "../secret.obj", "the mesh '../secret.obj' lies outside the scene's folder: '", "--fix=all");
    expect(f, "link.obj", "the mesh 'link.obj' lies outside the scene's folder: '", "--asset-path ");
    struct assets_scene *s = begin_in(f, NULL);
    files_add_root(&s->files, str_from(f->scratch.folder));
    add_model(f, s, "link.obj");
    assets_scene_load(s);
    assert_silent(s);
    assets_scene_end(s);
}

static void other_kinds_are_named(void **state) {
    struct fixture *f = *state;
    static const char *const names[] = {"a.off", "a.FBX", "a.dae", "a.txt", "a", "b.obj"};
    for (int i = 0; i < 5; i++) {
        char path[32];
        snprintf(path, sizeof path, "scene/%s", names[i]);
        scratch_write(&f->scratch, path, "ply\n");
    }
    expect(f, "a.off", "meshes of the kind '.off' are not supported [E605]",
           "glint reads Wavefront OBJ (.obj), PLY (.ply), STL (.stl) or glTF 2.0 (.glb, .gltf); a 3D program "
           "can convert");
    expect(f, "a.FBX", "meshes of the kind '.FBX' are not supported [E605]", "can convert");
    expect(f, "a.dae", "meshes of the kind '.dae' are not supported [E605]", "can convert");
    expect(f, "a.txt", "meshes of the kind '.txt' are not supported [E605]",
           "glint reads Wavefront OBJ (.obj), PLY");
    expect(f, "./a", "'a' has no extension that shows its kind [E605]", "glint reads");
}

static void unreadable_files_say_why(void **state) {
    struct fixture *f = *state;
    if (geteuid() == 0)
        skip(); // root may read everything
    chmod(scratch_path(&f->scratch, "scene/dragon.obj"), 0);
    expect(f, "dragon.obj", "the mesh 'dragon.obj' cannot be read: Permission denied [E604]", "");
}

static void poisoned_paths_are_passed_over(void **state) {
    struct fixture *f = *state;
    struct assets_scene *s = begin_in(f, NULL);
    struct ir_model *model = add_model(f, s, "dragn.obj");
    model->head.poisoned = UINT64_C(1) << schema_find_row(&SCHEMA_MODEL, STR("mesh"));
    add_model(f, s, "")->mesh.name = STR("");
    assets_scene_load(s);
    assert_silent(s);
    assert_null(s->assets.models[0].mesh);
    assets_scene_end(s);
}

static void a_broken_mesh_is_reported_once(void **state) {
    struct fixture *f = *state;
    scratch_write(&f->scratch, "scene/bad.obj", "f 1 2 3\n");
    struct assets_scene *s = begin_in(f, NULL);
    add_model(f, s, "bad.obj");
    add_model(f, s, "./bad.obj");
    assets_scene_load(s);
    assert_int_equal(assets_scene_count(s, DIAG_MESH_INDEX), 3);
    assert_int_equal(s->sink.count, 3);
    assets_scene_end(s);
}

static void models_share_a_mesh(void **state) {
    struct fixture *f = *state;
    assert_int_equal(symlink("dragon.obj", scratch_path(&f->scratch, "scene/link.obj")), 0);
    struct assets_scene *s = begin_in(f, NULL);
    add_model(f, s, "dragon.obj");
    add_model(f, s, "../scene/dragon.obj");
    add_model(f, s, "link.obj");
    assets_scene_load(s);
    assert_silent(s);
    assert_ptr_equal(s->assets.models[0].mesh, s->assets.models[1].mesh);
    assert_ptr_equal(s->assets.models[0].mesh, s->assets.models[2].mesh);
    assert_int_equal(s->assets.triangle_count, 3);
    assets_scene_end(s);
}

static struct assets_scene *load_dragon(struct fixture *f, struct asset_store *store) {
    struct assets_scene *s = begin_in(f, store);
    add_model(f, s, "dragon.obj");
    assets_scene_load(s);
    return s;
}

// The second scene finds the mesh in the store, and reads its material file anew.
static void a_stored_mesh_has_its_materials(void **state) {
    struct fixture *f = *state;
    struct asset_store *store = asset_store_create();
    struct assets_scene *scenes[2];
    scratch_write(&f->scratch, "scene/dragon.obj", "mtllib own.mtl\nusemtl gold\n" TRIANGLE);
    scratch_write(&f->scratch, "scene/own.mtl", "newmtl gold\nNs 3\n");
    for (int i = 0; i < 2; i++) {
        struct assets_scene *s = scenes[i] = load_dragon(f, store);
        assert_silent(s);
        assert_true(s->assets.materials[s->assets.models[0].group_material[0]].specular_exponent == 3);
    }
    assert_ptr_equal(scenes[0]->assets.models[0].mesh, scenes[1]->assets.models[0].mesh);
    assets_scene_end(scenes[0]);
    assets_scene_end(scenes[1]);
    asset_store_destroy(store);
}

// Gives the file another time than it had.
static void touch(struct fixture *f) {
    struct utimbuf times = {1000000, 1000000};
    assert_int_equal(utime(scratch_path(&f->scratch, "scene/dragon.obj"), &times), 0);
}

static void meshes_outlive_a_reload(void **state) {
    struct fixture *f = *state;
    struct asset_store *store = asset_store_create();
    struct assets_scene *first = load_dragon(f, store);
    const struct mesh *mesh = first->assets.models[0].mesh;
    struct assets_scene *second = load_dragon(f, store);
    assert_ptr_equal(second->assets.models[0].mesh, mesh);
    assert_int_equal(second->files.log.count, 1); // for watching, though it was not read
    assets_scene_end(first);
    assert_int_equal(mesh->triangle_count, 1);
    assets_scene_end(second);
    // One load without users is survived too.
    struct assets_scene *third = load_dragon(f, store);
    assert_ptr_equal(third->assets.models[0].mesh, mesh);
    assets_scene_end(third);
    asset_store_destroy(store);
}

static void changed_files_are_read_again(void **state) {
    struct fixture *f = *state;
    struct asset_store *store = asset_store_create();
    struct assets_scene *first = load_dragon(f, store);
    touch(f);
    struct assets_scene *second = load_dragon(f, store);
    assert_ptr_not_equal(second->assets.models[0].mesh, first->assets.models[0].mesh);
    scratch_write(&f->scratch, "scene/dragon.obj", TRIANGLE "f 3 2 1\n");
    touch(f);
    struct assets_scene *third = load_dragon(f, store);
    assert_int_equal(third->assets.models[0].mesh->triangle_count, 2);
    assert_int_equal(first->assets.models[0].mesh->triangle_count, 1);
    assets_scene_end(first);
    assets_scene_end(second);
    assets_scene_end(third);
    asset_store_destroy(store);
}

static void notes_are_repeated_for_a_stored_mesh(void **state) {
    struct fixture *f = *state;
    scratch_write(&f->scratch, "scene/dragon.obj",
                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\nl 1 2\n");
    struct asset_store *store = asset_store_create();
    struct assets_scene *first = load_dragon(f, store);
    struct assets_scene *second = load_dragon(f, store);
    assert_int_equal(first->sink.count, 2);
    assert_says(first,
                "dragon.obj:9:1: warning: 1 point, line or curve is not drawn [W606]\n     9 | l 1 2\n");
    assert_string_equal(assets_scene_text(first), assets_scene_text(second));
    assets_scene_end(first);
    assets_scene_end(second);
    asset_store_destroy(store);
}

static void models_too_large_for_the_world(void **state) {
    struct fixture *f = *state;
    struct assets_scene *s = begin_in(f, NULL);
    add_model(f, s, "dragon.obj")->scale = (vec3){9e17, 9e17, 9e17};
    struct ir_model *model = add_model(f, s, "dragon.obj");
    model->scale = (vec3){9e17, 1, 1};
    model->translation = (vec3){2e17, 0, 0};
    assets_scene_load(s);
    assert_int_equal(s->sink.count, 1);
    assert_says(s, "the model has coordinates of 1.1e+18; at most 1e18 is allowed [E409]");
    assets_scene_end(s);
}

static void load(void *context) {
    assets_scene_load(context);
}

// Whether the scene loads with so much memory of its own.
static bool loads_in(struct assets_scene *s, size_t room) {
    s->arena.cap_bytes = s->arena.used_bytes + room;
    return arena_guarded(&s->arena, load, s) == ARENA_FAULT_NONE;
}

// Every size of the scene's own memory up to what is needed: the jump leaves nothing behind that
// assets_finish does not give back (the sanitizer looks).
static void memory_may_end_anywhere(void **state) {
    struct fixture *f = *state;
    scratch_write(&f->scratch, "scene/dragon.obj",
                  "mtllib dragon.mtl\n" TRIANGLE "usemtl a\nf 1 2 3\nl 1 2\n");
    scratch_write(&f->scratch, "scene/dragon.mtl", "newmtl a\nKd 1 1 1\nmap_Kd x\n");
    struct asset_store *store = asset_store_create();
    size_t loaded = 0;
    size_t failed = 0;
    for (size_t room = 0; room < 200000 && loaded < 3; room += 97) {
        struct assets_scene *s = begin_in(f, store);
        add_model(f, s, "dragon.obj");
        bool loads = loads_in(s, room);
        loaded += loads;
        failed += !loads;
        assets_scene_end(s);
    }
    assert_int_equal(loaded, 3);
    assert_true(failed > 10);
    asset_store_destroy(store);
}

// A mesh whose text is too large to be kept for messages is still told about by line.
static void a_text_that_is_not_kept(void **state) {
    struct fixture *f = *state;
    struct strbuf text;
    strbuf_init(&text);
    strbuf_cstr(&text, TRIANGLE "f 1 2 9\n");
    strbuf_repeat(&text, '#', 1 << 20);
    assert_true(scratch_write(&f->scratch, "scene/dragon.obj", text.data));
    struct assets_scene *s = begin_in(f, NULL);
    add_model(f, s, "dragon.obj");
    s->arena.cap_bytes = s->arena.used_bytes + (1 << 19);
    assets_scene_load(s);
    assert_says(s, "dragon.obj:1:1: error: line 5: index 9: the file defines 3 vertices [E612]\n");
    assets_scene_end(s);
    strbuf_finish(&text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_file_is_read_beside_what_names_it, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_stored_mesh_has_its_materials, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_file_is_read_beside_its_scene, set_up, tear_down),
        cmocka_unit_test_setup_teardown(meshes_side_by_side, set_up, tear_down),
        cmocka_unit_test_setup_teardown(missing_files_name_the_nearest, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_is_no_file_is_refused_at_once, set_up, tear_down),
        cmocka_unit_test_setup_teardown(files_outside_are_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(other_kinds_are_named, set_up, tear_down),
        cmocka_unit_test_setup_teardown(unreadable_files_say_why, set_up, tear_down),
        cmocka_unit_test_setup_teardown(poisoned_paths_are_passed_over, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_broken_mesh_is_reported_once, set_up, tear_down),
        cmocka_unit_test_setup_teardown(models_share_a_mesh, set_up, tear_down),
        cmocka_unit_test_setup_teardown(meshes_outlive_a_reload, set_up, tear_down),
        cmocka_unit_test_setup_teardown(changed_files_are_read_again, set_up, tear_down),
        cmocka_unit_test_setup_teardown(notes_are_repeated_for_a_stored_mesh, set_up, tear_down),
        cmocka_unit_test_setup_teardown(models_too_large_for_the_world, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_text_that_is_not_kept, set_up, tear_down),
        cmocka_unit_test_setup_teardown(memory_may_end_anywhere, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
