// Quick fixes and formatting.
#include "lsp/server_private.h"

#include "core/strbuf.h"
#include "parser/format/format.h"

#include <stdlib.h>
#include <string.h>

enum {
    TITLE_BYTES = 60,
};

static json_t *edit_of(const struct request *request, const struct diag *diag) {
    json_t *edit = json_object();
    json_object_set_new(edit, "range", server_range(request->server, request->session, diag->fix_at));
    json_object_set_new(edit, "newText", position_string(diag->fix_text));
    return edit;
}

static json_t *workspace_edit(const char *uri, json_t *edits) {
    json_t *edit = json_object();
    json_t *changes = json_object();
    json_object_set_new(changes, uri, edits);
    json_object_set_new(edit, "changes", changes);
    return edit;
}

static str title_of(struct arena *arena, const struct session *session, const struct diag *diag) {
    str old = source_text(&session->sources, diag->fix_at);
    str text = str_trim(diag->fix_text);
    if (text.len == 0)
        return arena_format(arena, "Remove '%.*s'", STR_ARG(position_clip(str_trim(old), TITLE_BYTES)));
    if (text.len > TITLE_BYTES || memchr(text.ptr, '\n', text.len))
        return arena_format(arena, "Fix: %s", diag_info(diag->code)->title);
    if (str_trim(old).len == 0)
        return arena_format(arena, "Insert '%.*s'", STR_ARG(text));
    return arena_format(arena, "Replace with '%.*s'", STR_ARG(text));
}

static bool overlaps(span a, size_t begin, size_t end) {
    return a.begin <= end && begin <= a.end;
}

static void add_fix(const struct request *request, const struct diag *diag, json_t *list) {
    str title = title_of(request->arena, request->session, diag);
    json_t *action = json_object();
    json_t *edits = json_array();
    json_t *diagnostics = json_array();
    json_array_append_new(edits, edit_of(request, diag));
    json_array_append_new(diagnostics,
                          server_diagnostic(request->server, request->session, request->arena, diag));
    json_object_set_new(action, "title", position_string(title));
    json_object_set_new(action, "kind", json_string("quickfix"));
    json_object_set_new(action, "isPreferred", json_boolean(diag->fix_is_safe));
    json_object_set_new(action, "diagnostics", diagnostics);
    json_object_set_new(action, "edit", workspace_edit(request->document->uri, edits));
    json_array_append_new(list, action);
}

// All safe fixes, in one.
static void add_fix_all(const struct request *request, uint32_t source, json_t *list) {
    const struct session *session = request->session;
    json_t *edits = json_array();
    uint32_t end = 0;
    for (uint32_t i = 0; i < session->sink.count; i++) {
        const struct diag *diag = &session->sink.items[i];
        if (!diag->has_fix || !diag->fix_is_safe || diag->fix_at.source != source || diag->fix_at.begin < end)
            continue;
        json_array_append_new(edits, edit_of(request, diag));
        end = diag->fix_at.end;
    }
    if (json_array_size(edits) == 0) {
        json_decref(edits);
        return;
    }
    json_t *action = json_object();
    json_object_set_new(action, "title", json_string("Make all fixes that are certain"));
    json_object_set_new(action, "kind", json_string("source.fixAll.glint"));
    json_object_set_new(action, "edit", workspace_edit(request->document->uri, edits));
    json_array_append_new(list, action);
}

// Whether the client wants actions of this kind; `source` wants `source.fixAll.glint` too.
static bool wants(const json_t *context, const char *kind) {
    const json_t *only = json_object_get(context, "only");
    size_t index;
    json_t *item;
    if (!json_is_array(only))
        return true;
    json_array_foreach(only, index, item) {
        const char *wanted = json_string_value(item);
        size_t length = wanted ? strlen(wanted) : 0;
        if (wanted && strncmp(kind, wanted, length) == 0 && (kind[length] == '\0' || kind[length] == '.'))
            return true;
    }
    return false;
}

json_t *server_code_actions(const struct request *request) {
    json_t *list = json_array();
    const json_t *context = json_object_get(request->params, "context");
    const json_t *range = json_object_get(request->params, "range");
    enum position_encoding encoding = request->server->encoding;
    const struct session *session = request->session;
    uint32_t source = locate_source(request->session, request->document->path);
    str text = document_text(request->document);
    size_t begin = position_read(text, encoding, json_object_get(range, "start"), NULL);
    size_t end = position_read(text, encoding, json_object_get(range, "end"), NULL);
    for (uint32_t i = 0; wants(context, "quickfix") && i < session->sink.count; i++) {
        const struct diag *diag = &session->sink.items[i];
        if (diag->has_fix && diag->fix_at.source == source && diag->at.source == source &&
            (overlaps(diag->at, begin, end) || overlaps(diag->fix_at, begin, end)))
            add_fix(request, diag, list);
    }
    if (wants(context, "source.fixAll.glint"))
        add_fix_all(request, source, list);
    return list;
}

// ---- formatting

// Replaces the whole text; what the layout does not change stays the same, so the editor's own diff is small.
json_t *server_formatting(const struct request *request) {
    struct server *server = request->server;
    struct arena *arena = request->arena;
    struct source_set sources;
    struct diag_sink sink;
    struct strbuf text;
    source_set_init(&sources, arena);
    diag_sink_init(&sink);
    strbuf_init(&text);
    str old = arena_copy(arena, document_text(request->document));
    struct reader_context context = {
        .sources = &sources, .sink = &sink, .limits = &server->scenes.settings.limits, .arena = arena};
    uint32_t source = source_add(&sources, SOURCE_KIND_OVERLAY, request->document->path, old);
    enum format_status status = format_source(&context, source, NULL, &text);
    json_t *edits = NULL;
    if (status == FORMAT_DONE && !text.failed) {
        edits = json_array();
        if (!str_equal(strbuf_view(&text), old)) {
            json_t *edit = json_object();
            json_object_set_new(edit, "range", position_range_once(old, server->encoding, 0, old.len));
            json_object_set_new(edit, "newText", position_string(strbuf_view(&text)));
            json_array_append_new(edits, edit);
        }
    }
    strbuf_finish(&text);
    diag_sink_finish(&sink);
    return edits;
}
