#include "grammar/ir_copy.h"

#include "core/heap.h"
#include "grammar/ir.h"
#include "grammar/ir_formula.h"
#include "grammar/ir_origin.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

#include <string.h>

static void *copy_items(struct arena *arena, const void *items, uint32_t count, size_t size) {
    if (count == 0)
        return NULL;
    void *copy = arena_alloc(arena, heap_times(count, size));
    memcpy(copy, items, count * size);
    return copy;
}

static bool has_lists(const struct schema_element *schema) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (row->kind == SCHEMA_LIST || (row->kind == SCHEMA_ELEMENT && has_lists(row->child)))
            return true;
    }
    return false;
}

// The lists inside an element that is a copy already.
static void copy_lists(struct arena *arena, const struct schema_element *schema, void *element) {
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        void *field = schema_field(row, element);
        if (row->kind == SCHEMA_ELEMENT)
            copy_lists(arena, row->child, field);
        if (row->kind != SCHEMA_LIST)
            continue;
        struct ir_any_list list = ir_walk_list(row, element);
        list.items = copy_items(arena, list.items, list.count, row->child->size);
        list.capacity = list.count;
        memcpy(field, &list, sizeof list);
        for (uint32_t k = 0; k < list.count && has_lists(row->child); k++)
            copy_lists(arena, row->child, ir_walk_item(row, list, k));
    }
}

struct ir_scene *ir_copy(const struct ir_scene *scene, struct arena *arena) {
    struct ir_scene *copy = copy_items(arena, scene, 1, sizeof *scene);
    copy_lists(arena, &SCHEMA_SCENE, copy);
    return copy;
}

#define COPY_LIST(name)                                                                                      \
    (out->name.items = copy_items(arena, from->name.items, from->name.count, sizeof *from->name.items),      \
     out->name.capacity = from->name.count)

void ir_origin_copy(const struct ir_origin *from, struct arena *arena, struct ir_origin *out) {
    *out = *from;
    out->arena = arena;
    out->formulas = ir_formulas_copy(from->formulas, arena);
    COPY_LIST(elements);
    COPY_LIST(rows);
    COPY_LIST(files);
    COPY_LIST(directives);
}
