// What the parts of the language server share.
#ifndef GLINT_LSP_SERVER_PRIVATE_H
#define GLINT_LSP_SERVER_PRIVATE_H

#include "lsp/document.h"
#include "lsp/locate.h"
#include "lsp/rpc.h"
#include "lsp/scene.h"

struct server {
    struct rpc rpc;
    struct documents documents;
    struct scenes scenes;
    const char *version;
    enum position_encoding encoding;
    bool initialized, shut_down;
    bool has_snippets; // the client takes completions with places to fill in
    bool has_markdown; // and hovers in Markdown
    bool may_watch;    // the client reports files that change on the disk if it is asked to
    bool was_saved;    // a document, since the last check
    json_t *published; // URI: its diagnostics, as the client knows them
    // The last lookups in the text and files of loaded scenes.
    struct position_index index;
    struct {
        const struct session *session;
        uint32_t source;
        char *text;
    } uri;
    struct server_preview *preview; // NULL: pictures are not offered
    const char *refusal;            // why a request is refused; NULL: it is not
};

// A request about an open document, or a place in it.
struct request {
    struct server *server;
    struct arena *arena; // only for the request; paths that the session's `files` makes are in it too
    const json_t *params;
    struct document *document;
    struct lsp_scene *scene; // the document's scene, up to date
    struct session *session; // of that scene
    size_t offset;           // of the place in the document
};

// The Location of a span; NULL if it has no file.
json_t *server_location(struct server *server, struct session *session, struct arena *arena, span at);
json_t *server_range(struct server *server, const struct session *session, span at);
// Must be called whenever scenes may have been loaded again.
void server_forget(struct server *server);

// Loads what has changed, and publishes what is new.
void server_refresh(struct server *server, enum scenes_effort effort);
json_t *server_diagnostic(struct server *server, struct session *session, struct arena *arena,
                          const struct diag *diag);

// Each answers one request; the result is a new reference, NULL for null. Only server_formatting is asked for
// documents without a scene.
typedef json_t *server_answer(const struct request *request);
server_answer server_code_actions, server_definition, server_references, server_highlights,
    server_prepare_rename, server_rename, server_hover, server_symbols, server_links, server_completion,
    server_formatting, server_colors, server_color_texts;

// ---- preview.c

#define SERVER_PREVIEW "glint.preview" // the command

struct preview_devices;
// NULL: no memory.
struct server_preview *server_preview_create(const struct preview_devices *devices);
void server_preview_destroy(struct server_preview *preview);
// A descriptor that can be read when server_preview_step has something to do; -1: there is none.
int server_preview_woken(const struct server_preview *preview);
// Takes a request to execute the command; a picture will answer it.
void server_preview_ask(struct server *server, json_t *id, const json_t *params);
// Answers with what was drawn, and begins what waits. Returns whether something is being drawn.
bool server_preview_step(struct server *server);
// The client wants no answer to a request any more.
void server_preview_cancel(struct server *server, const json_t *id);
// The same for all requests.
void server_preview_drop(struct server *server);

#endif
