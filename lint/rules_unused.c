// Things in the scene that nothing uses.
#include "diag/codes/rule.h"
#include "grammar/ir_walk.h"
#include "lint/lint_internal.h"

struct use {
    const struct schema_row *pool; // the scene's list of them
    bool *used;
};

static void use(void *context, const struct schema_row *row, const struct ir_reference *ref) {
    const struct use *use = context;
    if (ref->index != IR_NO_INDEX && ir_walk_pool(row->child) == use->pool)
        use->used[ref->index] = true;
}

// By index in the scene's list of this kind.
static bool *used(struct lint *lint, const struct schema_element *kind) {
    const struct schema_row *pool = ir_walk_pool(kind);
    struct use found = {pool, ARENA_ARRAY(lint->arena, bool, ir_walk_list(pool, lint->ir).count)};
    ir_walk_references(lint->ir, use, &found);
    return found.used;
}

// A library shared by files holds things that one file uses and another does not.
static bool is_of_main_file(const struct lint *lint, span at) {
    return lint->origin->files.count > 0 && at.source == lint->origin->files.items[0].source;
}

static void report_unused(struct lint *lint, const struct schema_element *kind, const char *help) {
    const bool *is_used = used(lint, kind);
    const struct schema_row *pool = ir_walk_pool(kind);
    const struct ir_any_list list = ir_walk_list(pool, lint->ir);
    for (uint32_t i = 0; i < list.count; i++) {
        const void *item = ir_walk_item(pool, list, i);
        span at = ir_place_label(lint->origin, ir_walk_head(item));
        if (is_used[i] || ir_walk_is_anonymous(kind, item) || !is_of_main_file(lint, at))
            continue;
        diag_add(lint->sink, DIAG_UNUSED_MATERIAL, at, "nothing uses %s '%.*s'", kind->name,
                 STR_ARG(ir_walk_key(kind, item)));
        diag_help(lint->sink, "%s", help);
    }
}

void lint_unused_material(struct lint *lint) {
    // A scene without bodies is itself a library.
    if (lint->body_count == 0)
        return;
    report_unused(lint, &SCHEMA_MATERIAL, "give it to a body, or remove it");
    report_unused(lint, &SCHEMA_MESH, "show it with a model, or remove it");
}

struct all_used {
    const bool *materials, *meshes;
};

static bool holds_used(const struct lint *lint, const struct ir_file_origin *file,
                       const struct schema_element *kind, const bool *is_used) {
    const struct schema_row *pool = ir_walk_pool(kind);
    const struct ir_any_list list = ir_walk_list(pool, lint->ir);
    for (uint32_t i = 0; i < list.count; i++)
        if (is_used[i] &&
            ir_place_label(lint->origin, ir_walk_head(ir_walk_item(pool, list, i))).source == file->source)
            return true;
    return false;
}

// Whether the file holds anything that shows: a used material or mesh, or anything other than those.
static bool adds_anything(const struct lint *lint, const struct ir_file_origin *file,
                          const struct all_used *used) {
    const struct ir_scene *own = file->scene;
    if (!own)
        return true;
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_element *kind = SCHEMA_SCENE.rows[i].child;
        if (kind && kind != &SCHEMA_MATERIAL && kind != &SCHEMA_MESH &&
            ir_walk_written(&SCHEMA_SCENE, i, own))
            return true;
    }
    return holds_used(lint, file, &SCHEMA_MATERIAL, used->materials) ||
           holds_used(lint, file, &SCHEMA_MESH, used->meshes);
}

void lint_unused_include(struct lint *lint) {
    if (lint->body_count == 0)
        return;
    const struct all_used all = {used(lint, &SCHEMA_MATERIAL), used(lint, &SCHEMA_MESH)};
    for (uint32_t i = 1; i < lint->origin->files.count; i++) {
        const struct ir_file_origin *file = &lint->origin->files.items[i];
        if (span_is_none(file->included_at) || adds_anything(lint, file, &all))
            continue;
        diag_add(lint->sink, DIAG_UNUSED_INCLUDE, file->included_at,
                 "nothing in this file is used: it adds no bodies, lights, cameras or settings%s",
                 file->scene->materials.count ? ", and no body uses one of its materials" : "");
        diag_help(lint->sink, "remove the include, or use a material of it");
    }
}
