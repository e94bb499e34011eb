#include "lsp/scene.h"

#include "app/check.h"
#include "core/files_walk.h"

#include <stdlib.h>
#include <string.h>

enum {
    FOLDERS_MOST = 8,      // above a document, in which scenes that include it are looked for
    CANDIDATES_MOST = 200, // files in each
};
#define CANDIDATE_BYTES ((uint64_t)1 << 20)

void scenes_init(struct scenes *scenes, struct documents *documents) {
    *scenes =
        (struct scenes){.store = asset_store_create(), .documents = documents, .limits = limits_default()};
}

static void unload(struct lsp_scene *scene) {
    if (scene->loaded)
        session_finish(&scene->session);
    scene->loaded = false;
}

static void destroy(struct lsp_scene *scene) {
    unload(scene);
    for (uint32_t i = 0; i < scene->file_count; i++)
        free((char *)scene->files[i].ptr);
    free(scene->files);
    arena_finish(&scene->arena);
    free(scene);
}

void scenes_finish(struct scenes *scenes) {
    for (uint32_t i = 0; i < scenes->count; i++)
        destroy(scenes->items[i]);
    free(scenes->items);
    asset_store_destroy(scenes->store);
}

void scenes_touch(struct scenes *scenes) {
    for (uint32_t i = 0; i < scenes->count; i++)
        scenes->items[i]->is_stale = true;
}

// ---- loading

static bool has_file(const struct lsp_scene *scene, str path) {
    for (uint32_t i = 0; i < scene->file_count; i++)
        if (str_equal(scene->files[i], path))
            return true;
    return false;
}

// What the scene consists of; kept where the new text could not be read that far.
static void note_files(struct lsp_scene *scene) {
    struct session *session = &scene->session;
    uint32_t count = session->origin.files.count;
    str *files = count ? calloc(count, sizeof *files) : NULL;
    struct arena_guard guard;
    if (!files)
        return;
    volatile uint32_t done = 0;
    arena_set_guard(&session->arena, &guard);
    if (setjmp(guard.jump) == 0) {
        for (; done < count; done++) {
            uint32_t source = session->origin.files.items[done].source;
            str path = files_canonical(&session->files, session->sources.items[source].path);
            char *copy = strndup(path.ptr, path.len);
            files[done] = (str){copy, copy ? path.len : 0};
        }
    }
    arena_set_guard(&session->arena, NULL);
    for (uint32_t i = 0; i < scene->file_count; i++)
        free((char *)scene->files[i].ptr);
    free(scene->files);
    scene->files = files;
    scene->file_count = done;
}

static void load(struct scenes *scenes, struct lsp_scene *scene) {
    struct documents *documents = scenes->documents;
    struct file_overlay *overlays = calloc(documents->count + 1, sizeof *overlays);
    struct session_options options = {.path = scene->path, .limits = scenes->limits, .skip_pixels = true};
    for (uint32_t i = 0; overlays && i < documents->count; i++)
        overlays[i] = (struct file_overlay){documents->items[i].path, document_text(&documents->items[i])};
    options.overlays = overlays;
    options.overlay_count = overlays ? documents->count : 0;
    unload(scene);
    check_scene(&scene->session, &options, scenes->store);
    // The texts are the session's by now.
    scene->session.options.overlays = NULL;
    scene->session.options.overlay_count = 0;
    free(overlays);
    scene->loaded = true;
    scene->is_stale = false;
    scene->is_fresh = true;
    if (scene->session.state == SESSION_LOADED)
        note_files(scene);
}

static struct lsp_scene *find(struct scenes *scenes, str path) {
    for (uint32_t i = 0; i < scenes->count; i++)
        if (str_equal(scenes->items[i]->path, path))
            return scenes->items[i];
    return NULL;
}

static struct lsp_scene *add(struct scenes *scenes, str path) {
    struct lsp_scene *known = find(scenes, path);
    if (known)
        return known;
    if (scenes->count == scenes->capacity) {
        uint32_t capacity = scenes->capacity ? 2 * scenes->capacity : 8;
        struct lsp_scene **items = realloc(scenes->items, capacity * sizeof *items);
        if (!items)
            return NULL;
        scenes->items = items;
        scenes->capacity = capacity;
    }
    struct lsp_scene *scene = calloc(1, sizeof *scene);
    struct arena_guard guard;
    if (!scene)
        return NULL;
    arena_init(&scene->arena, SIZE_MAX / 2);
    arena_set_guard(&scene->arena, &guard);
    if (setjmp(guard.jump) != 0) {
        destroy(scene);
        return NULL;
    }
    scene->path = arena_copy(&scene->arena, path);
    scene->is_stale = true;
    arena_set_guard(&scene->arena, NULL);
    scenes->items[scenes->count++] = scene;
    return scene;
}

