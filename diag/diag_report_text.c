#include "diag/diag_report_text.h"

#include "diag/diag_text.h"

void report_line(struct strbuf *out, const struct report_finding *finding) {
    diag_text_plain(out, finding->at.path);
    strbuf_format(out, ":%u:%u: %s: ", finding->at.line, finding->at.column, report_severity(finding));
    diag_text_plain(out, finding->message);
    strbuf_format(out, " [%s]", diag_info(finding->code)->code);
}

void report_left_out(struct strbuf *out, const struct report_scene *scene) {
    const uint32_t count = scene->left_out.count;
    strbuf_format(out, "%u more finding%s of ", count, count == 1 ? "" : "s");
    diag_text_plain(out, scene->path);
    strbuf_format(out, " %s not listed (", count == 1 ? "is" : "are");
    diag_hidden_codes(out, &scene->left_out);
    strbuf_format(out, "); --max-messages %u lists all\n", report_needed(scene));
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

void report_copies(struct json_writer *w, const struct report_finding *finding) {
    if (finding->with)
        json_open_object(w, "with");
    for (const struct diag_value *v = finding->with; v; v = v->next)
        if (v->value.ptr[0] == '#') // a colour; other values are JSON
            json_write_text(w, v->name.ptr, v->value);
        else
            json_write_literal(w, v->name.ptr, v->value);
    if (finding->with)
        json_close_object(w);
    json_write_integer(w, "copies", finding->copies);
}

void report_markup(struct strbuf *out, str s) {
    struct strbuf text;
    strbuf_init(&text);
    diag_text_plain(&text, s);
    str view = strbuf_view(&text);
    size_t from = 0;
    for (size_t at = 0; at + 3 <= view.len; at++) {
        bool none = (unsigned char)view.ptr[at] == 0xEF && (unsigned char)view.ptr[at + 1] == 0xBF &&
                    (unsigned char)view.ptr[at + 2] >= 0xBE;
        if (!none)
            continue;
        strbuf_markup(out, str_slice(view, from, at));
        strbuf_char(out, '?');
        from = at + 3;
    }
    strbuf_markup(out, str_slice(view, from, view.len));
    out->failed = out->failed || text.failed;
    strbuf_finish(&text);
}
