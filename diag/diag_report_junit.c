// JUnit's XML: a test case per scene, for tools that show test results.
#include "diag/diag_report_text.h"

static void lines(struct strbuf *out, const struct report_scene *scene) {
    struct strbuf line;
    strbuf_init(&line);
    for (uint32_t i = 0; i < scene->findings.count; i++) {
        strbuf_clear(&line);
        report_line(&line, &scene->findings.items[i]);
        report_markup(out, strbuf_view(&line));
        strbuf_char(out, '\n');
        if (scene->findings.items[i].help.len) {
            strbuf_cstr(out, "    help: ");
            report_markup(out, scene->findings.items[i].help);
            strbuf_char(out, '\n');
        }
    }
    if (scene->left_out.count)
        report_left_out(out, scene);
    out->failed = out->failed || line.failed;
    strbuf_finish(&line);
}

// The worst finding: the first error, else the first warning.
static const struct report_finding *worst(const struct report_scene *scene) {
    const struct report_finding *found = NULL;
    for (uint32_t i = 0; i < scene->findings.count; i++)
        if (!found || scene->findings.items[i].severity < found->severity)
            found = &scene->findings.items[i];
    return found;
}

static void fault(struct strbuf *out, const struct report_scene *scene, const char *element) {
    const struct report_finding *first = worst(scene);
    strbuf_format(out, "      <%s message=\"", element);
    report_counts(out, scene->errors, scene->warnings, scene->notes);
    strbuf_format(out, "\" type=\"%s\">", first ? diag_info(first->code)->code : "");
    lines(out, scene);
    strbuf_format(out, "</%s>\n", element);
}

static void test_case(struct strbuf *out, const struct report_scene *scene) {
    strbuf_cstr(out, "    <testcase classname=\"glint.check\" name=\"");
    report_markup(out, scene->path);
    strbuf_cstr(out, "\" file=\"");
    report_markup(out, scene->path);
    strbuf_cstr(out, "\" time=\"0\">\n");
    if (scene->state == REPORT_FAILED)
        fault(out, scene, "failure");
    else if (scene->state == REPORT_UNREADABLE)
        fault(out, scene, "error");
    else if (scene->state == REPORT_IGNORED)
        strbuf_cstr(out, "      <skipped message=\"ignored by the configuration\"/>\n");
    if (scene->state == REPORT_PASSED && scene->findings.count) {
        strbuf_cstr(out, "      <system-out>");
        lines(out, scene);
        strbuf_cstr(out, "</system-out>\n");
    }
    strbuf_cstr(out, "    </testcase>\n");
}

void report_junit(struct strbuf *out, const struct report *report) {
    unsigned counts[4] = {0};
    for (uint32_t i = 0; i < report->scene_count; i++)
        counts[report->scenes[i].state]++;
    strbuf_cstr(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    for (int level = 0; level < 2; level++)
        strbuf_format(out,
                      "%s name=\"glint check\" tests=\"%u\" failures=\"%u\" errors=\"%u\" skipped=\"%u\" "
                      "time=\"0\">\n",
                      level == 0 ? "<testsuites" : "  <testsuite", report->scene_count, counts[REPORT_FAILED],
                      counts[REPORT_UNREADABLE], counts[REPORT_IGNORED]);
    for (uint32_t i = 0; i < report->scene_count; i++)
        test_case(out, &report->scenes[i]);
    strbuf_cstr(out, "  </testsuite>\n</testsuites>\n");
}
