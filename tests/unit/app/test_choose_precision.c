// The precision of a shot: setting, scene and device together, and what is said about it.
#include "app/precision.h"

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

static void test_settings(void **state) {
    (void)state;
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
        assert_true(precision_choose(&f.session, &f.input, true));
        assert_int_equal(f.input.is_double, cases[i].is_double);
        assert_int_equal(f.session.sink.count, 0);
        end(&f);
    }
}

// A device that cannot: an error where it was asked for, a warning where it would be needed.
static void test_device_without(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, near_scene, "trace.precision=double");
    assert_false(precision_choose(&f.session, &f.input, false));
    assert_int_equal(f.session.sink.errors, 1);
    assert_int_equal(f.session.sink.items[0].code, DIAG_NO_DOUBLE);
    assert_false(span_is_none(f.session.sink.items[0].at));
    end(&f);
    begin(&f, far_scene, "trace.precision=auto");
    assert_true(precision_choose(&f.session, &f.input, false));
    assert_false(f.input.is_double);
    assert_int_equal(f.session.sink.errors, 0);
    assert_int_equal(f.session.sink.count, 1);
    assert_int_equal(f.session.sink.items[0].code, DIAG_SINGLE_ONLY);
    assert_false(span_is_none(f.session.sink.items[0].at));
    end(&f);
    begin(&f, near_scene, "trace.precision=auto");
    assert_true(precision_choose(&f.session, &f.input, false));
    assert_int_equal(f.session.sink.count, 0);
    end(&f);
}

static void expect_words(const char *path, const char *set, const char *const *parts) {
    struct fixture f;
    struct strbuf text;
    struct precision_report report;
    strbuf_init(&text);
    begin(&f, path, set);
    assert_true(precision_measure(&f.input, &report));
    precision_words(&f.session, &report, &text);
    for (; *parts; parts++)
        if (!strstr(text.data, *parts))
            fail_msg("'%s' is not in:\n%.*s", *parts, (int)text.len, text.data);
    strbuf_finish(&text);
    end(&f);
}

static void test_words(void **state) {
    (void)state;
    static const char *const far_parts[] = {"precision   double, the setting is auto",
                                            "single precision does not suffice: the smallest body decides",
                                            "scenes/elements/precision.glint.yaml:20:5", "16 steps", NULL};
    static const char *const single_parts[] = {"precision   single, the setting is single",
                                               "does not suffice", NULL};
    static const char *const near_parts[] = {"precision   single, the setting is auto",
                                             "single precision suffices", "smallest body", NULL};
    expect_words(far_scene, "trace.precision=auto", far_parts);
    expect_words(far_scene, "trace.precision=single", single_parts);
    expect_words(near_scene, "trace.precision=auto", near_parts);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_settings),
        cmocka_unit_test(test_device_without),
        cmocka_unit_test(test_words),
    };
    return cmocka_run_group_tests_name("choose_precision", tests, NULL, NULL);
}
