// A scene whose text is kept: sessions of it are what they would be if each had read the files.
#include "diag/diag_text.h"
#include "grammar/ir.h"
#include "load/session_kept.h"
#include "scene/content.h"

#include "scratch.h"

#include <stdio.h>
#include <utime.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

struct fixture {
    struct scratch scratch;
    struct asset_store *store;
    struct session_options options;
    char path[4096];
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
    scratch_write(
        &f->scratch, "shared.yaml",
        "glint: 1\nmaterials: {red: {diffuse_color: [1, 0, 0]}}\n"
        "spheres: [{name: other, center: [3, 0, 0], radius: 1, material: {specular_exponent: 9}}]\n");
    scratch_write(
        &f->scratch, "scene.yaml",
        "glint: 1\ninclude: [shared.yaml]\nimage: {width: 16, height: 12}\n"
        "camera: {position: [0, 1, 9]}\nlights: [{position: [1, 5, 3]}]\n"
        "materials: {ball: {diffuse_color: {checker: {colors: [0.1, [0.9, 0.8, 0.7]], size: 0.5}}}}\n"
        "spheres: [{name: ball, center: [0, 0, 0], radius: 1, material: ball}]\n"
        "models: [{mesh: triangle.obj, material: {diffuse_color: 0.5}}]\n"
        "animation: {frames: 9, tracks: {background.color: '0.1, 0.1*frame, 0', "
        "'spheres[ball].radius': {keys: [{frame: 0, value: 1}, {frame: 8, value: 2}]}}}\n");
    snprintf(f->path, sizeof f->path, "%s", scratch_path(&f->scratch, "scene.yaml"));
    f->options.path = str_from(f->path);
    return 0;
}

static int tear_down(void **state) {
    struct fixture *f = *state;
    asset_store_destroy(f->store);
    scratch_finish(&f->scratch);
    return 0;
}

// What a session has to say, and its scene's hash.
static void describe(struct fixture *f, struct session_kept *kept, str set, struct strbuf *out) {
    struct session session;
    struct session_options options = f->options;
    char hash[SCENE_CONTENT_TEXT] = "no scene";
    options.sets = &set;
    options.set_count = set.len > 0;
    options.kept = kept;
    session_load(&session, &options, f->store);
    if (session.state == SESSION_LOADED)
        scene_content_text(&session.resolved, hash);
    strbuf_cstr(out, hash);
    strbuf_char(out, '\n');
    diag_text(out, &session.sink, &session.sources, (struct diag_text_options){.notes = true});
    strbuf_format(out, "%u files\n", session.files.log.count);
    session_finish(&session);
}

static void sessions_are_the_same(void **state) {
    struct fixture *f = *state;
    static const char *const sets[] = {"",
                                       "animation.frame=0",
                                       "animation.frame=5",
                                       "animation.frame=8",
                                       "spheres[ball].radius=3",
                                       "spheres[other].material.specular_exponent=33",
                                       "materials.red.diffuse_color=[0, 1, 0]",
                                       "camera.fov=50",
                                       "models[0].material=red",
                                       "spheres[ball].radius=-3",
                                       "spheres[bal].radius=3",
                                       "materials.new.refractive_index=2",
                                       "animation.frame=99",
                                       ""};
    struct session_kept *kept = session_keep(&f->options);
    assert_non_null(kept);
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        struct strbuf own, again;
        strbuf_init(&own);
        strbuf_init(&again);
        describe(f, NULL, str_from(sets[i]), &own);
        describe(f, kept, str_from(sets[i]), &again);
        assert_string_equal(own.data, again.data);
        strbuf_finish(&own);
        strbuf_finish(&again);
    }
    session_kept_release(kept);
}

static void sessions_outlive_who_kept(void **state) {
    struct fixture *f = *state;
    struct session session;
    struct session_options options = f->options;
    options.kept = session_keep(&f->options);
    assert_non_null(options.kept);
    session_load(&session, &options, f->store);
    session_kept_release(options.kept);
    assert_true(str_equal(session.scene->spheres.items[0].name, STR("other")));
    session_finish(&session);
}

static void what_changed_is_read_again(void **state) {
    struct fixture *f = *state;
    struct session_kept *kept = session_keep(&f->options);
    struct session_options other = f->options;
    assert_non_null(kept);
    assert_true(session_kept_fits(kept, &f->options));
    other.path = STR("elsewhere.yaml");
    assert_false(session_kept_fits(kept, &other));
    other = f->options;
    other.limits.value[LIMIT_SCENE_BYTES]--;
    assert_false(session_kept_fits(kept, &other));
    const struct utimbuf past = {1000, 1000};
    utime(scratch_path(&f->scratch, "shared.yaml"), &past);
    assert_false(session_kept_fits(kept, &f->options));
    session_kept_release(kept);
}

static void what_has_findings_is_not_kept(void **state) {
    struct fixture *f = *state;
    scratch_write(&f->scratch, "scene.yaml", "glint: 1\nspheres: [{center: [0, 0, 0], radius: -1}]\n");
    assert_null(session_keep(&f->options));
    scratch_write(&f->scratch, "scene.yaml", "glint: 1\ninclude: [none.yaml]\n");
    assert_null(session_keep(&f->options));
    f->options.path = str_from(scratch_path(&f->scratch, "triangle.obj"));
    assert_null(session_keep(&f->options));
    f->options.path = STR("nowhere.yaml");
    assert_null(session_keep(&f->options));
}

int main(void) {
#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        T(sessions_are_the_same),
        T(sessions_outlive_who_kept),
        T(what_changed_is_read_again),
        T(what_has_findings_is_not_kept),
    };
    return cmocka_run_group_tests_name("session_kept", tests, NULL, NULL);
}
