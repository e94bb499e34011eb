// Random scenes, and the verdict on what auto chose for a scene.
#include "core/limits.h"
#include "device_kit.h"
#include "grammar/ir.h"
#include "load/session.h"
#include "tests/sweep/sweep.h"

#include <stdio.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

// ---- scenes

enum {
    NUMBERS = 6, // of each family
};

static bool is_same(const struct sweep_scene *a, const struct sweep_scene *b) {
    if (!str_equal(strbuf_view(&a->text), strbuf_view(&b->text)) || a->mesh_count != b->mesh_count)
        return false;
    for (uint32_t i = 0; i < a->mesh_count; i++)
        if (!str_equal(strbuf_view(&a->meshes[i].text), strbuf_view(&b->meshes[i].text)))
            return false;
    return true;
}

// A scene depends on seed, family and number, and on nothing else.
static void test_same_scene(void **state) {
    (void)state;
    for (int family = 0; family < SWEEP_FAMILIES; family++) {
        struct sweep_scene one, again, next, other;
        sweep_scene_make(&one, 7, (enum sweep_family)family, 3);
        sweep_scene_make(&next, 7, (enum sweep_family)family, 4);
        sweep_scene_make(&again, 7, (enum sweep_family)family, 3);
        sweep_scene_make(&other, 8, (enum sweep_family)family, 3);
        assert_true(is_same(&one, &again));
        assert_false(is_same(&one, &next));
        assert_false(is_same(&one, &other));
        struct sweep_scene *const all[] = {&one, &again, &next, &other};
        for (int i = 0; i < 4; i++)
            sweep_scene_finish(all[i]);
    }
}

static struct session_options options_of(const struct sweep_scene *made, struct file_overlay *overlays,
                                         char paths[SWEEP_MESHES + 1][SWEEP_NAME_BYTES + 1]) {
    struct session_options options = {.overlays = overlays, .overlay_count = made->mesh_count + 1};
    options.limits = limits_default();
    for (uint32_t i = 0; i <= made->mesh_count; i++) {
        const struct strbuf *text = i ? &made->meshes[i - 1].text : &made->text;
        snprintf(paths[i], SWEEP_NAME_BYTES + 1, "/%s", i ? made->meshes[i - 1].name : made->name);
        overlays[i] = (struct file_overlay){str_from(paths[i]), strbuf_view(text)};
    }
    options.path = overlays[0].path;
    return options;
}

static void load(const struct sweep_scene *made, struct session *session, struct asset_store *store) {
    struct file_overlay overlays[SWEEP_MESHES + 1];
    char paths[SWEEP_MESHES + 1][SWEEP_NAME_BYTES + 1];
    const struct session_options options = options_of(made, overlays, paths);
    session_load(session, &options, store);
    if (session->sink.errors)
        print_error("%s: %.*s\n%.*s\n", made->name, STR_ARG(session->sink.items[0].message),
                    STR_ARG(strbuf_view(&made->text)));
    assert_int_equal(session->state, SESSION_LOADED);
    assert_int_equal(session->sink.errors, 0);
}

// Each scene is one that the language knows, and has bodies and a camera.
static void test_scenes_load(void **state) {
    (void)state;
    for (int family = 0; family < SWEEP_FAMILIES; family++)
        for (uint32_t number = 0; number < NUMBERS; number++) {
            struct sweep_scene made;
            struct session session;
            struct asset_store *store = asset_store_create();
            sweep_scene_make(&made, 1, (enum sweep_family)family, number);
            load(&made, &session, store);
            assert_true(session.resolved.body_count > 0);
            assert_int_equal(session.scene->cameras.count, 1);
            session_finish(&session);
            asset_store_destroy(store);
            sweep_scene_finish(&made);
        }
}

static void test_turns(void **state) {
    (void)state;
    const struct sweep_input input = {.families = 1u << SWEEP_PIPE | 1u << SWEEP_RAILS, .count = 5};
    static const enum sweep_family families[] = {SWEEP_PIPE, SWEEP_RAILS, SWEEP_PIPE, SWEEP_RAILS,
                                                 SWEEP_PIPE};
    for (uint32_t i = 0; i < 5; i++) {
        enum sweep_family family;
        uint32_t number;
        sweep_which(&input, i, &family, &number);
        assert_int_equal(family, families[i]);
        assert_int_equal(number, i / 2);
    }
}

// ---- verdicts

