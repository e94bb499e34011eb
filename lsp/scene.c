#include "lsp/scene.h"

#include "core/heap.h"

#include <stdlib.h>
#include <string.h>

void scenes_init(struct scenes *scenes, struct documents *documents) {
    *scenes =
        (struct scenes){.store = asset_store_create(), .documents = documents, .limits = limits_default()};
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
    arena_finish(&scene->arena);
    free(scene);
}

void scenes_finish(struct scenes *scenes) {
    for (uint32_t i = 0; i < scenes->count; i++)
        destroy(scenes->items[i]);
    free(scenes->items);
    asset_store_destroy(scenes->store);
}

// Of a text that is no scene's, such as a mesh's or the settings', nothing is known.
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

// What the scene consists of; kept where the new text could not be read that far.
void lsp_scene_note_files(struct lsp_scene *scene, struct session *session) {
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
    lsp_scene_forget_files(scene);
    scene->files = files;
    scene->file_count = done;
}

struct file_overlay *scenes_overlays(const struct scenes *scenes) {
    struct documents *documents = scenes->documents;
    struct file_overlay *overlays = calloc(documents->count + 1, sizeof *overlays);
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

struct lsp_scene *scenes_add(struct scenes *scenes, str path) {
    struct lsp_scene *known = scenes_find(scenes, path);
    if (known)
        return known;
    struct lsp_scene **items = heap_grow(scenes->items, scenes->count, &scenes->capacity, sizeof *items);
    if (!items)
        return NULL;
    scenes->items = items;
    struct lsp_scene *volatile scene = calloc(1, sizeof *scene);
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

void scenes_forget(struct scenes *scenes, struct lsp_scene *scene) {
    for (uint32_t i = 0; i < scenes->count; i++)
        if (scenes->items[i] == scene)
            scenes->items[i] = scenes->items[--scenes->count];
    destroy(scene);
}

bool scenes_lack_lint(const struct scenes *scenes) {
    for (uint32_t i = 0; i < scenes->count; i++)
        if (scenes->items[i]->lacks_lint)
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
