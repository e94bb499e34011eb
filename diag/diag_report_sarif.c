// SARIF 2.1.0, as GitHub's code scanning accepts it.
#include "core/json_write.h"
#include "diag/diag_report_text.h"
#include "diag/diag_text.h"

#include <stdlib.h>
#include <string.h>

enum {
    RULE_DEPTH = 7,   // a line per rule
    RESULT_DEPTH = 5, // a line per result
};

static bool is_plain(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           (c != '\0' && strchr("-._~/", c));
}

// A path as a URI reference; absolute paths become file URIs.
static void put_uri(struct strbuf *out, str path) {
    if (path.len && path.ptr[0] == '/')
        strbuf_cstr(out, "file://");
    for (size_t i = 0; i < path.len; i++) {
        if (is_plain(path.ptr[i]))
            strbuf_char(out, path.ptr[i]);
        else
            strbuf_format(out, "%%%02X", (unsigned char)path.ptr[i]);
    }
}

static void artifact(struct json_writer *w, str path) {
    struct strbuf uri;
    strbuf_init(&uri);
    put_uri(&uri, path);
    json_open_object(w, "artifactLocation");
    json_write_text(w, "uri", strbuf_view(&uri));
    if (path.len && path.ptr[0] != '/')
        json_write_text(w, "uriBaseId", STR("%SRCROOT%"));
    json_close_object(w);
    w->out->failed = w->out->failed || uri.failed;
    strbuf_finish(&uri);
}

static void region(struct json_writer *w, const char *key, const struct report_place *at) {
    json_open_object(w, key);
    json_write_integer(w, "startLine", at->line);
    json_write_integer(w, "startColumn", at->column);
    json_write_integer(w, "endLine", at->end_line);
    json_write_integer(w, "endColumn", at->end_column);
    json_close_object(w);
}

static void physical(struct json_writer *w, const struct report_place *at) {
    json_open_object(w, "physicalLocation");
    artifact(w, at->path);
    region(w, "region", at);
    json_close_object(w);
}

static void text_object(struct json_writer *w, const char *key, str text) {
    json_open_object(w, key);
    json_write_text(w, "text", text);
    json_close_object(w);
}

static void put_sentence(struct strbuf *out, str text) {
    strbuf_str(out, text);
    if (text.len == 0 || !strchr(".?!", text.ptr[text.len - 1]))
        strbuf_char(out, '.');
}

// The message ends in a full stop; its help follows as a line of its own.
static void message(struct json_writer *w, const struct report_finding *f) {
    struct strbuf text;
    strbuf_init(&text);
    put_sentence(&text, f->message);
    if (f->help.len) {
        strbuf_cstr(&text, "\nHelp: ");
        put_sentence(&text, f->help);
    }
    text_object(w, "message", strbuf_view(&text));
    w->out->failed = w->out->failed || text.failed;
    strbuf_finish(&text);
}

static void related(struct json_writer *w, const struct report_finding *f) {
    bool any = false;
    for (uint32_t i = 0; i < f->note_count; i++)
        any = any || f->notes[i].at.path.len;
    if (!any)
        return;
    json_open_list(w, "relatedLocations");
    for (uint32_t i = 0; i < f->note_count; i++) {
        if (!f->notes[i].at.path.len)
            continue;
        json_open_object(w, NULL);
        json_write_integer(w, "id", i + 1);
        physical(w, &f->notes[i].at);
        text_object(w, "message", f->notes[i].message);
        json_close_object(w);
    }
    json_close_list(w);
}

static void fix(struct json_writer *w, const struct report_finding *f) {
    if (!f->has_fix)
        return;
    json_open_list(w, "fixes");
    json_open_object(w, NULL);
    text_object(w, "description",
                f->fix_is_safe ? STR("The only possible meaning.") : STR("A suggestion: check the meaning."));
    json_open_list(w, "artifactChanges");
    json_open_object(w, NULL);
    artifact(w, f->fix_at.path);
    json_open_list(w, "replacements");
    json_open_object(w, NULL);
    region(w, "deletedRegion", &f->fix_at);
    text_object(w, "insertedContent", f->fix_text);
    json_close_object(w);
    json_close_list(w);
    json_close_object(w);
    json_close_list(w);
    json_close_object(w);
    json_close_list(w);
}

