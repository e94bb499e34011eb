#include "lsp/server.h"

#include "core/heap.h"
#include "core/strbuf.h"
#include "grammar/schema.h"
#include "lsp/server_private.h"

#include <stdlib.h>
#include <string.h>

enum {
    IDLE_MS = 400, // without a message: nobody types
};

// ---- capabilities

// The first of the client's encodings that we know; UTF-16 if it names none.
static enum position_encoding choose_encoding(const json_t *params) {
    const json_t *general = json_object_get(json_object_get(params, "capabilities"), "general");
    const json_t *offered = json_object_get(general, "positionEncodings");
    size_t index;
    json_t *item;
    json_array_foreach(offered, index, item) {
        const char *name = json_string_value(item);
        if (name && strcmp(name, "utf-8") == 0)
            return POSITION_UTF8;
        if (name && strcmp(name, "utf-32") == 0)
            return POSITION_UTF32;
        if (name && strcmp(name, "utf-16") == 0)
            return POSITION_UTF16;
    }
    return POSITION_UTF16;
}

static void choose_texts(struct server *server, const json_t *client) {
    const json_t *item = json_object_get(json_object_get(client, "completion"), "completionItem");
    const json_t *formats = json_object_get(json_object_get(client, "hover"), "contentFormat");
    size_t index;
    json_t *format;
    server->has_snippets = json_is_true(json_object_get(item, "snippetSupport"));
    json_array_foreach(formats, index, format) {
        const char *name = json_string_value(format);
        server->has_markdown = server->has_markdown || (name && strcmp(name, "markdown") == 0);
    }
}

static json_t *capabilities(const struct server *server) {
    static const char *const encodings[] = {"utf-16", "utf-8", "utf-32"};
    json_t *commands = server->preview ? json_pack("{s:[s]}", "commands", SERVER_PREVIEW) : NULL;
    return json_pack("{s:s, s:{s:b, s:i, s:{s:b}}, s:{s:[s,s]}, s:b, s:b, s:b, s:{s:b}, s:b, s:b, s:{}, "
                     "s:{s:[s,s,s,s,s]}, s:b, s:b, s:o*}",
                     "positionEncoding", encodings[server->encoding], //
                     "textDocumentSync", "openClose", 1, "change", 2, // incremental
                     "save", "includeText", 0,                        //
                     "codeActionProvider", "codeActionKinds", "quickfix", "source.fixAll.glint",
                     "definitionProvider", 1,                //
                     "referencesProvider", 1,                //
                     "documentHighlightProvider", 1,         //
                     "renameProvider", "prepareProvider", 1, //
                     "hoverProvider", 1,                     //
                     "documentSymbolProvider", 1,            //
                     "documentLinkProvider",                 //
                     "completionProvider", "triggerCharacters", ":", "\"", "/", " ", "<",
                     "documentFormattingProvider", 1, //
                     "colorProvider", 1,              //
                     "executeCommandProvider", commands);
}

static json_t *initialize(struct server *server, const json_t *params) {
    const json_t *workspace = json_object_get(json_object_get(params, "capabilities"), "workspace");
    const json_t *watching = json_object_get(workspace, "didChangeWatchedFiles");
    server->may_watch = json_is_true(json_object_get(watching, "dynamicRegistration"));
    server->encoding = choose_encoding(params);
    choose_texts(server, json_object_get(json_object_get(params, "capabilities"), "textDocument"));
    server->initialized = true;
    return json_pack("{s:o, s:{s:s, s:s}}", "capabilities", capabilities(server), "serverInfo", "name",
                     "glint", "version", server->version);
}

// ---- documents

static const json_t *text_document(const json_t *params) {
    return json_object_get(params, "textDocument");
}

static const char *uri_of(const json_t *params) {
    const char *uri = json_string_value(json_object_get(text_document(params), "uri"));
    return uri ? uri : "";
}

static void did_open(struct server *server, const json_t *params) {
    const json_t *text = json_object_get(text_document(params), "text");
    json_int_t version = json_integer_value(json_object_get(text_document(params), "version"));
    if (json_is_string(text) && documents_open(&server->documents, uri_of(params), json_string_value(text),
                                               json_string_length(text), version))
        scenes_touch(&server->scenes, STR(""));
}

static void did_change(struct server *server, const json_t *params) {
    struct document *document = documents_find(&server->documents, uri_of(params));
    if (!document)
        return;
    document->version = json_integer_value(json_object_get(text_document(params), "version"));
    document_change(document, server->encoding, json_object_get(params, "contentChanges"));
    scenes_touch(&server->scenes, document->path);
}

static void did_close(struct server *server, const json_t *params) {
    documents_close(&server->documents, uri_of(params));
    scenes_touch(&server->scenes, STR(""));
}

static void did_save(struct server *server, const json_t *params) {
    (void)params;
    scenes_touch(&server->scenes, STR(""));
    server->was_saved = true;
}

static void cancel(struct server *server, const json_t *params) {
    server_preview_cancel(server, json_object_get(params, "id"));
}

