// Things in the scene that nothing uses.
#include "diag/codes/rule.h"
#include "grammar/ir_walk.h"
#include "lint/lint_internal.h"

struct use {
    const struct schema_row *materials; // the scene's list of them
    bool *used;
};

static void use(void *context, const struct schema_row *row, const struct ir_material_ref *ref) {
    const struct use *use = context;
    if (ref->index != IR_NO_INDEX && ir_walk_pool(row->child) == use->materials)
        use->used[ref->index] = true;
}

static bool *used_materials(struct lint *lint) {
    struct use found = {ir_walk_pool(&SCHEMA_MATERIAL),
                        ARENA_ARRAY(lint->arena, bool, lint->ir->materials.count)};
    ir_walk_references(lint->ir, use, &found);
    return found.used;
}

// A library shared by files holds things that one file uses and another does not.
static bool is_of_main_file(const struct lint *lint, span at) {
    return lint->origin->files.count > 0 && at.source == lint->origin->files.items[0].source;
}

void lint_unused_material(struct lint *lint) {
    // A scene without bodies is itself a library.
    if (lint->body_count == 0)
        return;
    bool *used = used_materials(lint);
    for (uint32_t i = 0; i < lint->ir->materials.count; i++) {
        const struct ir_material *material = &lint->ir->materials.items[i];
        span at = ir_place_label(lint->origin, &material->head);
        if (used[i] || material->name.len == 0 || !is_of_main_file(lint, at))
            continue;
        diag_add(lint->sink, DIAG_UNUSED_MATERIAL, at, "nothing uses material '%.*s'",
                 STR_ARG(material->name));
        diag_help(lint->sink, "give it to a body, or remove it");
    }
}

// Whether the file holds anything that shows: a used material, or anything other than a material.
static bool adds_anything(const struct lint *lint, const struct ir_file_origin *file, const bool *used) {
    const struct ir_scene *own = file->scene;
    if (!own)
        return true;
    if (ir_body_count(own) || own->cameras.count || own->lights.count || own->includes.count ||
        own->image.head.written || own->trace.head.written || own->background.head.written)
        return true;
    for (uint32_t i = 0; i < lint->ir->materials.count; i++) {
        const struct ir_material *material = &lint->ir->materials.items[i];
        if (used[i] && ir_place_label(lint->origin, &material->head).source == file->source)
            return true;
    }
    return false;
}

void lint_unused_include(struct lint *lint) {
    if (lint->body_count == 0)
        return;
    bool *used = used_materials(lint);
    for (uint32_t i = 1; i < lint->origin->files.count; i++) {
        const struct ir_file_origin *file = &lint->origin->files.items[i];
        if (span_is_none(file->included_at) || adds_anything(lint, file, used))
            continue;
        diag_add(lint->sink, DIAG_UNUSED_INCLUDE, file->included_at,
                 "nothing in this file is used: it adds no bodies, lights, cameras or settings%s",
                 file->scene->materials.count ? ", and no body uses one of its materials" : "");
        diag_help(lint->sink, "remove the include, or use a material of it");
    }
}
