// Paths of a scene that is written to a folder other than the one it was read from.
#include "diag/codes/file.h"
#include "load/session.h"

#include "grammar/ir_walk.h"
#include "grammar/schema.h"

struct rebase {
    struct session *session;
    str out;
    struct files there; // what the scene may read from its new folder
    uint32_t beyond;    // number of paths outside that
    span first;
    str first_path;
};

static void rebase_path(void *context, const struct schema_element *schema, void *element,
                        const struct schema_row *row, str *path) {
    struct rebase *rebase = context;
    struct session *session = rebase->session;
    str before = *path;
    *path = files_rebase(&session->files, before, session->options.path, rebase->out);
    str found;
    if (path->ptr == before.ptr || files_resolve(&rebase->there, rebase->out, *path, &found) != FILE_OUTSIDE)
        return;
    if (rebase->beyond++)
        return;
    rebase->first = ir_place_value(&session->origin, element, schema, row->name);
    rebase->first_path = *path;
}

static void warn(struct rebase *rebase) {
    struct session *session = rebase->session;
    if (rebase->beyond == 0)
        return;
    diag_add(
        &session->sink, DIAG_FILE_BEYOND, rebase->first,
        "written to '%.*s', the scene has %u path%s that %s outside the folder that it may read; here '%.*s'",
        STR_ARG(rebase->out), rebase->beyond, rebase->beyond == 1 ? "" : "s",
        rebase->beyond == 1 ? "leads" : "lead", STR_ARG(rebase->first_path));
    str folder = files_canonical(&session->files, path_folder(session->options.path));
    diag_help(&session->sink,
              "use the scene with --asset-path %.*s, or put an empty .glintrc.yaml in a folder above both",
              STR_ARG(folder));
    diag_sort(&session->sink);
}

static void rebase_all(void *context) {
    struct rebase *rebase = context;
    struct session *session = rebase->session;
    files_init(&rebase->there, &session->arena);
    files_add_scene_root(&rebase->there, rebase->out);
    for (uint32_t i = 0; i < session->options.asset_path_count; i++)
        files_add_root(&rebase->there, session->options.asset_paths[i]);
    ir_walk_paths(session->scene, rebase_path, rebase);
    warn(rebase);
}

bool session_rebase(struct session *session, str out) {
    struct rebase rebase = {.session = session, .out = out};
    return arena_guarded(&session->arena, rebase_all, &rebase) == ARENA_FAULT_NONE;
}
