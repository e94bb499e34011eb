// What joins the stages: paths and options in, a scene, its diagnostics and its views out.
#include "diag/diag_text.h"
#include "load/session.h"

#include "grammar/ir.h"
#include "scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

struct fixture {
    struct scratch scratch;
    struct asset_store *store;
    struct session_options options;
    struct session session;
};

static int set_up(void **state) {
    static struct fixture fixture;
    struct fixture *f = &fixture;
    *f = (struct fixture){.options.limits = limits_default()};
    *state = f;
    f->store = asset_store_create();
    if (!f->store || !scratch_make(&f->scratch))
        return 1;
    scratch_write(&f->scratch, "triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    scratch_write(&f->scratch, "ball.yaml",
                  "glint: 1\nimage: {width: 10, height: 20}\ncameras: {left: {position: [-1, 0, 5]}, right: "
                  "{position: [1, 0, 5]}}\nspheres: [{center: [0, 0, 0], radius: 1}]\n");
    return 0;
}

static int tear_down(void **state) {
    struct fixture *f = *state;
    asset_store_destroy(f->store);
    scratch_finish(&f->scratch);
    return 0;
}

static enum session_state load(struct fixture *f, const char *name) {
    f->options.path = str_from(scratch_path(&f->scratch, name));
    return session_load(&f->session, &f->options, f->store);
}

static void expect_text(struct fixture *f, const char *part) {
    struct strbuf text;
    strbuf_init(&text);
    diag_text(&text, &f->session.sink, &f->session.sources, (struct diag_text_options){.notes = true});
    if (!strstr(text.data ? text.data : "", part))
        fail_msg("'%s' is not in:\n%s", part, text.data ? text.data : "");
    strbuf_finish(&text);
}

static void files_that_cannot_be_read(void **state) {
    struct fixture *f = *state;
    assert_int_equal(load(f, "none.yaml"), SESSION_UNREADABLE);
    expect_text(f, "none.yaml:1:1: error: the scene file does not exist [E601]");
    session_finish(&f->session);
    assert_int_equal(load(f, "none.obj"), SESSION_UNREADABLE);
    expect_text(f, "[E601]");
    session_finish(&f->session);
    assert_int_equal(load(f, "."), SESSION_UNREADABLE);
    expect_text(f, "[E603]");
    session_finish(&f->session);
    f->options.limits.value[LIMIT_SCENE_BYTES] = 10;
    assert_int_equal(load(f, "ball.yaml"), SESSION_UNREADABLE);
    expect_text(f, "raise the limit with --limit scene-bytes");
    session_finish(&f->session);
}

static void what_is_no_scene(void **state) {
    struct fixture *f = *state;
    scratch_write(&f->scratch, "list.yaml", "- 1\n");
    assert_int_equal(load(f, "list.yaml"), SESSION_NO_SCENE);
    expect_text(f, "[E201]");
    session_finish(&f->session);
    f->options.limits.value[LIMIT_SCENE_MEMORY] = 1;
    assert_int_equal(load(f, "ball.yaml"), SESSION_NO_SCENE);
    expect_text(f, "[E501]");
    session_finish(&f->session);
}

static void a_scene_and_its_options(void **state) {
    struct fixture *f = *state;
    str sets[] = {STR("spheres[0].radius=3")};
    f->options.sets = sets;
    f->options.set_count = 1;
    f->options.height = 30;
    f->options.samples = 4;
    assert_int_equal(load(f, "ball.yaml"), SESSION_LOADED);
    assert_int_equal(f->session.sink.errors, 0);
    assert_true(f->session.scene->spheres.items[0].radius == 3);
    assert_int_equal(f->session.image->width, 10);
    assert_int_equal(f->session.image->height, 30);
    assert_int_equal(f->session.image->samples, 4);
    assert_int_equal(f->session.scene->image.height, 20); // the scene says what it said
    session_finish(&f->session);
}

static void cameras_by_name(void **state) {
    struct fixture *f = *state;
    assert_int_equal(load(f, "ball.yaml"), SESSION_LOADED);
    assert_int_equal(session_camera(&f->session, STR("")), 0);
    assert_int_equal(session_camera(&f->session, STR("right")), 1);
    assert_int_equal(session_camera(&f->session, STR("rihgt")), IR_NO_INDEX);
    expect_text(f, "did you mean 'right'?");
    assert_int_equal(session_camera(&f->session, STR("elsewhere")), IR_NO_INDEX);
    expect_text(f, "the scene's cameras are 'left', 'right'");
    struct view view;
    assert_true(session_view(&f->session, 1, &view));
    assert_true(view.camera.position.x == 1);
    // The origin is the first camera's, whichever looks.
    assert_true(session_origin(&f->session, &view).x == -1);
    session_finish(&f->session);
}