// The files that a scene can be made of: "**/*.{yaml,yml,...}".
static json_t *scene_files_glob(void) {
    static const enum schema_file kinds[] = {SCHEMA_FILE_SCENE, SCHEMA_FILE_MESH, SCHEMA_FILE_IMAGE};
    struct strbuf glob;
    strbuf_init(&glob);
    strbuf_cstr(&glob, "**/*.{mtl");
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        for (const char *const *ending = schema_file_endings(kinds[i]); *ending; ending++)
            strbuf_format(&glob, ",%s", *ending + 1);
    strbuf_char(&glob, '}');
    json_t *text = json_stringn(glob.data, glob.len);
    strbuf_finish(&glob);
    return text;
}

// Meshes are watched too: a mesh that another program writes is as much a part of the scene as its text.
static void initialized(struct server *server, const json_t *params) {
    (void)params;
    if (!server->may_watch)
        return;
    json_t *watchers = json_array();
    json_array_append_new(watchers, json_pack("{s:o}", "globPattern", scene_files_glob()));
    json_array_append_new(watchers, json_pack("{s:s}", "globPattern", "**/" FILES_CONFIG_NAME));
    rpc_ask(&server->rpc, "watch", "client/registerCapability",
            json_pack("{s:[{s:s, s:s, s:{s:o}}]}", "registrations", "id", "watch", "method",
                      "workspace/didChangeWatchedFiles", "registerOptions", "watchers", watchers));
}

// ---- dispatch

// The answer if the document does not belong to a scene that could be loaded.
enum without_scene {
    ANSWER_NULL,
    ANSWER_EMPTY, // a list
    ANSWER_STILL, // the method needs no scene
};

static const struct method {
    const char *name;
    server_answer *answer;
    enum without_scene without_scene;
} methods[] = {
    {"textDocument/codeAction", server_code_actions, ANSWER_EMPTY},
    {"textDocument/definition", server_definition, ANSWER_NULL},
    {"textDocument/references", server_references, ANSWER_EMPTY},
    {"textDocument/documentHighlight", server_highlights, ANSWER_EMPTY},
    {"textDocument/prepareRename", server_prepare_rename, ANSWER_NULL},
    {"textDocument/rename", server_rename, ANSWER_NULL},
    {"textDocument/hover", server_hover, ANSWER_NULL},
    {"textDocument/documentSymbol", server_symbols, ANSWER_EMPTY},
    {"textDocument/documentLink", server_links, ANSWER_EMPTY},
    {"textDocument/completion", server_completion, ANSWER_EMPTY},
    {"textDocument/formatting", server_formatting, ANSWER_STILL},
    {"textDocument/documentColor", server_colors, ANSWER_EMPTY},
    {"textDocument/colorPresentation", server_color_texts, ANSWER_EMPTY},
};

static const struct {
    const char *method;
    void (*take)(struct server *server, const json_t *params);
} notifications[] = {
    {"initialized", initialized},
    {"textDocument/didOpen", did_open},
    {"textDocument/didChange", did_change},
    {"textDocument/didClose", did_close},
    {"textDocument/didSave", did_save},
    {"workspace/didChangeWatchedFiles", did_save},
    {"$/cancelRequest", cancel},
};

struct answering {
    server_answer *answer;
    struct request request;
    json_t *result;
};

static void run_answer(void *context) {
    struct answering *a = context;
    a->result = a->answer(&a->request);
}

// If memory runs out in a session's arena, or in the request's own, only the request fails.
static json_t *answer(struct server *server, const struct method *method, const json_t *params, bool *good) {
    struct arena arena;
    struct document *document = documents_find(&server->documents, uri_of(params));
    struct lsp_scene *scene = document ? scenes_of(&server->scenes, document->path) : NULL;
    struct session *session = scene ? &scene->session : NULL;
    server->refusal = NULL;
    *good = true;
    if (!session && (!document || method->without_scene != ANSWER_STILL))
        return method->without_scene == ANSWER_EMPTY ? json_array() : NULL;
    struct request request = {.server = server,
                              .arena = &arena,
                              .params = params,
                              .document = document,
                              .scene = scene,
                              .session = session,
                              .offset = position_read(document_text(document), server->encoding,
                                                      json_object_get(params, "position"), NULL)};
    struct answering answering = {method->answer, request, NULL};
    struct arena *arenas[] = {&arena, session ? &session->arena : NULL, NULL};
    arena_init(&arena, SIZE_MAX / 2);
    if (session)
        session->files.arena = &arena; // or the session would grow with every request
    *good = arena_guarded_all(arenas, run_answer, &answering) == ARENA_FAULT_NONE;
    if (session)
        session->files.arena = &session->arena;
    arena_finish(&arena);
    return answering.result;
}

static void execute(struct server *server, json_t *id, const json_t *params) {
    const char *command = json_string_value(json_object_get(params, "command"));
    if (command && strcmp(command, SERVER_PREVIEW) == 0)
        server_preview_ask(server, id, params);
    else
        rpc_refuse(&server->rpc, id, RPC_INVALID_PARAMS, "this command is not supported");
}

