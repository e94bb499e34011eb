#include "web/module.h"

#include "load/session.h"
#include "lsp/server.h"

#include <emscripten.h>
#include <string.h>

EM_JS(void, send_out, (const char *text), { Module["onMessage"](UTF8ToString(text)); })

static void send_text(void *context, const char *text, size_t length) {
    (void)context;
    (void)length; // JSON holds no zero
    send_out(text);
}

struct server *web_lsp_open(void) {
    const struct session_options settings = {.limits = limits_default(), .pixels = ASSETS_SKIP_PIXELS};
    return lsp_open(GLINT_VERSION, &settings, send_text, NULL);
}

int web_lsp_take(struct server *server, const char *text) {
    return lsp_take(server, text, strlen(text));
}

int web_lsp_refresh(struct server *server, int idle) {
    return lsp_refresh(server, idle != 0);
}

int web_lsp_close(struct server *server) {
    return lsp_close(server);
}
