// `glint lsp`: a server of the Language Server Protocol 3.17 for scenes, over two file descriptors, or
// message by message.
//
// It offers what a schema cannot: every diagnostic of `glint check` while the user types, with its fixes;
// definitions and uses of names, across includes and spellings; meshes, images and includes as links; names,
// words and files as completions; the outline; formatting. It reads files and writes none: changes are sent
// to the editor.
// Thread safety: one thread; previews are drawn on one of their own.
#ifndef GLINT_LSP_SERVER_H
#define GLINT_LSP_SERVER_H

#include <stdbool.h>
#include <stddef.h>

struct preview_devices; // render/preview/preview.h
struct session_options;

// Why a stream of the server could not be read or written.
struct lsp_fault {
    int error;     // an errno; 0: there was none
    bool is_input; // else the output
};

// Serves until the client says `exit` or hangs up, or a stream fails. `settings`: the limits, folders and
// policy of every scene. `devices`: what draws previews; NULL: the reference does. Returns the exit status of
// the protocol: 0 after `shutdown`, else 1.
int lsp_serve(int in, int out, const char *version, const struct session_options *settings,
              const struct preview_devices *devices, struct lsp_fault *fault);

// The same if no stream can be waited for, as in a web worker, and without previews. lsp_open returns NULL if
// there is no memory; lsp_close takes its result and returns the exit status. `send` gets each message of the
// server, JSON in UTF-8 without a header, within lsp_take and lsp_refresh, and must not call them.
struct server *lsp_open(const char *version, const struct session_options *settings,
                        void (*send)(void *context, const char *text, size_t length), void *context);
// A message of the client. false: it said `exit`.
bool lsp_take(struct server *server, const char *text, size_t length);
// Checks what has changed; call it when no message waits. Without `idle` it does what is quick; with `idle`,
// when nobody has typed for a while, also what takes longer. Returns whether a call with `idle` is still
// needed.
bool lsp_refresh(struct server *server, bool idle);
int lsp_close(struct server *server);

#endif
