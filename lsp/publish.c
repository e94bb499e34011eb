// Diagnostics of the scenes, as the client gets them.
#include "core/heap.h"
#include "lsp/server_private.h"

#include "core/strbuf.h"

#include <stdlib.h>
#include <string.h>

enum {
    DIAGNOSTICS_MOST = 1000, // per file: editors get slow with more
};

static int severity(enum diag_severity severity) {
    return severity == DIAG_ERROR ? 1 : severity == DIAG_WARNING ? 2 : 3;
}

static bool has_file(const struct session *session, span at) {
    if (at.source == SOURCE_DEFAULT || at.source >= session->sources.count)
        return false;
    enum source_kind kind = session->sources.items[at.source].kind;
    return kind == SOURCE_KIND_FILE || kind == SOURCE_KIND_OVERLAY;
}

// The text that positions in a source refer to.
static str server_text(const struct session *session, uint32_t source) {
    return session->sources.items[source].text;
}

json_t *server_range(struct server *server, const struct session *session, span at) {
    position_index_use(&server->index, server_text(session, at.source), server->encoding);
    return position_range(&server->index, at.begin, at.end);
}

void server_forget(struct server *server) {
    position_index_forget(&server->index);
    free(server->uri.text);
    server->uri.text = NULL;
}

static str uri_of(struct session *session, struct arena *arena, uint32_t source) {
    return position_uri(arena, files_canonical(&session->files, session->sources.items[source].path));
}

// The URI under which the client has opened the file, if it has; valid until the next call. Findings come
// file by file, so the last URI is kept: asking the system for a path is the most expensive step here.
static const char *client_uri(struct server *server, struct session *session, struct arena *arena,
                              uint32_t source) {
    if (server->uri.text && server->uri.session == session && server->uri.source == source)
        return server->uri.text;
    str path = files_canonical(&session->files, session->sources.items[source].path);
    const struct document *document = documents_find_path(&server->documents, path);
    char *text = heap_text(document ? document->uri : uri_of(session, arena, source).ptr);
    if (!text)
        return "";
    free(server->uri.text);
    server->uri.text = text;
    server->uri.session = session;
    server->uri.source = source;
    return text;
}

json_t *server_location(struct server *server, struct session *session, struct arena *arena, span at) {
    if (!has_file(session, at))
        return NULL;
    json_t *location = json_object();
    json_object_set_new(location, "uri", json_string(client_uri(server, session, arena, at.source)));
    json_object_set_new(location, "range", server_range(server, session, at));
    return location;
}

static json_t *related(struct server *server, struct session *session, struct arena *arena,
                       const struct diag *diag) {
    json_t *list = json_array();
    for (const struct diag_related *note = diag->notes; note; note = note->next) {
        json_t *location = server_location(server, session, arena, note->at);
        if (!location)
            continue;
        json_t *item = json_object();
        json_object_set_new(item, "location", location);
        json_object_set_new(item, "message", position_string(note->message));
        json_array_append_new(list, item);
    }
    return list;
}

static json_t *message_text(const struct diag *diag) {
    struct strbuf text;
    strbuf_init(&text);
    strbuf_str(&text, diag->message);
    for (const struct diag_related *note = diag->notes; note; note = note->next)
        if (span_is_none(note->at))
            strbuf_format(&text, "\n%.*s", STR_ARG(note->message));
    if (diag->help.len)
        strbuf_format(&text, "\n%.*s", STR_ARG(diag->help));
    json_t *json = position_string(strbuf_view(&text));
    strbuf_finish(&text);
    return json;
}

json_t *server_diagnostic(struct server *server, struct session *session, struct arena *arena,
                          const struct diag *diag) {
    json_t *object = json_object();
    const struct diag_info *info = diag_info(diag->code);
    span at = has_file(session, diag->at) ? diag->at : SPAN_NONE;
    json_object_set_new(object, "range", server_range(server, session, at));
    json_object_set_new(object, "severity", json_integer(severity(diag->severity)));
    json_object_set_new(object, "code", json_string(info->code));
    json_object_set_new(object, "source", json_string("glint"));
    json_object_set_new(object, "message", message_text(diag));
    json_object_set_new(object, "relatedInformation", related(server, session, arena, diag));
    return object;
}

