// `glint lsp`: a server of the Language Server Protocol 3.17 for scenes, over two file descriptors.
//
// What a schema cannot offer: every diagnostic of `glint check` while the user types, with its fixes;
// definitions and uses of names, over includes and spellings; meshes, images and includes as links; names,
// words and files as completions; the outline; formatting. It reads files and writes none: changes are sent
// to the editor.
// Thread safety: one thread.
#ifndef GLINT_LSP_SERVER_H
#define GLINT_LSP_SERVER_H

#include <stdbool.h>

struct session_options;

// Why a stream of the server could not be read or written.
struct lsp_fault {
    int error;     // an errno; 0: there was none
    bool is_input; // else the output
};

// Serves until the client says `exit` or hangs up, or a stream fails. `settings`: the limits, folders and
// policy of every scene. The exit status that the protocol asks for: 0 after `shutdown`, else 1.
int lsp_serve(int in, int out, const char *version, const struct session_options *settings,
              struct lsp_fault *fault);

#endif
