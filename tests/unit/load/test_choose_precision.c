// The precision of a shot: setting, scene and device together, and what is said about it.
#include "device_kit.h"
#include "diag/codes/device.h"
#include "grammar/ir.h"
#include "load/session_precision.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

struct fixture {
    struct asset_store *store;
    struct session session;
    struct view view;
    struct flat_input input;
};

static void begin(struct fixture *f, const char *path, const char *set) {
    const str sets[] = {str_from(set)};
    const struct session_options options = {
        .path = str_from(path), .limits = limits_default(), .sets = sets, .set_count = 1};
    f->store = asset_store_create();
    assert_int_equal(session_load(&f->session, &options, f->store), SESSION_LOADED);
    assert_int_equal(f->session.sink.errors, 0);
    assert_true(session_view(&f->session, 0, &f->view));
    f->input = precision_input(&f->session, &f->view);
}

static void end(struct fixture *f) {
    session_finish(&f->session);
    asset_store_destroy(f->store);
}

static const char far_scene[] = "scenes/elements/precision.glint.yaml";
static const char near_scene[] = "scenes/elements/spheres.glint.yaml";

static enum precision_status choose(struct fixture *f, void **state, bool has_double) {
    return precision_choose(&f->session, &f->input, device_kit_need(state, has_double), has_double,
                            (struct precision_wish){0}, NULL);
}

static void test_settings(void **state) {
    static const struct {
        const char *path, *set;
        bool is_double;
    } cases[] = {
        {far_scene, "trace.precision=auto", true},    {near_scene, "trace.precision=auto", false},
        {far_scene, "trace.precision=single", false}, {near_scene, "trace.precision=single", false},
        {far_scene, "trace.precision=double", true},  {near_scene, "trace.precision=double", true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct fixture f;
        begin(&f, cases[i].path, cases[i].set);
        assert_int_equal(choose(&f, state, true), PRECISION_DONE);
        assert_int_equal(f.input.is_double, cases[i].is_double);
        assert_int_equal(f.session.sink.count, 0);
        end(&f);
    }
}

// A device that cannot: an error where it was asked for, a warning where it would be needed.
static void test_device_without(void **state) {
    struct fixture f;
    begin(&f, near_scene, "trace.precision=double");
    assert_int_equal(choose(&f, state, false), PRECISION_SCENE);
    assert_int_equal(f.session.sink.errors, 1);
    assert_int_equal(f.session.sink.items[0].code, DIAG_NO_DOUBLE);
    assert_false(span_is_none(f.session.sink.items[0].at));
    end(&f);
    begin(&f, far_scene, "trace.precision=auto");
    assert_int_equal(choose(&f, state, false), PRECISION_DONE);
    assert_false(f.input.is_double);
    assert_int_equal(f.session.sink.errors, 0);
    assert_int_equal(f.session.sink.count, 1);
    assert_int_equal(f.session.sink.items[0].code, DIAG_SINGLE_ONLY);
    assert_false(span_is_none(f.session.sink.items[0].at));
    end(&f);
    begin(&f, near_scene, "trace.precision=auto");
    assert_int_equal(choose(&f, state, false), PRECISION_DONE);
    assert_int_equal(f.session.sink.count, 0);
    end(&f);
}

static void expect_words(const char *path, const char *set, const char *const *parts) {
    struct fixture f;
    struct strbuf text;
    struct precision_choice choice;
    strbuf_init(&text);
    begin(&f, path, set);
    assert_true(precision_forecast(&f.session, &f.input, &choice));
    precision_words(&f.session, &choice, &text);
    for (; *parts; parts++)
        if (!strstr(text.data, *parts))
            fail_msg("'%s' is not in:\n%.*s", *parts, (int)text.len, text.data);
    strbuf_finish(&text);
    end(&f);
}

static void test_words(void **state) {
    (void)state;
    static const char *const far_parts[] = {"precision   double, the setting is auto",
                                            "pixels traced in both precisions differ",
                                            "scenes/elements/precision.glint.yaml:20:5", "steps", NULL};
    static const char *const single_parts[] = {"precision   single, the setting is single", "differ", NULL};
    static const char *const near_parts[] = {"precision   single, the setting is auto", "0 of ",
                                             "smallest body", NULL};
    expect_words(far_scene, "trace.precision=auto", far_parts);
    expect_words(far_scene, "trace.precision=single", single_parts);
    expect_words(near_scene, "trace.precision=auto", near_parts);
}

// The setting is obeyed; auto follows the trial.
static void test_choice(void **state) {
    (void)state;
    struct ir_scene ir = {0};
    for (int needs = 0; needs < 2; needs++) {
        const struct precision_choice choice = {.needs_double = needs};
        ir.trace.precision = IR_PRECISION_AUTO;
        assert_int_equal(precision_is_double(&ir, &choice), needs);
        ir.trace.precision = IR_PRECISION_SINGLE;
        assert_false(precision_is_double(&ir, &choice));
        ir.trace.precision = IR_PRECISION_DOUBLE;
        assert_true(precision_is_double(&ir, &choice));
    }
}

// A trial that finds single precision enough hands on the scene that it flattened, and says what it traced.
static void test_trial(void **state) {
    for (int needs = 0; needs < 2; needs++) {
        struct fixture f;
        struct precision_gains gains;
        struct precision_choice choice;
        begin(&f, needs ? far_scene : near_scene, "trace.precision=auto");
        const struct precision_trial trial = {
            .input = &f.input, .width = 64, .height = 48, .gpu = device_kit_need(state, true)};
        assert_int_equal(precision_try(&trial, &choice, &gains), PRECISION_DONE);
        assert_true(choice.traced && choice.on_device && choice.pixels == 64 * 48);
        assert_int_equal(choice.needs_double, needs);
        assert_int_equal(choice.off > 3, needs);
        assert_int_equal(gains.has_flat, !needs);
        assert_int_equal(gains.renderer != NULL, !needs);
        if (gains.has_flat)
            assert_true(gains.flat.sphere_count > 0 && !gains.flat.is_double);
        precision_drop(&gains);
        end(&f);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_choice),   cmocka_unit_test(test_trial),
        cmocka_unit_test(test_settings), cmocka_unit_test(test_device_without),
        cmocka_unit_test(test_words),    cmocka_unit_test(device_kit_silent),
    };
    return cmocka_run_group_tests_name("choose_precision", tests, device_kit_setup, device_kit_teardown);
}
