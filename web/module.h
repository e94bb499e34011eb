// glint as a module of WebAssembly: what a page or node calls besides main(), which can be called repeatedly.
// It is the language server, message by message; JavaScript receives the server's messages through
// Module.onMessage(text). Built only by emscripten (preset `web`). Thread safety: one thread.
#ifndef GLINT_WEB_MODULE_H
#define GLINT_WEB_MODULE_H

struct server;

// The server, or NULL if there is no memory; web_lsp_close takes it and returns its exit status.
struct server *web_lsp_open(void);
// A message of the client, JSON in UTF-8. 0: it said `exit`.
int web_lsp_take(struct server *server, const char *text);
// Checks what has changed, when no message waits; with `idle`, also what takes longer. 1: a call with `idle`
// is still needed.
int web_lsp_refresh(struct server *server, int idle);
int web_lsp_close(struct server *server);

#endif
