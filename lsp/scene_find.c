// Which scene a document belongs to.
#include "lsp/scene.h"

#include "files/files_walk.h"
#include "grammar/schema.h"

#include <stdlib.h>
#include <string.h>

enum {
    FOLDERS_MOST = 8,      // above a document, searched for scenes that include it
    CANDIDATES_MOST = 200, // files in each
};
#define CANDIDATE_BYTES ((uint64_t)1 << 20)

bool scenes_is_settings(str path) {
    return str_equal(path_base(path), STR(FILES_CONFIG_NAME));
}

static bool is_scene_path(str path) {
    return !scenes_is_settings(path) && schema_file_fits(SCHEMA_FILE_SCENE, path);
}

static bool holds(str text, str what) {
    for (size_t i = 0; what.len && i + what.len <= text.len; i++) {
        const char *at = memchr(text.ptr + i, what.ptr[0], text.len - what.len - i + 1);
        if (!at)
            return false;
        i = (size_t)(at - text.ptr);
        if (memcmp(at, what.ptr, what.len) == 0)
            return true;
    }
    return false;
}

// Once a scene, a document stays one, whatever is typed.
bool scenes_is_scene(struct document *document) {
    str text = document_text(document);
    if (!document->is_scene && is_scene_path(document->path))
        document->is_scene = holds(path_base(document->path), STR(".glint.")) || holds(text, STR("glint"));
    return document->is_scene;
}

// Whether the file's text names an include and the document: only then is it worth loading.
static bool may_include(struct files *files, struct arena *arena, str candidate, str name) {
    str text;
    if (files_read(files, candidate, CANDIDATE_BYTES, arena, &text) != FILE_OK)
        return false;
    return holds(text, name) && (holds(text, STR("include")) || holds(text, STR("Include")));
}

// Whether the scene at `path` includes the document; it is then added.
static void try_scene(struct scenes *scenes, str path, str document) {
    struct session session;
    struct file_overlay *overlays = scenes_overlays(scenes);
    struct session_options options = scenes->settings;
    options.path = path;
    options.found_in = path_folder(path);
    options.overlays = overlays;
    options.overlay_count = overlays ? scenes->documents->count : 0;
    options.text_only = true;
    struct lsp_scene probe = {0};
    session_load(&session, &options, scenes->store);
    lsp_scene_note_files(&probe, &session);
    if (lsp_scene_has_file(&probe, document)) {
        struct lsp_scene *scene = scenes_add(scenes, path);
        if (scene)
            lsp_scene_note_files(scene, &session);
    }
    lsp_scene_forget_files(&probe);
    session_finish(&session);
    free(overlays);
}

static void try_folder(struct scenes *scenes, struct files *files, struct arena *arena, str folder,
                       str document) {
    struct files_names names = {0};
    files_list_folder(arena, arena_copy(arena, folder), &names);
    for (uint32_t i = 0, count = 0; i < names.count && count < CANDIDATES_MOST; i++) {
        str path = arena_format(arena, "%.*s/%.*s", STR_ARG(folder), STR_ARG(names.items[i]));
        if (!is_scene_path(path))
            continue;
        path = files_canonical(files, path);
        if (str_equal(path, document) || scenes_find(scenes, path))
            continue;
        count++;
        if (may_include(files, arena, path, path_base(document)))
            try_scene(scenes, path, document);
    }
}

struct placing {
    struct scenes *scenes;
    str path;
    struct arena arena;
};

static void try_folders(void *context) {
    struct placing *p = context;
    struct files files;
    files_init(&files, &p->arena);
    if (files_add_scene_root(&files, p->path) != FILE_OK)
        return;
    str root = files.roots.items[0];
    str folder = path_folder(p->path);
    for (int i = 0; i < FOLDERS_MOST && str_starts_with(folder, root); i++) {
        try_folder(p->scenes, &files, &p->arena, folder, p->path);
        if (str_equal(folder, root))
            break;
        folder = path_folder(folder);
    }
}

void scenes_place(struct scenes *scenes, struct document *document) {
    struct placing placing = {.scenes = scenes, .path = document->path};
    if (document->is_placed)
        return;
    document->is_placed = true;
    arena_init(&placing.arena, (size_t)1 << 28);
    arena_guarded(&placing.arena, try_folders, &placing);
    arena_finish(&placing.arena);
}
