#include "lsp/scene.h"

#include "core/heap.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

#include <stdlib.h>
#include <string.h>

void scenes_init(struct scenes *scenes, struct documents *documents, const struct session_options *settings) {
    *scenes = (struct scenes){.store = asset_store_create(), .documents = documents, .settings = *settings};
}

void lsp_scene_unload(struct lsp_scene *scene) {
    if (scene->loaded)
        session_finish(&scene->session);
    scene->loaded = false;
}

void lsp_scene_forget_files(struct lsp_scene *scene) {
    for (uint32_t i = 0; i < scene->file_count; i++)
        free((char *)scene->files[i].ptr);
    free(scene->files);
    scene->files = NULL;
    scene->file_count = 0;
}

static void destroy(struct lsp_scene *scene) {
    lsp_scene_unload(scene);
    lsp_scene_forget_files(scene);
    json_decref(scene->names);
    json_decref(scene->arguments);
    arena_finish(&scene->arena);
    free(scene);
}

void scenes_finish(struct scenes *scenes) {
    for (uint32_t i = 0; i < scenes->count; i++)
        destroy(scenes->items[i]);
    free(scenes->items);
    asset_store_destroy(scenes->store);
}

// Text that is not a scene's, such as a mesh's or the settings', may affect any scene.
void scenes_touch(struct scenes *scenes, str path) {
    const struct document *document = path.len ? documents_find_path(scenes->documents, path) : NULL;
    for (uint32_t i = 0; i < scenes->count; i++) {
        struct lsp_scene *scene = scenes->items[i];
        scene->is_stale |= !document || !document->is_scene || scene->session.state != SESSION_LOADED ||
                           str_equal(scene->path, path) || lsp_scene_has_file(scene, path);
    }
}

// ---- the files of one

bool lsp_scene_has_file(const struct lsp_scene *scene, str path) {
    for (uint32_t i = 0; i < scene->file_count; i++)
        if (str_equal(scene->files[i], path))
            return true;
    return false;
}

struct noting {
    struct session *session;
    str *files;
    uint32_t count;
};

static void note_paths(void *context) {
    struct noting *n = context;
    struct session *session = n->session;
    for (; n->count < session->origin.files.count; n->count++) {
        uint32_t source = session->origin.files.items[n->count].source;
        str path = files_canonical(&session->files, session->sources.items[source].path);
        char *copy = heap_text_of(path.ptr, path.len);
        n->files[n->count] = (str){copy, copy ? path.len : 0};
    }
}

// Notes the scene's files; keeps the old list if the new text could not be read that far.
void lsp_scene_note_files(struct lsp_scene *scene, struct session *session) {
    uint32_t count = session->origin.files.count;
    struct noting noting = {session, count ? heap_zeroed(count, sizeof *noting.files) : NULL, 0};
    if (!noting.files)
        return;
    arena_guarded(&session->arena, note_paths, &noting);
    lsp_scene_forget_files(scene);
    scene->files = noting.files;
    scene->file_count = noting.count;
}

struct file_overlay *scenes_overlays(const struct scenes *scenes) {
    struct documents *documents = scenes->documents;
    struct file_overlay *overlays = heap_zeroed(documents->count + 1, sizeof *overlays);
    for (uint32_t i = 0; overlays && i < documents->count; i++)
        overlays[i] = (struct file_overlay){documents->items[i].path, document_text(&documents->items[i])};
    return overlays;
}

// ---- the list

struct lsp_scene *scenes_find(struct scenes *scenes, str path) {
    for (uint32_t i = 0; i < scenes->count; i++)
        if (str_equal(scenes->items[i]->path, path))
            return scenes->items[i];
    return NULL;
}

static void keep_path(void *context) {
    struct lsp_scene *scene = context;
    scene->path = arena_copy(&scene->arena, scene->path);
}

struct lsp_scene *scenes_add(struct scenes *scenes, str path) {
    struct lsp_scene *known = scenes_find(scenes, path);
    if (known)
        return known;
    struct lsp_scene **items = heap_grow(scenes->items, scenes->count, &scenes->capacity, sizeof *items);
    if (!items)
        return NULL;
    scenes->items = items;
    struct lsp_scene *scene = heap_zeroed(1, sizeof *scene);
    if (!scene)
        return NULL;
    arena_init(&scene->arena, SIZE_MAX / 2);
    scene->path = path;
    scene->is_stale = true;
    if (arena_guarded(&scene->arena, keep_path, scene) != ARENA_FAULT_NONE) {
        destroy(scene);
        return NULL;
    }
    scenes->items[scenes->count++] = scene;
    return scene;
}

void scenes_forget(struct scenes *scenes, struct lsp_scene *scene) {
    for (uint32_t i = 0; i < scenes->count; i++)
        if (scenes->items[i] == scene)
            scenes->items[i] = scenes->items[--scenes->count];
    destroy(scene);
}

bool lsp_scene_lacks(const struct lsp_scene *scene) {
    return scene->lacks_lint || scene->lacks_pixels;
}

bool scenes_are_partial(const struct scenes *scenes) {
    for (uint32_t i = 0; i < scenes->count; i++)
        if (lsp_scene_lacks(scenes->items[i]))
            return true;
    return false;
}

struct lsp_scene *scenes_of(struct scenes *scenes, str path) {
    for (uint32_t i = 0; i < scenes->count; i++)
        if (scenes->items[i]->loaded && scenes->items[i]->session.state == SESSION_LOADED &&
            lsp_scene_has_file(scenes->items[i], path))
            return scenes->items[i];
    return NULL;
}
