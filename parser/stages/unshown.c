// Objects that nothing shows are judged as well, with the values that their parameters have by themselves: in
// a scene beside the loaded one, which has an instance of each and nothing else that can be seen.
#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_copy.h"
#include "grammar/ir_walk.h"
#include "parser/bind/bind.h"
#include "parser/stages/evaluate.h"

#include <string.h>

// What objects may depend on stays.
static bool is_of_objects(const struct schema_row *row) {
    return row->child != &SCHEMA_CAMERA && row->child != &SCHEMA_BACKGROUND &&
           row->child != &SCHEMA_ANIMATION && !copies_may(row);
}

static bool has_named(const struct ir_objects *objects) {
    for (uint32_t i = 0; i < objects->count; i++)
        if (objects->items[i].name.len)
            return true;
    return false;
}

struct ir_scene *unshown_begin(const struct loader *loader, const struct ir_scene *scene) {
    struct arena *arena = loader->input->arena;
    struct ir_scene few = {.copies = NULL};
    if (!loader->input->judges_objects || !has_named(&scene->objects))
        return NULL;
    schema_init(&SCHEMA_SCENE, &few);
    few.head = scene->head;
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        if (is_of_objects(row))
            memcpy(schema_field(row, &few), schema_field_const(row, scene), row->size);
        else
            few.head.written &= ~bind_bit(i);
    }
    few.formulas = ir_formulas_copy(scene->formulas, arena);
    return ir_copy(&few, arena);
}

static void mark_shown(const struct ir_object *object, bool *is_shown) {
    const int row = schema_find_row(&SCHEMA_INSTANCE, STR("if"));
    for (uint32_t i = 0; i < object->instances.count; i++) {
        const struct ir_instance *instance = &object->instances.items[i];
        const bool is_made = instance->copies.count == 0 && !(instance->head.written >> row & 1);
        if (is_made && instance->object.index != IR_NO_INDEX)
            is_shown[instance->object.index] = true;
    }
}

static void keep_in_place(const struct ir_objects *objects, const struct ir_object *object, bool *is_kept) {
    for (uint32_t i = 0; i < object->instances.count; i++) {
        const uint32_t index = object->instances.items[i].object.index;
        if (index == IR_NO_INDEX || objects->items[index].name.len)
            continue;
        is_kept[index] = true;
        keep_in_place(objects, &objects->items[index], is_kept);
    }
}

// What is in place in instances of the scene is gone with them.
static void clear_in_place(struct ir_objects *objects, struct arena *scratch) {
    bool *is_kept = ARENA_ARRAY(scratch, bool, objects->count);
    for (uint32_t i = 0; i < objects->count; i++)
        if (objects->items[i].name.len)
            keep_in_place(objects, &objects->items[i], is_kept);
    for (uint32_t i = 0; i < objects->count; i++)
        if (!objects->items[i].name.len && !is_kept[i])
            objects->items[i] = (struct ir_object){.name = STR("")};
}

// An instance of each that nothing shows; those that these show are shown with them.
static void add_instances(struct loader *loader, struct ir_scene *scene, const struct ir_copies *copies) {
    const struct ir_objects *objects = &scene->objects;
    const struct ir_shown *shown = copies->objects.items; // of those with names
    bool *is_shown = ARENA_ARRAY(&loader->scratch, bool, objects->count);
    for (uint32_t i = 0, named = 0; i < objects->count; i++)
        if (!objects->items[i].name.len || shown[named++].instances == 0)
            mark_shown(&objects->items[i], is_shown);
    for (uint32_t i = 0, named = 0; i < objects->count; i++) {
        const struct ir_object *object = &objects->items[i];
        if (!object->name.len || shown[named++].instances || is_shown[i])
            continue;
        struct ir_instance *instance = ARENA_PUSH(loader->input->arena, &scene->instances);
        schema_init(&SCHEMA_INSTANCE, instance);
        instance->head.origin = object->head.origin;
        instance->name = object->name;
        instance->object = (struct ir_reference){.index = i};
    }
}

void unshown_judge(struct loader *loader, struct ir_scene *scene) {
    struct parser_output *real = loader->output;
    struct parser_output *beside = ARENA_NEW(loader->input->arena, struct parser_output);
    if (!real->scene->copies)
        return;
    clear_in_place(&scene->objects, &loader->scratch);
    add_instances(loader, scene, real->scene->copies);
    if (!scene->instances.count)
        return;
    *beside = *real;
    beside->scene = scene;
    beside->origin.copies = NULL;
    beside->origin.formulas = scene->formulas;
    loader->output = beside;
    loader->is_beside = true;
    loader->input->sink->settled = loader->input->sink->count; // it is said again
    merge_compact(loader, scene);
    animate_scene(loader, scene);
    merge_compact(loader, scene);
    validate_scene(loader, scene);
    loader->is_beside = false;
    loader->output = real;
    real->unshown = beside;
}
