#include "diag/diag_report_text.h"

#include "diag/diag_text.h"

void report_message(struct strbuf *out, const struct report_finding *finding) {
    strbuf_str(out, finding->message);
    if (finding->repeats)
        strbuf_format(out, " (and %u more like it)", finding->repeats);
}

void report_line(struct strbuf *out, const struct report_finding *finding) {
    struct strbuf message;
    strbuf_init(&message);
    report_message(&message, finding);
    diag_text_plain(out, finding->at.path);
    strbuf_format(out, ":%u:%u: %s: ", finding->at.line, finding->at.column, report_severity(finding));
    diag_text_plain(out, strbuf_view(&message));
    strbuf_format(out, " [%s]", diag_info(finding->code)->code);
    out->failed = out->failed || message.failed;
    strbuf_finish(&message);
}

static void one_count(struct strbuf *out, uint32_t count, const char *word, bool *first) {
    if (count == 0)
        return;
    strbuf_format(out, "%s%u %s%s", *first ? "" : ", ", count, word, count == 1 ? "" : "s");
    *first = false;
}

void report_counts(struct strbuf *out, uint32_t errors, uint32_t warnings, uint32_t notes) {
    bool first = true;
    one_count(out, errors, "error", &first);
    one_count(out, warnings, "warning", &first);
    one_count(out, notes, "note", &first);
    if (first)
        strbuf_cstr(out, "no findings");
}

const char *report_severity(const struct report_finding *finding) {
    return diag_severity_name(finding->severity);
}