// A ball and a plate; `far`: the ball is so far away that no float holds its place, and fills the picture.
static void write_scene(struct sweep_scene *made, const char *precision, bool far) {
    *made = (struct sweep_scene){.family = SWEEP_STILL, .name = "made.glint.yaml"};
    strbuf_format(&made->text,
                  "glint: 1\ntrace: {precision: %s}\nbackground: {color: [0.1, 0.2, 0.3]}\n"
                  "camera: {position: [0.3, 0.2, 5], fov: %s}\nlights: [{position: [3, 4, 5]}]\n"
                  "spheres: [{center: [0.1, 0, %s], radius: 0.8}]\n"
                  "rectangles: [{corner: [-2, -1, 1], edge_u: [3, 0, 0.1], edge_v: [0, 0.2, -3]}]\n",
                  precision, far ? "1e-6" : "40", far ? "-123456789.3" : "0");
}

static enum sweep_verdict judge(struct gpu *gpu, const struct sweep_scene *made, struct sweep_item *item) {
    const struct limits limits = limits_default();
    struct session session;
    struct sweep sweep;
    const struct sweep_input input = {.gpu = gpu, .limits = &limits, .width = 32, .height = 24, .count = 1};
    struct asset_store *store = asset_store_create();
    load(made, &session, store);
    assert_true(sweep_init(&sweep, &input));
    assert_int_equal(sweep_judge(&sweep, &input, made, &session.resolved), SWEEP_DONE);
    assert_int_equal(sweep.count, 1);
    assert_int_equal(sweep.verdicts[sweep.items[0].verdict], 1);
    *item = sweep.items[0];
    sweep_finish(&sweep);
    session_finish(&session);
    asset_store_destroy(store);
    return item->verdict;
}

static void test_verdicts(void **state) {
    struct gpu *gpu = device_kit_need(state, true);
    static const struct {
        const char *precision;
        bool far, closed;
        enum sweep_verdict verdict;
    } cases[] = {
        {"single", false, false, SWEEP_RIGHT}, {"double", false, false, SWEEP_NEEDLESS},
        {"single", true, false, SWEEP_WRONG},  {"double", true, false, SWEEP_RIGHT},
        {"single", false, true, SWEEP_RIGHT},  {"auto", false, false, SWEEP_RIGHT},
        {"auto", true, false, SWEEP_RIGHT},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct sweep_scene made;
        struct sweep_item item;
        write_scene(&made, cases[i].precision, cases[i].far);
        made.closed = cases[i].closed;
        const enum sweep_verdict verdict = judge(gpu, &made, &item);
        sweep_scene_finish(&made);
        assert_int_equal(verdict, cases[i].verdict);
        assert_int_equal(item.is_double, strcmp(cases[i].precision, "auto") == 0
                                             ? cases[i].far
                                             : strcmp(cases[i].precision, "double") == 0);
    }
}

// A room with a missing wall and a bright background: every tracer sees it.
static void test_background(void **state) {
    struct gpu *gpu = device_kit_need(state, true);
    struct sweep_scene made = {.family = SWEEP_CORRIDOR, .name = "made.glint.yaml", .closed = true};
    strbuf_cstr(&made.text,
                "glint: 1\nbackground: {color: [1, 1, 1], intensity: 1e6}\ncamera: {position: [0, 0, 3]}\n"
                "spheres: [{center: [0.1, 0, 0], radius: 1}]\nlights: [{position: [3, 4, 5]}]\n");
    struct sweep_item item;
    assert_int_equal(judge(gpu, &made, &item), SWEEP_BEYOND);
    for (int i = 0; i < SWEEP_TRACERS; i++) {
        assert_true(item.pictures[i].wrong);
        assert_in_range(item.pictures[i].background, 100, 32 * 24 - 1);
    }
    assert_true(sweep_is_noted(&item));
    sweep_scene_finish(&made);
}

static void test_bounds(void **state) {
    (void)state;
    struct sweep sweep = {.count = 100, .doubles = 20, .verdicts = {[SWEEP_WRONG] = 2, [SWEEP_NEEDLESS] = 1}};
    struct sweep_report report = {.sweep = &sweep, .max_wrong = 2, .max_needless = 0.05};
    assert_false(sweep_is_broken(&report));
    report.max_wrong = 1;
    assert_true(sweep_is_broken(&report));
    report.max_wrong = 2;
    sweep.verdicts[SWEEP_NEEDLESS] = 2;
    assert_true(sweep_is_broken(&report));
    sweep.doubles = sweep.verdicts[SWEEP_NEEDLESS] = 0;
    assert_false(sweep_is_broken(&report));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_scene),   cmocka_unit_test(test_scenes_load),
        cmocka_unit_test(test_turns),        cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_verdicts),     cmocka_unit_test(test_background),
        cmocka_unit_test(device_kit_silent),
    };
    return cmocka_run_group_tests(tests, device_kit_setup, device_kit_teardown);
}