static void take_request(struct server *server, const char *method, json_t *id, const json_t *params) {
    if (strcmp(method, "initialize") == 0 && !server->initialized) {
        rpc_reply(&server->rpc, id, initialize(server, params));
        return;
    }
    if (!server->initialized || server->shut_down) {
        rpc_refuse(&server->rpc, id, server->shut_down ? RPC_INVALID_REQUEST : RPC_NOT_INITIALIZED,
                   server->shut_down ? "the server was shut down" : "the server is not initialized");
        return;
    }
    if (strcmp(method, "shutdown") == 0) {
        server->shut_down = true;
        server_preview_drop(server);
        rpc_reply(&server->rpc, id, NULL);
        return;
    }
    if (server->preview && strcmp(method, "workspace/executeCommand") == 0) {
        execute(server, id, params);
        return;
    }
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        if (strcmp(method, methods[i].name) != 0)
            continue;
        bool good;
        server_refresh(server, SCENES_QUICK);
        json_t *result = answer(server, &methods[i], params, &good);
        if (good && server->refusal)
            rpc_refuse(&server->rpc, id, RPC_REQUEST_FAILED, server->refusal);
        else if (good)
            rpc_reply(&server->rpc, id, result);
        else
            rpc_refuse(&server->rpc, id, RPC_REQUEST_FAILED, "there is not enough memory");
        return;
    }
    rpc_refuse(&server->rpc, id, RPC_METHOD_NOT_FOUND, "this method is not supported");
}

// false: the client said `exit`.
static bool take(struct server *server, json_t *message) {
    const char *method = json_string_value(json_object_get(message, "method"));
    json_t *id = json_object_get(message, "id");
    const json_t *params = json_object_get(message, "params");
    if (!method && id && (json_object_get(message, "result") || json_object_get(message, "error")))
        return true; // an answer: the server asked nothing
    if (!method) {
        rpc_refuse(&server->rpc, id, RPC_INVALID_REQUEST, "the message has no method");
        return true;
    }
    if (id) {
        take_request(server, method, id, params);
        return true;
    }
    if (strcmp(method, "exit") == 0)
        return false;
    for (size_t i = 0;
         server->initialized && !server->shut_down && i < sizeof notifications / sizeof *notifications; i++)
        if (strcmp(method, notifications[i].method) == 0)
            notifications[i].take(server, params);
    return true;
}

// Starts a server that has its connection already.
static void start(struct server *server, const struct session_options *settings) {
    json_set_alloc_funcs(heap_alloc, free);
    server->published = json_object();
    documents_init(&server->documents);
    scenes_init(&server->scenes, &server->documents, settings);
}

// Returns the exit status.
static int end(struct server *server) {
    server_preview_destroy(server->preview);
    scenes_finish(&server->scenes);
    documents_finish(&server->documents);
    json_decref(server->published);
    server_forget(server);
    position_index_finish(&server->index);
    rpc_finish(&server->rpc);
    return server->shut_down ? 0 : 1;
}

int lsp_serve(int in, int out, const char *version, const struct session_options *settings,
              const struct preview_devices *devices, struct lsp_fault *fault) {
    struct server server = {.version = version};
    rpc_init(&server.rpc, in, out);
    start(&server, settings);
    server.preview = server_preview_create(devices);
    server.rpc.woken = server_preview_woken(server.preview);
    bool goes_on = server.scenes.store != NULL;
    while (goes_on && !server.rpc.broken) {
        bool draws = server_preview_step(&server);
        // Many keys may have been pressed since the last check: only the newest text counts.
        if (rpc_wait(&server.rpc, 0) != RPC_BYTES)
            lsp_refresh(&server, false);
        if (scenes_are_partial(&server.scenes) && rpc_wait(&server.rpc, IDLE_MS) == RPC_NOTHING)
            lsp_refresh(&server, true);
        if (draws && rpc_wait(&server.rpc, -1) == RPC_WOKEN)
            continue;
        json_t *message;
        goes_on = rpc_read(&server.rpc, &message) == RPC_MESSAGE;
        if (!goes_on)
            break;
        goes_on = take(&server, message);
        json_decref(message);
    }
    *fault = (struct lsp_fault){server.rpc.error, server.rpc.input_failed};
    return end(&server);
}

struct server *lsp_open(const char *version, const struct session_options *settings, rpc_sender *send,
                        void *context) {
    struct server *server = heap_zeroed(1, sizeof *server);
    if (!server)
        return NULL;
    server->version = version;
    rpc_init_sender(&server->rpc, send, context);
    start(server, settings);
    if (!server->scenes.store) {
        lsp_close(server);
        return NULL;
    }
    return server;
}

bool lsp_take(struct server *server, const char *text, size_t length) {
    json_t *message = rpc_parse(&server->rpc, text, length);
    bool goes_on = !message || take(server, message);
    json_decref(message);
    return goes_on;
}

bool lsp_refresh(struct server *server, bool idle) {
    server_refresh(server, idle || server->was_saved ? SCENES_WHOLE : SCENES_QUICK);
    return scenes_are_partial(&server->scenes);
}

int lsp_close(struct server *server) {
    int status = end(server);
    free(server);
    return status;
}
