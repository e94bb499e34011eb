// Quick fixes, completions and formatting.
#include "lsp/server_private.h"

#include "core/strbuf.h"
#include "files/files_walk.h"
#include "grammar/ir_walk.h"
#include "parser/format/format.h"

#include <stdlib.h>
#include <string.h>

enum {
    FILES_MOST = 500, // names offered for a path
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

// ---- completion

// The word before the place and the key before that: `material: gl|`, `material="gl|`.
struct typed {
    str key, word;
    size_t begin; // of the word, in the text
};

static bool is_word(char c) {
    return c != ' ' && c != '\t' && c != '\n' && c != '\r' && !strchr("\"'[]{},=:<>", c);
}

static struct typed typed_at(str text, size_t offset) {
    struct typed typed = {0};
    size_t at = offset;
    while (at > 0 && is_word(text.ptr[at - 1]))
        at--;
    typed.begin = at;
    typed.word = str_slice(text, at, offset);
    while (at > 0 && text.ptr[at - 1] != '\n' && strchr(" \t\"'[", text.ptr[at - 1]))
        at--;
    if (at == 0 || (text.ptr[at - 1] != ':' && text.ptr[at - 1] != '='))
        return typed;
    size_t end = at - 1;
    while (end > 0 && (text.ptr[end - 1] == ' ' || text.ptr[end - 1] == '"'))
        end--;
    at = end;
    while (at > 0 && is_word(text.ptr[at - 1]))
        at--;
    typed.key = str_slice(text, at, end);
    return typed;
}

struct completing {
    const struct request *request;
    struct typed typed;
    json_t *range; // of the word
    json_t *known; // labels that were offered
    json_t *items;
};

enum completion_kind { // LSP 3.17, "Completion Request"
    COMPLETION_FILE = 17,
    COMPLETION_REFERENCE = 18,
    COMPLETION_FOLDER = 19,
    COMPLETION_ENUM_MEMBER = 20,
};

static void offer(struct completing *c, str label, enum completion_kind kind, const char *doc) {
    json_t *text = position_string(label);
    if (json_object_get(c->known, json_string_value(text))) {
        json_decref(text);
        return;
    }
    json_object_set_new(c->known, json_string_value(text), json_true());
    json_t *item = json_object();
    json_t *edit = json_object();
    json_object_set(item, "label", text);
    json_object_set_new(item, "kind", json_integer(kind));
    if (doc)
        json_object_set_new(item, "documentation", json_string(doc));
    json_object_set(edit, "range", c->range);
    json_object_set_new(edit, "newText", text);
    json_object_set_new(item, "textEdit", edit);
    json_array_append_new(c->items, item);
}

static void offer_names(struct completing *c, const struct schema_element *target) {
    const struct schema_row *pool = ir_walk_pool(target);
    const struct ir_scene *scene = c->request->session->scene;
    size_t index;
    const json_t *name_before;
    json_array_foreach(json_object_get(c->request->scene->names, target->name), index, name_before)
        offer(c, str_from(json_string_value(name_before)), COMPLETION_REFERENCE, target->doc);
    if (!pool || !scene)
        return;
    struct ir_any_list list = ir_walk_list(pool, scene);
    for (uint32_t i = 0; i < list.count; i++) {
        str name = ir_walk_key(target, ir_walk_item(pool, list, i));
        if (name.len)
            offer(c, name, COMPLETION_REFERENCE, target->doc);
    }
}

// Files and folders where the path typed so far leads, from the document's folder.
static void offer_files(struct completing *c, enum schema_file kind) {
    struct arena *arena = c->request->arena;
    str typed = c->typed.word;
    str base = path_base(typed);
    str stem = str_slice(typed, 0, typed.len - base.len);
    str folder =
        arena_format(arena, "%.*s/%.*s", STR_ARG(path_folder(c->request->document->path)), STR_ARG(stem));
    struct files_names names = {0};
    files_list_folder(arena, folder, &names);
    for (uint32_t i = 0; i < names.count && i < FILES_MOST; i++) {
        str name = names.items[i];
        str path = arena_format(arena, "%.*s%.*s", STR_ARG(folder), STR_ARG(name));
        str label = arena_format(arena, "%.*s%.*s", STR_ARG(stem), STR_ARG(name));
        if (files_is_folder(path))
            offer(c, arena_format(arena, "%.*s/", STR_ARG(label)), COMPLETION_FOLDER, NULL);
        else if (schema_file_fits(kind, name))
            offer(c, label, COMPLETION_FILE, NULL);
    }
}

// The text is seldom complete while the user types: every attribute with the key's name counts.
static void offer_for(struct completing *c, const struct schema_row *row) {
    if (!str_equal_cstr(c->typed.key, row->name) &&
        !(row->plural && str_equal_cstr(c->typed.key, row->plural)))
        return;
    if (row->kind == SCHEMA_REFERENCE)
        offer_names(c, row->child);
    if (row->kind == SCHEMA_WORD)
        for (uint32_t i = 0; row->words[i]; i++)
            offer(c, str_from(row->words[i]), COMPLETION_ENUM_MEMBER,
                  row->word_docs ? row->word_docs[i] : NULL);
    if (row->kind == SCHEMA_BOOLEAN) {
        offer(c, STR("true"), COMPLETION_ENUM_MEMBER, row->doc);
        offer(c, STR("false"), COMPLETION_ENUM_MEMBER, row->doc);
    }
    if (row->kind == SCHEMA_TEXT && row->text == SCHEMA_TEXT_PATH)
        offer_files(c, row->file);
    if (row->kind == SCHEMA_LIST && schema_short_row(row->child) >= 0) {
        const struct schema_row *inner = &row->child->rows[schema_short_row(row->child)];
        if (inner->kind == SCHEMA_TEXT && inner->text == SCHEMA_TEXT_PATH)
            offer_files(c, inner->file);
    }
}

json_t *server_completion(const struct request *request) {
    str text = document_text(request->document);
    struct typed typed = typed_at(text, request->offset);
    struct completing completing = {.request = request,
                                    .typed = typed,
                                    .range = position_range_once(text, request->server->encoding, typed.begin,
                                                                 typed.begin + typed.word.len),
                                    .known = json_object(),
                                    .items = json_array()};
    for (uint32_t e = 0; typed.key.len && schema_elements[e]; e++)
        for (uint32_t i = 0; i < schema_elements[e]->row_count; i++)
            offer_for(&completing, &schema_elements[e]->rows[i]);
    json_decref(completing.range);
    json_decref(completing.known);
    json_t *list = json_object();
    json_object_set_new(list, "isIncomplete", json_false());
    json_object_set_new(list, "items", completing.items);
    return list;
}

// ---- formatting

// The text as a whole: what the layout does not change stays, so that the editor's own diff is small.
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