static void fingerprint(struct json_writer *w, const struct report_item *item) {
    struct strbuf text;
    strbuf_init(&text);
    strbuf_format(&text, "%016llx:%u", (unsigned long long)item->fingerprint, item->occurrence);
    json_open_object(w, "partialFingerprints");
    json_write_text(w, "primaryLocationLineHash", strbuf_view(&text));
    json_close_object(w);
    strbuf_finish(&text);
}

static void result(struct json_writer *w, const struct report_item *item, uint32_t rule_index) {
    const struct report_finding *f = item->finding;
    json_open_object(w, NULL);
    json_write_text(w, "ruleId", str_from(diag_info(f->code)->code));
    json_write_integer(w, "ruleIndex", rule_index);
    json_write_text(w, "level", str_from(report_severity(f)));
    message(w, f);
    json_open_list(w, "locations");
    json_open_object(w, NULL);
    physical(w, &f->at);
    if (f->scene_path.len) {
        json_open_list(w, "logicalLocations");
        json_open_object(w, NULL);
        json_write_text(w, "fullyQualifiedName", f->scene_path);
        json_close_object(w);
        json_close_list(w);
    }
    json_close_object(w);
    json_close_list(w);
    related(w, f);
    fix(w, f);
    fingerprint(w, item);
    if (f->copies) {
        json_open_object(w, "properties");
        report_copies(w, f);
        json_close_object(w);
    }
    json_close_object(w);
}

// "OUT_OF_RANGE" as "OutOfRange".
static void put_rule_name(struct strbuf *out, const char *name) {
    bool begins = true;
    for (; *name; name++) {
        char lower = char_lower(*name);
        if (*name != '_')
            strbuf_char(out, begins ? *name : lower);
        begins = *name == '_';
    }
}

// Where the codes are explained, for those who read the report elsewhere.
static void help_address(struct json_writer *w, const char *home, const char *code) {
    struct strbuf text;
    if (!home || !home[0])
        return;
    strbuf_init(&text);
    strbuf_format(&text, "%s/docs/codes.md#", home);
    for (; *code; code++)
        strbuf_char(&text, char_lower(*code));
    json_write_text(w, "helpUri", strbuf_view(&text));
    w->out->failed = w->out->failed || text.failed;
    strbuf_finish(&text);
}

static void rule(struct json_writer *w, diag_code code, const char *home) {
    const struct diag_info *info = diag_info(code);
    static const char *const problems[] = {"error", "warning", "recommendation"};
    struct strbuf text;
    strbuf_init(&text);
    put_rule_name(&text, info->name);
    json_open_object(w, NULL);
    json_write_text(w, "id", str_from(info->code));
    json_write_text(w, "name", strbuf_view(&text));
    strbuf_clear(&text);
    put_sentence(&text, str_from(info->title));
    if (text.len && text.data[0] >= 'a' && text.data[0] <= 'z')
        text.data[0] = (char)(text.data[0] - 'a' + 'A');
    text_object(w, "shortDescription", strbuf_view(&text));
    text_object(w, "fullDescription", str_from(info->meaning));
    strbuf_clear(&text);
    strbuf_format(&text, "%s\n\n%s", info->meaning, info->remedy);
    json_open_object(w, "help");
    json_write_text(w, "text", strbuf_view(&text));
    json_write_text(w, "markdown", strbuf_view(&text));
    json_close_object(w);
    help_address(w, home, info->code);
    json_open_object(w, "defaultConfiguration");
    json_write_text(w, "level", str_from(diag_severity_name(info->severity)));
    json_close_object(w);
    json_open_object(w, "properties");
    json_open_list(w, "tags");
    json_write_text(w, NULL, str_from(diag_stage(code)));
    json_close_list(w);
    json_write_text(w, "precision", STR("very-high"));
    json_write_text(w, "problem.severity", str_from(problems[info->severity]));
    json_close_object(w);
    json_close_object(w);
    w->out->failed = w->out->failed || text.failed;
    strbuf_finish(&text);
}

