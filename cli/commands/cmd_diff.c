// glint diff A B: what differs in meaning between two scenes, with both places.
#include "cli/commands/commands.h"
#include "core/json_write.h"
#include "diag/codes/limit.h"
#include "grammar/print/ir_diff.h"

static const char *const formats[] = {"text", "json", NULL};
static const char *const kinds[] = {
    [IR_CHANGED] = "changed", [IR_ADDED] = "added",     [IR_REMOVED] = "removed",
    [IR_MOVED] = "moved",     [IR_RENAMED] = "renamed",
};

struct comparison {
    struct cli *cli;
    struct session sessions[2];
    struct arena arena;
    struct ir_changes changes;
};

// The file that a path names, links followed.
static str file_of(void *context, struct arena *arena, span at, str path) {
    struct session *session = context;
    str found;
    if (at.source == SOURCE_DEFAULT ||
        files_resolve(&session->files, session->sources.items[at.source].path, path, &found) != FILE_OK)
        return path;
    return arena_copy(arena, files_canonical(&session->files, found));
}

static struct ir_diff_side side(struct session *session) {
    return (struct ir_diff_side){session->scene, &session->origin, file_of, session};
}

static void compare(void *context) {
    struct comparison *c = context;
    struct ir_diff_side before = side(&c->sessions[0]), after = side(&c->sessions[1]);
    ir_diff(&before, &after, &c->arena, &c->changes);
}

static bool compare_guarded(struct comparison *c) {
    struct arena *arenas[] = {&c->arena, &c->sessions[0].arena, &c->sessions[1].arena, NULL};
    return arena_guarded_all(arenas, compare, c) == ARENA_FAULT_NONE;
}

// ---- text

static void put_place(struct strbuf *out, struct session *session, span at) {
    if (span_is_none(at))
        return;
    struct source_place place = source_locate(&session->sources, at);
    strbuf_format(out, "    %.*s:%u:%u\n", STR_ARG(place.path), place.line, place.column);
}

static void put_value(struct strbuf *out, str value, bool is_default) {
    strbuf_str(out, value);
    if (is_default)
        strbuf_cstr(out, " (default)");
}

static void put_change(struct comparison *c, const struct ir_change *change, struct strbuf *out) {
    bool both = change->path_before.len && change->path_after.len;
    bool renumbered = both && !str_equal(change->path_before, change->path_after);
    strbuf_format(out, "%s %.*s", kinds[change->kind],
                  STR_ARG(change->path_before.len ? change->path_before : change->path_after));
    if (renumbered)
        strbuf_format(out, " -> %.*s", STR_ARG(change->path_after));
    if (change->value_before.len || change->value_after.len)
        strbuf_cstr(out, ": ");
    put_value(out, change->value_before, change->default_before);
    if (change->value_before.len && change->value_after.len)
        strbuf_cstr(out, " -> ");
    put_value(out, change->value_after, change->default_after);
    strbuf_char(out, '\n');
    put_place(out, &c->sessions[0], change->before);
    put_place(out, &c->sessions[1], change->after);
}

static void make_text(struct comparison *c, struct strbuf *out) {
    for (uint32_t i = 0; i < c->changes.count; i++)
        put_change(c, &c->changes.items[i], out);
    if (c->changes.count)
        strbuf_format(out, "%u %s\n", c->changes.count, c->changes.count == 1 ? "difference" : "differences");
}

// ---- JSON

static void half(struct json_writer *w, const char *key, struct session *session, str path, str value,
                 bool is_default, span at) {
    if (path.len == 0) {
        json_write_null(w, key);
        return;
    }
    json_open_object(w, key);
    json_write_text(w, "path", path);
    if (value.len)
        json_write_text(w, "value", value);
    if (is_default)
        json_write_boolean(w, "default", true);
    if (!span_is_none(at)) {
        struct source_place place = source_locate(&session->sources, at);
        json_write_text(w, "file", place.path);
        json_write_integer(w, "line", place.line);
        json_write_integer(w, "column", place.column);
    }
    json_close_object(w);
}

static void make_json(struct comparison *c, struct strbuf *out) {
    struct json_writer w;
    json_report_begin(&w, out, JSON_WRITE_DEPTH_MAX, "glint diff", 1);
    json_open_list(&w, "differences");
    for (uint32_t i = 0; i < c->changes.count; i++) {
        const struct ir_change *change = &c->changes.items[i];
        json_open_object(&w, NULL);
        json_write_text(&w, "kind", str_from(kinds[change->kind]));
        half(&w, "before", &c->sessions[0], change->path_before, change->value_before, change->default_before,
             change->before);
        half(&w, "after", &c->sessions[1], change->path_after, change->value_after, change->default_after,
             change->after);
        json_close_object(&w);
    }
    json_close_list(&w);
    json_report_end(&w);
}

// ---- the command

static int load(struct comparison *c, int i) {
    struct session_options options = cli_session_options(c->cli, c->cli->operands[i]);
    options.text_only = true;
    session_load(&c->sessions[i], &options, NULL);
    return cli_report(c->cli, &c->sessions[i], false);
}

static int report(struct comparison *c, bool json) {
    struct strbuf out;
    strbuf_init(&out);
    (json ? make_json : make_text)(c, &out);
    int status = c->changes.count ? CLI_SCENE : CLI_OK;
    if (out.failed) {
        cli_error(c->cli, DIAG_OUT_OF_MEMORY, c->cli->operands[0], NULL, "not enough memory for the report");
        status = CLI_FILE;
    } else if (out.len && cli_print(c->cli, strbuf_view(&out)) != CLI_OK) {
        status = CLI_FILE;
    }
    strbuf_finish(&out);
    return status;
}

int cmd_diff(struct cli *cli) {
    struct comparison c = {.cli = cli};
    int format = 0;
    if (!cli_format(cli, formats, &format))
        return CLI_USAGE;
    arena_init(&c.arena, limits_size(&cli->options.limits, LIMIT_SCENE_MEMORY));
    int first = load(&c, 0), second = load(&c, 1);
    int status = first > second ? first : second;
    if (status == CLI_OK && compare_guarded(&c)) {
        status = report(&c, format == 1);
    } else if (status == CLI_OK) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, cli->operands[0], NULL, "not enough memory to compare the scenes");
        status = CLI_FILE;
    }
    session_finish(&c.sessions[0]);
    session_finish(&c.sessions[1]);
    arena_finish(&c.arena);
    return status;
}
