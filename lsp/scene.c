#include "lsp/scene.h"

#include "app/check.h"
#include "core/heap.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

#include <stdlib.h>
#include <string.h>

enum {
    ROUNDS_MOST = 4, // until every document has its scene: what one load finds may need another
};
// Rules about light that take longer wait until no one types.
#define LINT_SECONDS_QUICK 0.1

void scenes_init(struct scenes *scenes, struct documents *documents) {
    *scenes =
        (struct scenes){.store = asset_store_create(), .documents = documents, .limits = limits_default()};
}

static void unload(struct lsp_scene *scene) {
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
    unload(scene);
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

// ---- loading

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

static bool has_syntax_error(const struct session *session) {
    for (uint32_t i = 0; i < session->sink.count; i++)
        if (strncmp(diag_info(session->sink.items[i].code)->code, "E1", 2) == 0)
            return true;
    return false;
}

// A text is seldom whole while one types; names that it had a moment ago are still the likely ones.
static void note_names(struct lsp_scene *scene) {
    if (!scene->session.scene || has_syntax_error(&scene->session))
        return;
    json_decref(scene->names);
    scene->names = json_object();
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        struct ir_any_list list = ir_walk_list(row, scene->session.scene);
        json_t *names = list.count ? json_array() : NULL;
        for (uint32_t k = 0; k < list.count; k++) {
            str name = ir_walk_key(row->child, ir_walk_item(row, list, k));
            if (name.len)
                json_array_append_new(names, json_stringn(name.ptr, name.len));
        }
        if (names)
            json_object_set_new(scene->names, row->child->name, names);
    }
}

static void load_scene(struct lsp_scene *scene, const struct session_options *options,
                       struct asset_store *store) {
    check_scene(&scene->session, options, store);
    if (scene->session.state == SESSION_LOADED)
        lsp_scene_note_files(scene, &scene->session);
    else if (scene->session.state != SESSION_NO_SCENE)
        lsp_scene_forget_files(scene);
    note_names(scene);
    scene->lacks_lint = options->skip_lint;
    if (!options->skip_lint)
        scene->lint_seconds = scene->session.lint_seconds;
}

static void load(struct scenes *scenes, struct lsp_scene *scene, enum scenes_effort effort) {
    struct file_overlay *overlays = scenes_overlays(scenes);
    struct session_options options = {.path = scene->path,
                                      .limits = scenes->limits,
                                      .skip_pixels = true,
                                      .skip_lint =
                                          effort == SCENES_QUICK && scene->lint_seconds > LINT_SECONDS_QUICK,
                                      .overlays = overlays,
                                      .overlay_count = overlays ? scenes->documents->count : 0};
    unload(scene);
    if (scenes_is_settings(scene->path))
        session_load_settings(&scene->session, &options);
    else
        load_scene(scene, &options, scenes->store);
    // The texts are the session's by now.
    scene->session.options.overlays = NULL;
    scene->session.options.overlay_count = 0;
    free(overlays);
    scene->loaded = true;
    scene->is_stale = false;
    scene->is_fresh = true;
}

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

static void forget(struct scenes *scenes, struct lsp_scene *scene) {
    for (uint32_t i = 0; i < scenes->count; i++)
        if (scenes->items[i] == scene)
            scenes->items[i] = scenes->items[--scenes->count];
    destroy(scene);
}

// ---- keeping up

static bool is_part_of_another(const struct scenes *scenes, str path) {
    for (uint32_t i = 0; i < scenes->count; i++) {
        const struct lsp_scene *scene = scenes->items[i];
        if (!str_equal(scene->path, path) && lsp_scene_has_file(scene, path))
            return true;
    }
    return false;
}

static void want_owners(struct scenes *scenes, str path) {
    bool owned = is_part_of_another(scenes, path);
    for (uint32_t i = 0; i < scenes->count; i++) {
        struct lsp_scene *scene = scenes->items[i];
        bool is_main = str_equal(scene->path, path);
        scene->is_wanted |= owned ? !is_main && lsp_scene_has_file(scene, path) : is_main;
    }
}

// Every document that is a scene gets one; whether there were some without.
static bool add_missing(struct scenes *scenes) {
    bool added = false;
    for (uint32_t i = 0; i < scenes->documents->count; i++) {
        struct document *document = &scenes->documents->items[i];
        bool settings = scenes_is_settings(document->path);
        if (!settings && !scenes_is_scene(document))
            continue;
        if (!settings)
            scenes_place(scenes, document);
        if (!is_part_of_another(scenes, document->path) && !scenes_find(scenes, document->path))
            added |= scenes_add(scenes, document->path) != NULL;
    }
    return added;
}

static bool forget_unwanted(struct scenes *scenes) {
    bool changed = false;
    for (uint32_t i = 0; i < scenes->count; i++)
        scenes->items[i]->is_wanted = false;
    for (uint32_t i = 0; i < scenes->documents->count; i++)
        want_owners(scenes, scenes->documents->items[i].path);
    for (uint32_t i = scenes->count; i > 0; i--) {
        if (scenes->items[i - 1]->is_wanted)
            continue;
        forget(scenes, scenes->items[i - 1]);
        changed = true;
    }
    return changed;
}

bool scenes_refresh(struct scenes *scenes, enum scenes_effort effort) {
    bool changed = false;
    bool added = add_missing(scenes);
    for (int round = 0; round == 0 || (added && round < ROUNDS_MOST); round++) {
        for (uint32_t i = 0; i < scenes->count; i++) {
            struct lsp_scene *scene = scenes->items[i];
            if (scene->is_stale || (effort == SCENES_WHOLE && scene->lacks_lint))
                load(scenes, scene, effort);
            changed |= scene->is_fresh;
            scene->is_fresh = false;
        }
        changed |= forget_unwanted(scenes);
        added = add_missing(scenes);
    }
    return changed;
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