// Describes the codes that occur; sets the index of each.
static void tool(struct json_writer *w, const struct report *report, const struct report_list *list,
                 uint32_t index[DIAG_CODE_COUNT]) {
    bool used[DIAG_CODE_COUNT] = {false};
    uint32_t count = 0;
    for (uint32_t i = 0; i < list->count; i++)
        used[list->items[i].finding->code] = true;
    w->flat_depth = RULE_DEPTH;
    json_open_object(w, "tool");
    json_open_object(w, "driver");
    json_write_text(w, "name", STR("glint"));
    json_write_text(w, "version", str_from(report->program_version));
    json_write_text(w, "semanticVersion", str_from(report->program_version));
    if (report->home && report->home[0])
        json_write_text(w, "informationUri", str_from(report->home));
    json_open_list(w, "rules");
    for (diag_code i = diag_next(-1); i < DIAG_CODE_COUNT; i = diag_next(i)) {
        if (!used[i])
            continue;
        index[i] = count++;
        rule(w, i, report->home);
    }
    json_close_list(w);
    json_close_object(w);
    json_close_object(w);
    w->flat_depth = RESULT_DEPTH;
}

static bool is_complete(const struct report *report) {
    for (uint32_t i = 0; i < report->scene_count; i++)
        if (report->scenes[i].left_out.count)
            return false;
    return true;
}

// Says what the results lack.
static void invocation(struct json_writer *w, const struct report *report) {
    if (is_complete(report))
        return;
    json_open_list(w, "invocations");
    json_open_object(w, NULL);
    json_write_boolean(w, "executionSuccessful", true);
    json_open_list(w, "toolExecutionNotifications");
    for (uint32_t i = 0; i < report->scene_count; i++) {
        const struct report_scene *scene = &report->scenes[i];
        struct strbuf text;
        if (!scene->left_out.count)
            continue;
        strbuf_init(&text);
        report_left_out(&text, scene);
        json_open_object(w, NULL);
        json_write_text(w, "level", STR("warning"));
        text_object(w, "message", str_trim(strbuf_view(&text)));
        json_close_object(w);
        w->out->failed = w->out->failed || text.failed;
        strbuf_finish(&text);
    }
    json_close_list(w);
    json_close_object(w);
    json_close_list(w);
}

void report_sarif(struct strbuf *out, const struct report *report) {
    uint32_t index[DIAG_CODE_COUNT] = {0};
    struct report_list list;
    struct json_writer w;
    if (!report_list_all(report, &list))
        out->failed = true;
    json_writer_init(&w, out, RESULT_DEPTH);
    json_open_object(&w, NULL);
    json_write_text(&w, "$schema", STR("https://json.schemastore.org/sarif-2.1.0.json"));
    json_write_text(&w, "version", STR("2.1.0"));
    json_open_list(&w, "runs");
    json_open_object(&w, NULL);
    tool(&w, report, &list, index);
    json_open_object(&w, "originalUriBaseIds");
    json_open_object(&w, "%SRCROOT%");
    text_object(&w, "description", STR("The folder in which glint was run."));
    json_close_object(&w);
    json_close_object(&w);
    invocation(&w, report);
    json_write_text(&w, "columnKind", STR("unicodeCodePoints"));
    json_open_list(&w, "results");
    for (uint32_t i = 0; i < list.count; i++)
        result(&w, &list.items[i], index[list.items[i].finding->code]);
    json_close_list(&w);
    json_close_object(&w);
    json_close_list(&w);
    json_close_object(&w);
    json_end(&w);
    free(list.items);
}
