// run_silent FILE...: scenes of which `glint check` must say nothing but notes. good.yaml stands beside a
// case that is wrong, and shows what is right; scenes that ship are right too.
#include "diag/diag_text.h"
#include "load/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    SKIPPED = 77
};

static int check_silent(struct asset_store *store, const char *path, const char *folder) {
    str asset_path = str_from(folder);
    struct session_options options = {.path = str_from(path),
                                      .limits = limits_default(),
                                      .asset_paths = &asset_path,
                                      .asset_path_count = asset_path.len ? 1 : 0};
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
    char seed[4096];
    const char *assets = getenv("GLINT_ASSETS");
    const char *folder = NULL;
    int first = 1;
    snprintf(seed, sizeof seed, "%s/seed", assets && *assets ? assets : "../shared/assets");
    if (argc > 1 && strcmp(argv[1], "--seed") == 0) {
        folder = seed;
        first = 2;
    } else if (argc > 2 && strcmp(argv[1], "--asset-path") == 0) {
        folder = argv[2];
        first = 3;
    }
    if (folder == seed && access(seed, R_OK) != 0) {
        printf("skipped: %s is not here\n", seed);
        return SKIPPED;
    }
    int failures = argc <= first;
    struct asset_store *store = asset_store_create();
    for (int i = first; i < argc; i++)
        failures += check_silent(store, argv[i], folder);
    asset_store_destroy(store);
    printf("%d scenes, %d of them not silent\n", argc - first, failures);
    return failures ? 1 : 0;
}
