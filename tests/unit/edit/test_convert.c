// `convert` proves what it wrote: a text that means something else, or that cannot be read, is refused.
#include "edit/convert.h"

#include "diag/diag_text.h"
#include "scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

struct fixture {
    struct scratch scratch;
    struct session session;
    struct strbuf text;
};

static int set_up(void **state) {
    static struct fixture fixture;
    struct fixture *f = &fixture;
    struct session_options options = {.limits = limits_default()};
    *f = (struct fixture){0};
    *state = f;
    if (!scratch_make(&f->scratch))
        return 1;
    scratch_write(&f->scratch, "a.xml",
                  "<Scene glint=\"1\">\n<!-- one\r two -->\n<Image width=\"9\" height=\"8\"/>\n</Scene>\n");
    options.path = str_from(scratch_path(&f->scratch, "a.xml"));
    strbuf_init(&f->text);
    return session_load_text(&f->session, &options) != SESSION_LOADED;
}

static int tear_down(void **state) {
    struct fixture *f = *state;
    strbuf_finish(&f->text);
    session_finish(&f->session);
    scratch_finish(&f->scratch);
    return 0;
}

static void assert_refused(struct fixture *f, str text, const char *note) {
    struct strbuf said;
    assert_int_equal(convert_check(&f->session, CONVERT_YAML, text), CONVERT_UNSAFE);
    strbuf_init(&said);
    diag_text(&said, &f->session.sink, &f->session.sources, (struct diag_text_options){.notes = true});
    assert_non_null(strstr(said.data, "a.xml:1:1: error: converted, the scene would have another meaning"));
    if (!strstr(said.data, note))
        fail_msg("'%s' is not in:\n%s", note, said.data);
    strbuf_finish(&said);
}

static void what_means_the_same_is_written(void **state) {
    struct fixture *f = *state;
    strbuf_cstr(&f->text, "before\n");
    assert_int_equal(convert_write(&f->session, CONVERT_YAML, &f->text), CONVERT_DONE);
    assert_string_equal(f->text.data, "before\nglint: 1\n\n# one\n# two\nimage: {width: 9, height: 8}\n");
    assert_int_equal(f->session.sink.count, 0);
}

static void another_meaning_is_refused(void **state) {
    assert_refused(*state, STR("glint: 1\nimage: {width: 9, height: 7}\n"),
                   "the first line that differs: height: 8");
}

static void more_than_there_was_is_refused(void **state) {
    assert_refused(*state, STR("glint: 1\nimage: {width: 9, height: 8, samples: 4}\n"),
                   "the first line that differs: samples: 4");
}

static void what_cannot_be_read_is_refused(void **state) {
    assert_refused(*state, STR("glint: 1\n two -->\n"), "read again: ");
    assert_refused(*state, STR(""), "read again: ");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(what_means_the_same_is_written, set_up, tear_down),
        cmocka_unit_test_setup_teardown(another_meaning_is_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(more_than_there_was_is_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_cannot_be_read_is_refused, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
