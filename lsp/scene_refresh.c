// Keeps the scenes up to date with the open documents: loads them, and decides which are needed.
#include "grammar/schema.h"
#include "lsp/locate.h"
#include "lsp/position.h"
#include "lsp/scene.h"

#include "core/strbuf.h"
#include "grammar/ir.h"
#include "grammar/ir_values.h"
#include "grammar/ir_walk.h"
#include "load/check.h"

#include <stdlib.h>
#include <string.h>

enum {
    ROUNDS_MOST = 4, // until every document has its scene: what one load finds may need another
};
// If the rules about light take longer, they wait until nobody types.
#define LINT_SECONDS_QUICK 0.1

// ---- loading

static bool has_syntax_error(const struct session *session) {
    for (uint32_t i = 0; i < session->sink.count; i++)
        if (strncmp(diag_info(session->sink.items[i].code)->code, "E1", 2) == 0)
            return true;
    return false;
}

// What instances may give each object.
static json_t *list_arguments(const struct ir_objects *objects) {
    json_t *all = json_object();
    for (uint32_t i = 0; i < objects->count; i++) {
        const struct ir_object *object = &objects->items[i];
        json_t *list = json_array();
        for (uint32_t k = 0; k < object->parameters.count; k++) {
            const struct ir_parameter *p = &object->parameters.items[k];
            struct strbuf value;
            strbuf_init(&value);
            ir_values_yaml(&value, p->value, false);
            json_array_append_new(list, json_pack("{s:o, s:o, s:o}", "name", position_string(p->name),
                                                  "value", position_string(strbuf_view(&value)), "doc",
                                                  position_string(p->description)));
            strbuf_finish(&value);
        }
        json_t *name = position_string(object->name);
        json_object_set_new(all, json_string_value(name), list);
        json_decref(name);
    }
    return all;
}

// Text is seldom complete while the user types; names that it had a moment ago are still the likely ones.
static void note_names(struct lsp_scene *scene) {
    if (!scene->session.scene || has_syntax_error(&scene->session))
        return;
    json_decref(scene->names);
    json_decref(scene->arguments);
    scene->names = json_object();
    scene->arguments = list_arguments(&locate_scene(&scene->session)->objects);
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        struct ir_any_list list = ir_walk_list(row, locate_scene(&scene->session));
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
    scene->lacks_pixels = scene->session.assets.pixels_skipped;
    if (!options->skip_lint)
        scene->lint_seconds = scene->session.lint_seconds;
}

static void load(struct scenes *scenes, struct lsp_scene *scene, enum scenes_effort effort) {
    struct file_overlay *overlays = scenes_overlays(scenes);
    struct session_options options = scenes->settings;
    options.path = scene->path;
    options.keeps_written = true;
    options.pixels = effort == SCENES_QUICK ? ASSETS_SKIP_PIXELS : ASSETS_CHECK_PIXELS;
    options.skip_lint = effort == SCENES_QUICK && scene->lint_seconds > LINT_SECONDS_QUICK;
    options.overlays = overlays;
    options.overlay_count = overlays ? scenes->documents->count : 0;
    lsp_scene_unload(scene);
    if (scenes_is_settings(scene->path))
        session_load_settings(&scene->session, &options);
    else
        load_scene(scene, &options, scenes->store);
    // The session owns the text now.
    scene->session.options.overlays = NULL;
    scene->session.options.overlay_count = 0;
    free(overlays);
    scene->loaded = true;
    scene->is_stale = false;
    scene->is_fresh = true;
}

// ---- keeping up to date

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

// Adds a scene for every document that needs one; returns whether any was missing.
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
        scenes_forget(scenes, scenes->items[i - 1]);
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
            if (scene->is_stale || (effort == SCENES_WHOLE && lsp_scene_lacks(scene)))
                load(scenes, scene, effort);
            changed |= scene->is_fresh;
            scene->is_fresh = false;
        }
        changed |= forget_unwanted(scenes);
        added = add_missing(scenes);
    }
    return changed;
}
