#include "edit/convert.h"
#include "diag/codes/command.h"
#include "diag/codes/limit.h"

#include "grammar/print/ir_print.h"
#include "grammar/schema.h"
#include "parser/parser.h"

bool convert_spelling_of(str path, enum convert_spelling *spelling) {
    *spelling = str_ends_with_nocase(path, ".xml")    ? CONVERT_XML
                : str_ends_with_nocase(path, ".json") ? CONVERT_JSON
                                                      : CONVERT_YAML;
    return schema_file_fits(SCHEMA_FILE_SCENE, path);
}

// What was written, read again.
struct second_reading {
    struct arena arena;
    struct source_set sources;
    struct files files;
    struct diag_sink sink;
    struct parser_output output;
    struct parser_input input;
    enum convert_spelling spelling;
    str text;
    bool found;
};

static void read_again(void *context) {
    struct second_reading *r = context;
    str name = r->spelling == CONVERT_XML ? STR("converted.xml") : STR("converted.yaml");
    source_set_init(&r->sources, &r->arena);
    files_init(&r->files, &r->arena);
    uint32_t source = source_add(&r->sources, SOURCE_KIND_OVERLAY, name, r->text);
    r->found = parser_load_file(&r->input, source, &r->output);
}

// The first line where the canonical dumps differ, for a bug report.
static str first_difference(str wanted, str got) {
    size_t line = 0, at = 0;
    for (; at < wanted.len && at < got.len && wanted.ptr[at] == got.ptr[at]; at++)
        line = wanted.ptr[at] == '\n' ? at + 1 : line;
    str from = line < wanted.len ? wanted : got;
    size_t end = line;
    while (end < from.len && from.ptr[end] != '\n')
        end++;
    return str_trim(str_slice(from, line, end));
}

static enum convert_status refuse(struct session *session, const char *why, str what) {
    span at = {session->origin.files.items[0].source, 0, 0};
    diag_add(&session->sink, DIAG_FORMAT_UNSAFE, at,
             "converted, the scene would have another meaning; nothing was written");
    diag_note(&session->sink, SPAN_NONE, "%s%.*s", why, STR_ARG(what));
    return CONVERT_UNSAFE;
}

static enum convert_status compare(struct session *session, const struct second_reading *again) {
    struct strbuf wanted, got;
    enum convert_status status = CONVERT_DONE;
    strbuf_init(&wanted);
    strbuf_init(&got);
    ir_dump(session->scene, &wanted);
    ir_dump(again->output.scene, &got);
    if (wanted.failed || got.failed)
        status = CONVERT_NO_MEMORY;
    else if (!str_equal(strbuf_view(&wanted), strbuf_view(&got)))
        status = refuse(session, "the first line that differs: ",
                        first_difference(strbuf_view(&wanted), strbuf_view(&got)));
    strbuf_finish(&wanted);
    strbuf_finish(&got);
    return status;
}

static const struct diag *first_error(const struct diag_sink *sink) {
    for (uint32_t i = 0; i < sink->count; i++)
        if (sink->items[i].severity == DIAG_ERROR)
            return &sink->items[i];
    return NULL;
}

enum convert_status convert_check(struct session *session, enum convert_spelling spelling, str text) {
    struct second_reading again = {.spelling = spelling, .text = text};
    enum convert_status status;
    again.input = (struct parser_input){.sources = &again.sources,
                                        .files = &again.files,
                                        .sink = &again.sink,
                                        .limits = &session->options.limits,
                                        .arena = &again.arena};
    diag_sink_init(&again.sink);
    arena_init(&again.arena, limits_size(&session->options.limits, LIMIT_SCENE_MEMORY));
    enum arena_fault fault = arena_guarded(&again.arena, read_again, &again);
    const struct diag *error = first_error(&again.sink);
    if (fault || (error && error->code == DIAG_OUT_OF_MEMORY))
        status = CONVERT_NO_MEMORY;
    else if (error || !again.found)
        status = refuse(session, "read again: ", error ? error->message : STR("there is no scene"));
    else
        status = compare(session, &again);
    diag_sink_finish(&again.sink);
    arena_finish(&again.arena);
    return status;
}

static void write_as(const struct session *session, enum convert_spelling spelling, struct strbuf *out) {
    struct ir_write_options options = {0};
    if (spelling == CONVERT_XML)
        ir_write_xml(session->scene, &session->origin, &session->sources, options, out);
    else if (spelling == CONVERT_JSON)
        ir_write_json(session->scene, out);
    else
        ir_write_yaml(session->scene, &session->origin, &session->sources, options, out);
}

enum convert_status convert_write(struct session *session, enum convert_spelling spelling,
                                  struct strbuf *out) {
    size_t before = out->len;
    write_as(session, spelling, out);
    if (out->failed)
        return CONVERT_NO_MEMORY;
    str text = str_slice(strbuf_view(out), before, out->len);
    enum convert_status status = convert_check(session, spelling, text);
    if (status != CONVERT_DONE)
        out->len = before;
    return status;
}