static void a_mesh_is_a_scene(void **state) {
    struct fixture *f = *state;
    assert_int_equal(load(f, "triangle.obj"), SESSION_LOADED);
    assert_int_equal(f->session.sink.errors, 0);
    assert_int_equal(f->session.scene->models.count, 1);
    assert_int_equal(f->session.assets.models[0].mesh->triangle_count, 1);
    struct view view;
    assert_true(session_view(&f->session, 0, &view));
    assert_int_equal(f->session.sink.count, 0);
    assert_false(view.camera.automatic);
    assert_false(view.lights[0].automatic);
    assert_int_equal(f->session.scene->rectangles.count, 1);
    assert_true(session_origin(&f->session, &view).z == view.camera.position.z);
    session_finish(&f->session);
    // No one wrote the scene around it: nothing of it is shown.
    scratch_write(&f->scratch, "odd \"name\\.obj", "v 0 0\n");
    assert_int_equal(load(f, "odd \"name\\.obj"), SESSION_LOADED);
    expect_text(f, "odd \"name\\.obj:1:1: error: 'v' needs three numbers [E610]");
    for (uint32_t i = 0; i < f->session.sink.count; i++)
        assert_null(f->session.sink.items[i].notes);
    session_finish(&f->session);
}

static void text_alone_opens_no_assets(void **state) {
    struct fixture *f = *state;
    scratch_write(&f->scratch, "model.yaml", "glint: 1\ninclude: [none.yaml]\nmodels: [{mesh: none.obj}]\n");
    f->options.path = str_from(scratch_path(&f->scratch, "model.yaml"));
    assert_int_equal(session_load_text(&f->session, &f->options), SESSION_LOADED);
    assert_int_equal(f->session.sink.errors, 0);
    assert_int_equal(f->session.scene->includes.count, 1);
    session_finish(&f->session);
    f->options.text_only = true;
    assert_int_equal(load(f, "model.yaml"), SESSION_LOADED);
    assert_int_equal(f->session.sink.errors, 1); // the include
    session_finish(&f->session);
}

static void asset_paths(void **state) {
    struct fixture *f = *state;
    mkdir(scratch_path(&f->scratch, "scenes"), 0777);
    scratch_write(&f->scratch, "scenes/model.yaml", "glint: 1\nmodels: [{mesh: triangle.obj}]\n");
    assert_int_equal(load(f, "scenes/model.yaml"), SESSION_LOADED);
    expect_text(f, "[E601]");
    session_finish(&f->session);
    str folders[] = {str_from(f->scratch.folder)};
    f->options.asset_paths = folders;
    f->options.asset_path_count = 1;
    assert_int_equal(load(f, "scenes/model.yaml"), SESSION_LOADED);
    assert_int_equal(f->session.sink.errors, 0);
    session_finish(&f->session);
    folders[0] = str_from(scratch_path(&f->scratch, "triangle.obj"));
    assert_int_equal(load(f, "scenes/model.yaml"), SESSION_UNREADABLE);
    expect_text(f, "is not a folder");
    session_finish(&f->session);
}

static void expect_rebased(struct fixture *f, const char *out, const char *mesh, uint32_t warnings) {
    f->options.path = str_from(scratch_path(&f->scratch, "scenes/paths.yaml"));
    assert_int_equal(session_load_text(&f->session, &f->options), SESSION_LOADED);
    assert_true(session_rebase(&f->session, str_from(scratch_path(&f->scratch, out))));
    str got = f->session.scene->models.items[0].mesh.name;
    if (!str_equal_cstr(got, mesh))
        fail_msg("%s: %.*s is not %s", out, STR_ARG(got), mesh);
    assert_int_equal(f->session.sink.warnings, warnings);
    // What lies nowhere, and what lies somewhere for sure, stays.
    assert_true(str_equal_cstr(f->session.scene->models.items[1].mesh.name, "none.obj"));
    assert_true(str_equal_cstr(f->session.scene->models.items[2].mesh.name, "/none.obj"));
    session_finish(&f->session);
}

