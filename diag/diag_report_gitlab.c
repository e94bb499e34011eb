// GitLab's Code Quality report: a list of issues with a fingerprint each.
#include "core/json_write.h"
#include "diag/diag_report_text.h"

#include <stdlib.h>

enum {
    FLAT_DEPTH = 2, // a line per issue
};

static void issue(struct json_writer *w, const struct report_item *item) {
    static const char *const severities[] = {"major", "minor", "info"};
    const struct report_finding *f = item->finding;
    struct strbuf text;
    strbuf_init(&text);
    json_open_object(w, NULL);
    json_write_text(w, "type", STR("issue"));
    json_write_text(w, "check_name", str_from(diag_info(f->code)->code));
    json_write_text(w, "description", f->message);
    if (f->help.len) {
        json_open_object(w, "content");
        json_write_text(w, "body", f->help);
        json_close_object(w);
    }
    json_open_list(w, "categories");
    json_write_text(w, NULL, STR("Bug Risk"));
    json_close_list(w);
    json_write_text(w, "severity", str_from(severities[f->severity]));
    strbuf_format(&text, "%016llx%08x", (unsigned long long)item->fingerprint, item->occurrence);
    json_write_text(w, "fingerprint", strbuf_view(&text));
    json_open_object(w, "location");
    json_write_text(w, "path", f->at.path);
    json_open_object(w, "lines");
    json_write_integer(w, "begin", f->at.line);
    json_write_integer(w, "end", f->at.end_line);
    json_close_object(w);
    json_close_object(w);
    json_close_object(w);
    w->out->failed = w->out->failed || text.failed;
    strbuf_finish(&text);
}

void report_gitlab(struct strbuf *out, const struct report *report) {
    struct report_list list;
    struct json_writer w;
    if (!report_list_all(report, &list))
        out->failed = true;
    json_writer_init(&w, out, FLAT_DEPTH);
    json_open_list(&w, NULL);
    for (uint32_t i = 0; i < list.count; i++)
        issue(&w, &list.items[i]);
    json_close_list(&w);
    json_end(&w);
    free(list.items);
}