static void forget(struct scenes *scenes, struct lsp_scene *scene) {
    for (uint32_t i = 0; i < scenes->count; i++)
        if (scenes->items[i] == scene)
            scenes->items[i] = scenes->items[--scenes->count];
    destroy(scene);
}

// ---- which scene a document belongs to

static bool is_scene_path(str path) {
    static const char *const endings[] = {".yaml", ".yml", ".xml", ".json"};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (str_ends_with_nocase(path, endings[i]))
            return true;
    return false;
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

// Whether the file's text names an include and the document: only then is it worth loading.
static bool may_include(struct files *files, struct arena *arena, str candidate, str name) {
    str text;
    if (files_read(files, candidate, CANDIDATE_BYTES, arena, &text) != FILE_OK)
        return false;
    return holds(text, name) && (holds(text, STR("include")) || holds(text, STR("Include")));
}

// Loads the scenes in one folder that may include the document.
static void try_folder(struct scenes *scenes, struct files *files, struct arena *arena, str folder,
                       str document) {
    struct files_names names = {0};
    files_list_folder(arena, arena_copy(arena, folder), &names);
    for (uint32_t i = 0, count = 0; i < names.count && count < CANDIDATES_MOST; i++) {
        str path = arena_format(arena, "%.*s/%.*s", STR_ARG(folder), STR_ARG(names.items[i]));
        if (!is_scene_path(path) || str_equal(path, document) || find(scenes, path))
            continue;
        count++;
        if (!may_include(files, arena, path, path_base(document)))
            continue;
        struct lsp_scene *scene = add(scenes, path);
        if (!scene)
            continue;
        load(scenes, scene);
        if (!has_file(scene, document))
            forget(scenes, scene);
    }
}

static void place(struct scenes *scenes, struct document *document, str path) {
    struct arena arena;
    struct arena_guard guard;
    struct files files;
    if (document->is_placed)
        return;
    document->is_placed = true;
    arena_init(&arena, (size_t)1 << 28);
    arena_set_guard(&arena, &guard);
    if (setjmp(guard.jump) == 0) {
        files_init(&files, &arena);
        if (files_add_scene_root(&files, path) == FILE_OK) {
            str root = files.roots.items[0];
            str folder = path_folder(path);
            for (int i = 0; i < FOLDERS_MOST && str_starts_with(folder, root); i++) {
                try_folder(scenes, &files, &arena, folder, path);
                folder = path_folder(folder);
            }
        }
    }
    arena_finish(&arena);
}

static bool is_part_of_another(const struct scenes *scenes, str path) {
    for (uint32_t i = 0; i < scenes->count; i++) {
        const struct lsp_scene *scene = scenes->items[i];
        if (!str_equal(scene->path, path) && has_file(scene, path))
            return true;
    }
    return false;
}

static void want_owners(struct scenes *scenes, str path) {
    bool owned = is_part_of_another(scenes, path);
    for (uint32_t i = 0; i < scenes->count; i++) {
        struct lsp_scene *scene = scenes->items[i];
        bool is_main = str_equal(scene->path, path);
        scene->is_wanted |= owned ? !is_main && has_file(scene, path) : is_main;
    }
}

bool scenes_refresh(struct scenes *scenes) {
    struct documents *documents = scenes->documents;
    bool changed = false;
    for (uint32_t i = 0; i < documents->count; i++) {
        str path = documents->items[i].path;
        if (!is_scene_path(path))
            continue;
        place(scenes, &documents->items[i], path);
        if (!is_part_of_another(scenes, path))
            add(scenes, path);
    }
    for (uint32_t i = 0; i < scenes->count; i++) {
        if (scenes->items[i]->is_stale)
            load(scenes, scenes->items[i]);
        changed |= scenes->items[i]->is_fresh;
        scenes->items[i]->is_fresh = false;
        scenes->items[i]->is_wanted = false;
    }
    for (uint32_t i = 0; i < documents->count; i++)
        if (is_scene_path(documents->items[i].path))
            want_owners(scenes, documents->items[i].path);
    for (uint32_t i = scenes->count; i > 0; i--) {
        if (scenes->items[i - 1]->is_wanted)
            continue;
        forget(scenes, scenes->items[i - 1]);
        changed = true;
    }
    return changed;
}

struct lsp_scene *scenes_of(struct scenes *scenes, str path) {
    for (uint32_t i = 0; i < scenes->count; i++)
        if (scenes->items[i]->loaded && scenes->items[i]->session.state == SESSION_LOADED &&
            has_file(scenes->items[i], path))
            return scenes->items[i];
    return NULL;
}
