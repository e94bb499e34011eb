// The results of glint test as JUnit's XML: a test case per picture.
#include "cli/commands/test/test.h"

#include "diag/diag_report_text.h"

static void element(const struct test_case *test, const char *name, struct strbuf *out) {
    struct strbuf words;
    strbuf_init(&words);
    test_figures(test, &words);
    strbuf_format(out, "      <%s message=\"", name);
    report_markup(out, strbuf_view(&words));
    strbuf_format(out, "\" type=\"%s\">", test_state_words[test->state]);
    strbuf_cstr(out, "scene: ");
    report_markup(out, test->scene);
    strbuf_cstr(out, "\nreference: ");
    report_markup(out, test->picture);
    strbuf_char(out, '\n');
    report_markup(out, strbuf_view(&words));
    if (test->record.len) {
        strbuf_char(out, '\n');
        report_markup(out, test->record);
    }
    strbuf_format(out, "</%s>\n", name);
    out->failed = out->failed || words.failed;
    strbuf_finish(&words);
}

static void test_case(const struct test_case *test, struct strbuf *out) {
    strbuf_cstr(out, "    <testcase classname=\"glint.test\" name=\"");
    report_markup(out, test->name);
    strbuf_cstr(out, "\" file=\"");
    report_markup(out, test->scene);
    strbuf_format(out, "\" time=\"%.3f\">\n", test->seconds);
    if (!test->is_written && (test->state == TEST_DIFFERS || test->state == TEST_MISSING))
        element(test, "failure", out);
    else if (test->state == TEST_FAILED)
        element(test, "error", out);
    strbuf_cstr(out, "    </testcase>\n");
}

void test_junit(const struct test_run *run, struct strbuf *out) {
    const struct test_counts c = test_count(run);
    const uint32_t failures = c.all - c.good - c.of[TEST_FAILED];
    strbuf_cstr(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    for (int level = 0; level < 2; level++)
        strbuf_format(out,
                      "%s name=\"glint test\" tests=\"%u\" failures=\"%u\" errors=\"%u\" skipped=\"0\" "
                      "time=\"%.3f\">\n",
                      level == 0 ? "<testsuites" : "  <testsuite", c.all, failures, c.of[TEST_FAILED],
                      run->seconds);
    for (uint32_t i = 0; i < run->cases.count; i++)
        test_case(&run->cases.items[i], out);
    strbuf_cstr(out, "  </testsuite>\n</testsuites>\n");
}
