// run_silent FILE...: scenes of which `glint check` must say nothing but notes. good.yaml stands beside a
// case that is wrong, and shows what is right; scenes that ship are right too.
#include "app/check.h"
#include "core/diag_text.h"

#include <stdio.h>

static int check_silent(struct asset_store *store, const char *path) {
    struct session_options options = {.path = str_from(path), .limits = limits_default()};
    struct session session;
    check_scene(&session, &options, store);
    bool silent = session.sink.errors + session.sink.warnings == 0 && session.state == SESSION_LOADED;
    if (!silent) {
        struct strbuf text;
        strbuf_init(&text);
        diag_text(&text, &session.sink, &session.sources, (struct diag_text_options){.notes = false});
        fprintf(stderr, "%s is not silent:\n%.*s", path, STR_ARG(strbuf_view(&text)));
        strbuf_finish(&text);
    }
    session_finish(&session);
    return silent ? 0 : 1;
}

int main(int argc, char **argv) {
    int failures = argc < 2;
    struct asset_store *store = asset_store_create();
    for (int i = 1; i < argc; i++)
        failures += check_silent(store, argv[i]);
    asset_store_destroy(store);
    printf("%d scenes, %d of them not silent\n", argc - 1, failures);
    return failures ? 1 : 0;
}
