// Lists of the IR without knowing their item type: {items, count, capacity}.
#include "parser/bind/bind.h"

#include "grammar/ir.h"
#include "grammar/ir_formula.h"

#include <assert.h>
#include <string.h>

// The layout that all lists of the IR share; copied in and out, since each list has its own type.
struct any_list {
    void *items;
    uint32_t count, capacity;
};
static_assert(sizeof(struct any_list) == sizeof(struct ir_lights), "lists of the IR have one layout");

uint32_t bind_list_push(struct arena *arena, void *field, const void *item, uint32_t size) {
    struct any_list list;
    memcpy(&list, field, sizeof list);
    list.items = arena_regrow(arena, list.items, list.count, &list.capacity, size);
    memcpy((char *)list.items + (size_t)list.count * size, item, size);
    list.count++;
    memcpy(field, &list, sizeof list);
    return list.count - 1;
}

void *bind_list_item(void *field, uint32_t index, uint32_t size) {
    struct any_list list;
    memcpy(&list, field, sizeof list);
    assert(index < list.count);
    return (char *)list.items + (size_t)index * size;
}

uint32_t bind_list_count(const void *field) {
    struct any_list list;
    memcpy(&list, field, sizeof list);
    return list.count;
}

void bind_list_give_back(struct arena *arena, void *field, uint32_t size) {
    struct any_list list;
    memcpy(&list, field, sizeof list);
    arena_give_back(arena, list.items, list.capacity, size);
    memset(field, 0, sizeof list);
}

void bind_list_remove(void *field, uint32_t index, uint32_t size) {
    struct any_list list;
    memcpy(&list, field, sizeof list);
    assert(index < list.count);
    char *at = (char *)list.items + (size_t)index * size;
    memmove(at, at + size, (size_t)(list.count - index - 1) * size);
    list.count--;
    memcpy(field, &list, sizeof list);
}

void bind_list_cut(void *field, uint32_t count) {
    struct any_list list;
    memcpy(&list, field, sizeof list);
    assert(count <= list.count);
    list.count = count;
    memcpy(field, &list, sizeof list);
}

void bind_clear_row(struct arena *scratch, struct ir_origin *origin, const struct schema_element *schema,
                    void *memory, uint32_t row) {
    const struct schema_row *r = &schema->rows[row];
    char *defaults = arena_alloc(scratch, schema->size);
    schema_init(schema, defaults);
    size_t size = (size_t)r->size * (r->many == SCHEMA_FIXED ? r->fixed_count : 1);
    memcpy(schema_field(r, memory), defaults + r->offset, size);
    struct ir_head *head = memory;
    head->written &= ~bind_bit(row);
    head->poisoned &= ~bind_bit(row);
    ir_formula_drop(origin->arena, origin->formulas, head, r, -1, IR_FORMULA_WHOLE);
    ir_origin_remove_row(origin, head->origin, row);
}

uint32_t bind_home_row(const struct schema_element *schema) {
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++)
        if (SCHEMA_SCENE.rows[i].kind == SCHEMA_LIST && SCHEMA_SCENE.rows[i].child == schema)
            return i;
    assert(!"a reference's child has a list in the scene");
    return 0;
}
