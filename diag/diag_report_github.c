// GitHub Actions annotations, the worst first. GitHub shows ten of each kind per step: the rest become plain
// log lines, and the last notice says how many there are.
#include "diag/diag_report_text.h"
#include "diag/diag_text.h"

#include <stdlib.h>

enum {
    SHOWN_MAX = 10
};

static const char *const kinds[] = {"error", "warning", "notice"};

static void escape(struct strbuf *out, str s, bool property) {
    for (size_t i = 0; i < s.len; i++) {
        char c = s.ptr[i];
        if (c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ',')))
            strbuf_format(out, "%%%02X", (unsigned char)c);
        else
            strbuf_char(out, c);
    }
}

static void annotation(struct strbuf *out, const struct report_finding *f) {
    struct strbuf text;
    strbuf_init(&text);
    strbuf_format(out, "::%s file=", kinds[f->severity]);
    diag_text_plain(&text, f->at.path);
    escape(out, strbuf_view(&text), true);
    strbuf_format(out, ",line=%u,endLine=%u", f->at.line, f->at.end_line);
    // Columns are only for places within one line; GitHub's last column is part of the place.
    if (f->at.end_line == f->at.line)
        strbuf_format(out, ",col=%u,endColumn=%u", f->at.column,
                      f->at.end_column > f->at.column ? f->at.end_column - 1 : f->at.column);
    strbuf_format(out, ",title=glint %s::", diag_info(f->code)->code);
    strbuf_clear(&text);
    diag_text_plain(&text, f->message);
    if (f->help.len) {
        strbuf_char(&text, '\n');
        diag_text_plain(&text, f->help);
    }
    escape(out, strbuf_view(&text), false);
    strbuf_char(out, '\n');
    out->failed = out->failed || text.failed;
    strbuf_finish(&text);
}

// A line of the log that cannot be mistaken for a command, whatever it quotes.
static void plain(struct strbuf *out, const struct report_finding *f) {
    struct strbuf line;
    strbuf_init(&line);
    report_line(&line, f);
    strbuf_cstr(out, "glint: ");
    for (size_t i = 0; i < line.len; i++) {
        strbuf_char(out, line.data[i]);
        if (line.data[i] == '#')
            strbuf_cstr(out, i + 1 < line.len && line.data[i + 1] == '[' ? " " : "");
    }
    strbuf_char(out, '\n');
    out->failed = out->failed || line.failed;
    strbuf_finish(&line);
}

// Says how many findings have no annotation: `beyond` are in the log; others are in no report.
static void last_notice(struct strbuf *out, const struct report *report, uint64_t beyond) {
    uint64_t left_out = 0;
    uint32_t needed = 0;
    for (uint32_t i = 0; i < report->scene_count; i++) {
        const struct report_scene *scene = &report->scenes[i];
        uint32_t own = scene->left_out.count ? report_needed(scene) : 0;
        left_out += scene->left_out.count;
        needed = own > needed ? own : needed;
    }
    if (beyond + left_out == 0)
        return;
    strbuf_format(out, "::notice title=glint::%llu more finding%s without an annotation: ",
                  (unsigned long long)(beyond + left_out), beyond + left_out == 1 ? "" : "s");
    if (left_out)
        strbuf_format(out, "%llu in the log, %llu not listed; --max-messages %u lists all\n",
                      (unsigned long long)beyond, (unsigned long long)left_out, needed);
    else
        strbuf_cstr(out, "the log and the other formats list them\n");
}

void report_github(struct strbuf *out, const struct report *report) {
    struct report_list list;
    uint64_t beyond = 0;
    if (!report_list_all(report, &list))
        out->failed = true;
    for (unsigned severity = DIAG_ERROR; severity <= DIAG_NOTE; severity++) {
        // One notice is reserved for the number of findings left out.
        unsigned room = severity == DIAG_NOTE ? SHOWN_MAX - 1 : SHOWN_MAX;
        if (severity == DIAG_NOTE && !report->notes)
            break;
        for (uint32_t i = 0; i < list.count; i++) {
            const struct report_finding *f = list.items[i].finding;
            if (f->severity != severity)
                continue;
            if (room == 0) {
                plain(out, f);
                beyond++;
                continue;
            }
            annotation(out, f);
            room--;
        }
    }
    last_notice(out, report, beyond);
    free(list.items);
}
