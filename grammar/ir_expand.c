#include "grammar/ir_expand.h"

#include "core/arena.h"
#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

#include <string.h>

// Names are unique in their object, and whole names begin with those around them.
static void shorten_name(const struct schema_element *schema, void *item) {
    const int row = schema_find_row(schema, STR("name"));
    str *name = row < 0 ? NULL : schema_field(&schema->rows[row], item);
    if (!name)
        return;
    for (size_t i = name->len; i > 0; i--)
        if (name->ptr[i - 1] == '/') {
            *name = str_slice(*name, i, name->len);
            return;
        }
}

static void put_into_object(struct ir_scene *scene, const struct schema_row *row, const void *item,
                            uint32_t instance, struct arena *arena) {
    struct ir_object *object = &scene->objects.items[instance - 1];
    const struct schema_row *list = ir_walk_list_of(&SCHEMA_OBJECT, row->child);
    const uint32_t number = (uint32_t)(list - SCHEMA_OBJECT.rows);
    ir_walk_append(arena, list, object, item);
    object->head.written |= UINT64_C(1) << number;
}

static void move_list(struct ir_scene *scene, const struct schema_row *row, struct arena *arena) {
    const struct ir_any_list all = ir_walk_list(row, scene);
    const struct ir_any_list none = {0};
    memcpy(schema_field(row, scene), &none, sizeof none);
    for (uint32_t i = 0; i < all.count; i++) {
        void *item = ir_walk_item(row, all, i);
        const uint32_t instance = ir_copies_instance(scene->copies, row, i);
        shorten_name(row->child, item);
        if (instance)
            put_into_object(scene, row, item, instance, arena);
        else
            ir_walk_append(arena, row, scene, item);
    }
}

// Each shows an object of its own; what it gave to bodies without a material they have.
static void show_objects(struct ir_scene *scene) {
    const uint64_t object = UINT64_C(1) << schema_find_row(&SCHEMA_INSTANCE, STR("object"));
    const uint64_t gone = UINT64_C(1) << schema_find_row(&SCHEMA_INSTANCE, STR("material")) |
                          UINT64_C(1) << schema_find_row(&SCHEMA_INSTANCE, STR("with"));
    for (uint32_t i = 0; i < scene->instances.count; i++) {
        struct ir_instance *instance = &scene->instances.items[i];
        instance->object = (struct ir_reference){.index = i};
        instance->material = (struct ir_reference){.index = IR_NO_INDEX};
        instance->with = (struct ir_withs){0};
        instance->head.written = (instance->head.written | object) & ~gone;
    }
}

void ir_expand_instances(struct ir_scene *scene, struct arena *arena) {
    if (!scene->copies || !scene->instances.count)
        return;
    scene->objects.items = ARENA_ARRAY(arena, struct ir_object, scene->instances.count);
    scene->objects.count = scene->objects.capacity = scene->instances.count;
    for (uint32_t i = 0; i < scene->objects.count; i++)
        schema_init(&SCHEMA_OBJECT, &scene->objects.items[i]);
    show_objects(scene);
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        if (row->kind == SCHEMA_LIST && row->child != &SCHEMA_PARAMETER &&
            ir_walk_list_of(&SCHEMA_OBJECT, row->child))
            move_list(scene, row, arena);
    }
    scene->copies = NULL;
}

bool ir_moves(const struct ir_scene *scene) {
    bool moves = scene->animation.tracks.count > 0;
    for (uint32_t i = 0; scene->formulas && i < scene->formulas->count && !moves; i++)
        moves = scene->formulas->items[i].moves;
    const uint32_t row = (uint32_t)schema_find_row(&SCHEMA_SCENE, STR("animation"));
    return moves && ir_walk_written(&SCHEMA_SCENE, row, scene);
}

static void keep_what_moves(struct ir_scene *scene, struct arena *arena) {
    for (uint32_t i = 0; scene->formulas && i < scene->formulas->count; i++)
        if (!scene->formulas->items[i].moves)
            scene->formulas->items[i].row = NULL; // of no value
    for (uint32_t i = 0; i < scene->parameters.count; i++) {
        const struct ir_result *result = &scene->formulas->results[i];
        if (!result->moves)
            scene->parameters.items[i].value = ir_result_text(result, arena);
    }
}

void ir_expand(struct ir_scene *scene, struct arena *arena) {
    if (ir_moves(scene)) {
        keep_what_moves(scene, arena);
    } else {
        scene->formulas = NULL;
        scene->parameters.count = 0;
    }
    ir_expand_instances(scene, arena);
}