static json_t *list_of(json_t *all, const char *uri) {
    json_t *list = json_object_get(all, uri);
    if (!list) {
        list = json_array();
        json_object_set_new(all, uri, list);
    }
    return list;
}

// A file of two scenes gets the findings of both, each once. `seen`: those added so far.
static void append_once(json_t *list, const char *uri, json_t *diagnostic, json_t *seen) {
    struct strbuf key;
    char *text = json_dumps(diagnostic, JSON_COMPACT);
    strbuf_init(&key);
    strbuf_format(&key, "%s\n%s", uri, text ? text : "");
    if (key.failed || !json_object_get(seen, key.data)) {
        json_object_set_new(seen, key.failed ? "" : key.data, json_true());
        json_array_append(list, diagnostic);
    }
    json_decref(diagnostic);
    strbuf_finish(&key);
    free(text);
}

struct collecting {
    struct server *server;
    struct lsp_scene *scene;
    struct arena arena;
    json_t *all, *seen;
};

static void collect(void *context) {
    struct collecting *c = context;
    struct server *server = c->server;
    struct lsp_scene *scene = c->scene;
    struct arena *arena = &c->arena;
    json_t *all = c->all;
    struct session *session = &scene->session;
    str main_uri = position_uri(arena, scene->path);
    const struct document *main_document = documents_find_path(&server->documents, scene->path);
    const char *main = main_document ? main_document->uri : main_uri.ptr;
    list_of(all, main);
    // For open documents without findings an empty list is sent.
    for (uint32_t i = 0; i < scene->file_count; i++) {
        const struct document *document = documents_find_path(&server->documents, scene->files[i]);
        if (document)
            list_of(all, document->uri);
    }
    for (uint32_t i = 0; i < session->sink.count; i++) {
        const struct diag *diag = &session->sink.items[i];
        const char *uri =
            has_file(session, diag->at) ? client_uri(server, session, arena, diag->at.source) : main;
        json_t *list = list_of(all, uri);
        if (json_array_size(list) >= DIAGNOSTICS_MOST)
            continue;
        json_t *diagnostic = server_diagnostic(server, session, arena, diag);
        uri = has_file(session, diag->at) ? client_uri(server, session, arena, diag->at.source) : main;
        append_once(list, uri, diagnostic, c->seen);
    }
}

static void tell(struct server *server, const char *uri, json_t *list) {
    json_t *params = json_object();
    const struct document *document = documents_find(&server->documents, uri);
    json_object_set_new(params, "uri", json_string(uri));
    if (document)
        json_object_set_new(params, "version", json_integer(document->version));
    json_object_set(params, "diagnostics", list);
    rpc_notify(&server->rpc, "textDocument/publishDiagnostics", params);
}

static void collect_guarded(struct server *server, struct lsp_scene *scene, json_t *all, json_t *seen) {
    struct collecting collecting = {.server = server, .scene = scene, .all = all, .seen = seen};
    struct arena *arenas[] = {&collecting.arena, &scene->session.arena, NULL};
    struct arena *paths = scene->session.files.arena;
    arena_init(&collecting.arena, SIZE_MAX / 2);
    scene->session.files.arena = &collecting.arena;
    arena_guarded_all(arenas, collect, &collecting);
    scene->session.files.arena = paths;
    arena_finish(&collecting.arena);
}

// Sends the diagnostics of all scenes to the client if they have changed (lsp/publish.c).
static void server_publish(struct server *server) {
    json_t *all = json_object();
    json_t *seen = json_object();
    for (uint32_t i = 0; i < server->scenes.count; i++)
        collect_guarded(server, server->scenes.items[i], all, seen);
    json_decref(seen);
    const char *uri;
    json_t *list;
    json_object_foreach(all, uri, list) {
        // For open documents it is sent in any case: their new version waits for an answer.
        if (documents_find(&server->documents, uri) ||
            !json_equal(list, json_object_get(server->published, uri)))
            tell(server, uri, list);
    }
    json_t *none = json_array();
    json_object_foreach(server->published, uri, list) {
        if (!json_object_get(all, uri))
            tell(server, uri, none);
    }
    json_decref(none);
    json_decref(server->published);
    server->published = all;
}

void server_refresh(struct server *server, enum scenes_effort effort) {
    bool changed = scenes_refresh(&server->scenes, effort);
    server->was_saved = false;
    server_forget(server);
    if (changed)
        server_publish(server);
}