static void paths_follow_the_scene(void **state) {
    struct fixture *f = *state;
    mkdir(scratch_path(&f->scratch, "scenes"), 0777);
    mkdir(scratch_path(&f->scratch, "scenes/sub"), 0777);
    mkdir(scratch_path(&f->scratch, "other"), 0777);
    scratch_write(&f->scratch, "scenes/a.obj", "");
    scratch_write(&f->scratch, "scenes/paths.yaml",
                  "glint: 1\nmodels: [{mesh: a.obj}, {mesh: none.obj}, {mesh: /none.obj}]\n");
    expect_rebased(f, "scenes/x.xml", "a.obj", 0);
    expect_rebased(f, "scenes/sub/../x.xml", "a.obj", 0);
    expect_rebased(f, "x.xml", "scenes/a.obj", 0);
    expect_rebased(f, "scenes/sub/x.xml", "../a.obj", 1);
    expect_rebased(f, "other/x.xml", "../scenes/a.obj", 1);
    scratch_write(&f->scratch, ".glintrc.yaml", "");
    expect_rebased(f, "other/x.xml", "../scenes/a.obj", 0);
    scratch_write(&f->scratch, "scenes/paths.yaml",
                  "glint: 1\nmodels: [{mesh: ../triangle.obj}, {mesh: none.obj}, {mesh: /none.obj}]\n");
    expect_rebased(f, "x.xml", "triangle.obj", 0);
    expect_rebased(f, "other/x.xml", "../triangle.obj", 0);
    expect_rebased(f, "scenes/sub/x.xml", "../../triangle.obj", 0);
}

static void put_findings(const struct session *session, struct strbuf *text) {
    strbuf_init(text);
    diag_text(text, &session->sink, (struct source_set *)&session->sources,
              (struct diag_text_options){.notes = true});
    strbuf_format(text, "%u %u %u, state %d", session->sink.errors, session->sink.warnings,
                  session->sink.notes, session->state);
}

static bool has_pixels(const struct session *session) {
    return session->assets.background && session->assets.background->pixels;
}

static void count_call(void *context) {
    ++*(int *)context;
}

// Pixels that come later change nothing of what is found, nor its order, whatever is wrong.
static void pixels_may_come_later(void **state) {
    (void)state;
    static const struct {
        const char *path;
        bool waits, fails;
    } cases[] = {
        {"tests/invalid/w416_yaml/good.yaml", true, false},
        {"tests/invalid/e620_image/case.yaml", false, true},
        {"tests/invalid/e621_image/case.yaml", false, true},
        {"tests/invalid/e501_image/case.yaml", false, true},
        {"tests/invalid/n601_image/case.yaml", true, false},
        {"tests/invalid/e601_yaml_asset/case.yaml", false, true},
        {"tests/invalid/w416_yaml/case.yaml", true, false},
        {"tests/invalid/e203_yaml/case.yaml", false, true},
        {"scenes/elements/spheres.glint.yaml", false, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct session sessions[2];
        struct strbuf texts[2];
        struct asset_store *stores[2];
        int calls = 0;
        for (int later = 0; later < 2; later++) {
            const struct session_options options = {.path = str_from(cases[i].path),
                                                    .limits = limits_default(),
                                                    .lint = LINT_ALL,
                                                    .pixels_later = later,
                                                    .on_text = later ? count_call : NULL,
                                                    .on_text_context = &calls};
            stores[later] = asset_store_create();
            session_load(&sessions[later], &options, stores[later]);
            if (later && cases[i].waits)
                assert_true(sessions[later].unsettled);
            session_settle(&sessions[later]);
            assert_false(sessions[later].unsettled);
            put_findings(&sessions[later], &texts[later]);
        }
        assert_string_equal(texts[0].data, texts[1].data);
        assert_int_equal(sessions[0].sink.errors > 0, cases[i].fails);
        assert_int_equal(calls, strncmp(cases[i].path + strlen("tests/invalid/"), "e2", 2) != 0);
        assert_int_equal(has_pixels(&sessions[0]), has_pixels(&sessions[1]));
        if (has_pixels(&sessions[0]))
            assert_memory_equal(sessions[0].assets.background->pixels, sessions[1].assets.background->pixels,
                                sessions[0].assets.background->size_bytes);
        for (int later = 0; later < 2; later++) {
            strbuf_finish(&texts[later]);
            session_finish(&sessions[later]);
            asset_store_destroy(stores[later]);
        }
    }
}

// One that nobody waits for is not in the way.
static void pixels_may_never_be_wanted(void **state) {
    struct fixture *f = *state;
    const struct session_options options = {
        .path = STR("tests/invalid/n601_image/case.yaml"), .limits = limits_default(), .pixels_later = true};
    session_load(&f->session, &options, f->store);
    assert_true(f->session.unsettled && f->session.sink.errors == 0);
    session_finish(&f->session);
}

int main(void) {
#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        T(files_that_cannot_be_read), T(pixels_may_come_later),      T(pixels_may_never_be_wanted),
        T(what_is_no_scene),          T(a_scene_and_its_options),    T(cameras_by_name),
        T(a_mesh_is_a_scene),         T(text_alone_opens_no_assets), T(asset_paths),
        T(paths_follow_the_scene),
    };
    return cmocka_run_group_tests_name("session", tests, NULL, NULL);
}
