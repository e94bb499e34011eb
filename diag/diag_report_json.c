// glint's own report; docs/schema/check-report.schema.json describes its contents.
#include "core/json_write.h"
#include "diag/diag_report_text.h"

enum {
    FLAT_DEPTH = 5, // a line per finding
};

static const char *const state_names[] = {"passed", "failed", "unreadable", "ignored"};

static void place(struct json_writer *w, const struct report_place *at) {
    json_write_text(w, "file", at->path);
    json_write_integer(w, "line", at->line);
    json_write_integer(w, "column", at->column);
    json_write_integer(w, "end_line", at->end_line);
    json_write_integer(w, "end_column", at->end_column);
}

static void finding(struct json_writer *w, const struct report_finding *f) {
    json_open_object(w, NULL);
    json_write_text(w, "severity", str_from(report_severity(f)));
    json_write_text(w, "code", str_from(diag_info(f->code)->code));
    place(w, &f->at);
    if (f->scene_path.len)
        json_write_text(w, "path", f->scene_path);
    json_write_text(w, "message", f->message);
    if (f->help.len)
        json_write_text(w, "help", f->help);
    if (f->note_count) {
        json_open_list(w, "related");
        for (uint32_t i = 0; i < f->note_count; i++) {
            json_open_object(w, NULL);
            if (f->notes[i].at.path.len)
                place(w, &f->notes[i].at);
            json_write_text(w, "message", f->notes[i].message);
            json_close_object(w);
        }
        json_close_list(w);
    }
    if (f->copies)
        report_copies(w, f);
    if (f->has_fix) {
        json_open_object(w, "fix");
        json_write_boolean(w, "safe", f->fix_is_safe);
        place(w, &f->fix_at);
        json_write_text(w, "text", f->fix_text);
        json_close_object(w);
    }
    json_close_object(w);
}

static void counts(struct json_writer *w, uint64_t errors, uint64_t warnings, uint64_t notes) {
    json_open_object(w, "counts");
    json_write_integer(w, "errors", errors);
    json_write_integer(w, "warnings", warnings);
    json_write_integer(w, "notes", notes);
    json_close_object(w);
}

static void statistics(struct json_writer *w, const struct report_assets *a) {
    json_open_object(w, "statistics");
    for (uint32_t i = 0; i < a->count_count; i++)
        json_write_integer(w, a->counts[i].name, a->counts[i].count);
    json_write_integer(w, "triangles", a->triangles);
    if (a->image_width) {
        json_write_integer(w, "background_width", a->image_width);
        json_write_integer(w, "background_height", a->image_height);
    }
    json_open_list(w, "files");
    for (uint32_t i = 0; i < a->file_count; i++) {
        json_open_object(w, NULL);
        json_write_text(w, "file", a->files[i].path);
        json_write_integer(w, "bytes", a->files[i].size_bytes);
        json_close_object(w);
    }
    json_close_list(w);
    json_close_object(w);
}

// Which findings are not listed, and how to list them.
static void left_out(struct json_writer *w, const struct report_scene *s) {
    json_open_list(w, "left_out_codes");
    for (diag_code code = diag_next(-1); code < DIAG_CODE_COUNT; code = diag_next(code)) {
        if (!s->left_out.of[code])
            continue;
        json_open_object(w, NULL);
        json_write_text(w, "code", str_from(diag_info(code)->code));
        json_write_integer(w, "count", s->left_out.of[code]);
        json_close_object(w);
    }
    json_close_list(w);
    json_write_integer(w, "max_messages", report_needed(s));
}

static void scene(struct json_writer *w, const struct report_scene *s) {
    json_open_object(w, NULL);
    json_write_text(w, "file", s->path);
    json_write_text(w, "state", str_from(state_names[s->state]));
    counts(w, s->errors, s->warnings, s->notes);
    json_write_boolean(w, "truncated", s->left_out.count > 0);
    json_write_integer(w, "left_out", s->left_out.count);
    if (s->left_out.count)
        left_out(w, s);
    if (s->in_baseline)
        json_write_integer(w, "in_baseline", s->in_baseline);
    json_open_list(w, "findings");
    for (uint32_t i = 0; i < s->findings.count; i++)
        finding(w, &s->findings.items[i]);
    json_close_list(w);
    if (s->has_assets)
        statistics(w, &s->assets);
    json_close_object(w);
}

void report_json(struct strbuf *out, const struct report *report) {
    struct json_writer w;
    uint64_t errors = 0;
    uint64_t warnings = 0;
    uint64_t notes = 0;
    bool truncated = false;
    for (uint32_t i = 0; i < report->scene_count; i++) {
        errors += report->scenes[i].errors;
        warnings += report->scenes[i].warnings;
        notes += report->scenes[i].notes;
        truncated = truncated || report->scenes[i].left_out.count > 0;
    }
    json_report_begin(&w, out, FLAT_DEPTH, "glint check", 1);
    json_write_text(&w, "program", str_from(report->program_version));
    counts(&w, errors, warnings, notes);
    json_write_boolean(&w, "truncated", truncated);
    json_open_list(&w, "scenes");
    for (uint32_t i = 0; i < report->scene_count; i++)
        scene(&w, &report->scenes[i]);
    json_close_list(&w);
    json_report_end(&w);
}
