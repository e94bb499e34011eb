// The scene's lists get what was made, still with its formulas; what is in place in copies is cloned where it
// differs.
#include "parser/stages/objects.h"

#include "core/heap.h"
#include "parser/bind/visit.h"

#include <string.h>

static uint32_t number_of(const struct schema_row *row) {
    return (uint32_t)(row - SCHEMA_SCENE.rows);
}

// ---- materials and meshes in place

static uint32_t push_clone(struct evaluation *e, const struct schema_row *row, const void *item) {
    struct copied_list *pool = copies_list(e, row);
    struct arena *arena = e->loader->input->arena;
    void *copy = arena_alloc(arena, row->child->size);
    memcpy(copy, item, row->child->size);
    merge_clone_lists(arena, row->child, copy);
    if (pool->clone_count == pool->clone_capacity)
        pool->clones = arena_regrow(&e->loader->scratch, pool->clones, pool->clone_count,
                                    &pool->clone_capacity, sizeof *pool->clones);
    pool->clones[pool->clone_count++] = (struct copy_clone){e->entry, e->places, e->instance};
    return ir_walk_append(arena, row, e->scene, copy);
}

// The names in reach, here and in all that is in it, that something in place depends on.
static const struct used_names *used_by(struct evaluation *e, const struct schema_row *pool, uint32_t index,
                                        const void *item) {
    struct used_names *used = &copies_list(e, pool)->used[index];
    if (used->is_known)
        return used;
    bool *is_used = ARENA_ARRAY(&e->loader->scratch, bool, (size_t)e->variable_count + 1);
    copies_mark_used(e, pool->child, item, is_used);
    used->items = ARENA_ARRAY(&e->loader->scratch, uint16_t, (size_t)e->variable_count + 1);
    for (uint32_t i = 0; i < e->variable_count; i++)
        if (is_used[i])
            used->items[used->count++] = (uint16_t)i;
    used->is_known = true;
    return used;
}

// What makes one clone another: the values of the names that it depends on; of those that move, whose they
// are.
static str key_of(struct evaluation *e, const struct schema_row *pool, uint32_t index,
                  const struct used_names *used) {
    const size_t bytes = EXPRESSION_WIDTH * sizeof(double);
    const uint32_t head[2] = {number_of(pool), index};
    char *key = arena_alloc(&e->loader->scratch, sizeof head + heap_times(used->count, bytes));
    memcpy(key, head, sizeof head);
    for (uint32_t i = 0; i < used->count; i++) {
        char *at = key + sizeof head + i * bytes;
        const uint32_t slot = used->items[i];
        double value[EXPRESSION_WIDTH] = {0};
        if (!e->variables[slot].moves)
            memcpy(value, e->values + (size_t)EXPRESSION_WIDTH * (e->count + slot),
                   (e->variables[slot].type == EXPRESSION_TRIPLE ? EXPRESSION_WIDTH : 1) * sizeof *value);
        else if (slot >= e->base)
            value[0] = e->copying->places[e->places + 1 + slot - e->base], value[1] = e->instance;
        else
            value[1] = e->instance;
        memcpy(at, value, bytes);
    }
    return (str){key, sizeof head + used->count * bytes};
}

// Copies that give the names in it the same values share what is in place.
static void clone_in_place(void *context, struct visit_place place, struct ir_reference *reference) {
    struct evaluation *e = context;
    const struct schema_row *row = &place.schema->rows[place.row];
    if (!ir_walk_is_inline(e->scene, row, reference) || row->child == &SCHEMA_OBJECT)
        return;
    const struct schema_row *pool = ir_walk_pool(row->child);
    const void *item = ir_walk_referent(e->scene, row, reference);
    copies_list_pool(e, pool);
    const struct used_names *used = used_by(e, pool, reference->index, item);
    if (!used->count)
        return;
    copies_list(e, pool)->is_replaced[reference->index] = true;
    const str key = key_of(e, pool, reference->index, used);
    uint32_t number = str_map_find(&e->copying->cloned, key);
    if (number == 0) {
        number = push_clone(e, pool, item) + 1;
        *str_map_at(&e->copying->cloned, key) = number;
    }
    reference->index = number - 1;
}

static bool has_lists(const struct schema_element *schema, const void *memory) {
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (ir_walk_list(&schema->rows[i], memory).count)
            return true;
    return false;
}

// ---- the scene's list

// The whole name: chairs[3]/back[0].
static void name_copy(struct evaluation *e, const struct schema_row *row, void *item,
                      const struct ir_copy *copy) {
    const int name_row = visit_name_row(row->child);
    str *name = name_row < 0 ? NULL : schema_field(&row->child->rows[name_row], item);
    if (!name || !name->len || !(copy->places || copy->instance))
        return;
    struct strbuf text;
    strbuf_init(&text);
    if (copy->instance) {
        ir_copies_instance_name(e->loader->output->origin.copies, copy->instance - 1, &text);
        strbuf_cstr(&text, "/");
    }
    strbuf_str(&text, *name);
    const uint32_t *at = e->copying->places + copy->places;
    for (uint32_t i = 0; copy->places && i < at[0]; i++)
        strbuf_format(&text, "[%u]", at[1 + i]);
    *name = arena_copy(e->loader->input->arena, strbuf_view(&text));
    strbuf_finish(&text);
}

// A body without a material has that of the instance around it; an instance hands on that of the one around
// it.
static void inherit_material(const struct evaluation *e, const struct schema_row *row, void *item,
                             uint32_t instance) {
    const int number = schema_find_row(row->child, STR("material"));
    struct ir_head *head = item;
    if (number < 0 || ((head->written | head->poisoned) & bind_bit((uint32_t)number)))
        return;
    const struct ir_instance *around = &e->scene->instances.items[instance - 1];
    *(struct ir_reference *)schema_field(&row->child->rows[number], item) = around->material;
    if (around->material.index != IR_NO_INDEX)
        head->written |= bind_bit((uint32_t)number);
}

static const void *source_of(const struct evaluation *e, const struct schema_row *row,
                             struct ir_any_list written, const struct ir_copy *copy) {
    return copy->instance ? copies_entry(e, row, copy)->memory : ir_walk_item(row, written, copy->entry);
}

static void fill_item(struct evaluation *e, const struct schema_row *row, void *item,
                      const struct ir_copy *copy) {
    const struct copy_entry *entry = copies_entry(e, row, copy);
    if (!entry)
        return;
    copies_clear_rows(row->child, item);
    if (row->child == &SCHEMA_INSTANCE) // given, when what it shows was made
        ((struct ir_instance *)item)->with = (struct ir_withs){0};
    name_copy(e, row, item, copy);
    if (entry->variable_count || copy->instance) {
        if (has_lists(row->child, item))
            merge_clone_lists(e->loader->input->arena, row->child, item);
        if (copies_enter_again(e, entry, copy->places, copy->instance))
            visit_references(row->child, item, clone_in_place, e);
    }
    if (copy->instance)
        inherit_material(e, row, item, copy->instance);
    // What it shows is in the scene now.
    if (row->child == &SCHEMA_INSTANCE)
        ((struct ir_instance *)item)->object = (struct ir_reference){.index = IR_NO_INDEX};
}

static void fill(struct evaluation *e, const struct schema_row *row, struct copied_list *list) {
    struct arena *arena = e->loader->input->arena;
    const struct ir_any_list written = ir_walk_list(row, e->scene);
    struct ir_any_list made = {
        .items = arena_alloc(arena, heap_times(list->count ? list->count : 1, row->child->size)),
        .count = list->count,
        .capacity = list->count};
    for (uint32_t i = 0; i < made.count; i++)
        memcpy(ir_walk_item(row, made, i), source_of(e, row, written, &list->made[i]), row->child->size);
    memcpy(schema_field(row, e->scene), &made, sizeof made);
    for (uint32_t i = 0; i < made.count; i++)
        fill_item(e, row, ir_walk_item(row, made, i), &list->made[i]);
    e->scene->head.written &= ~bind_bit(number_of(row)); // an empty list is left out
    e->scene->head.written |= made.count ? bind_bit(number_of(row)) : 0;
    copies_leave_all(e);
}

void copies_fill(struct evaluation *e) {
    const struct schema_row *instances = ir_walk_pool(&SCHEMA_INSTANCE);
    // First what others have their names and materials from.
    if (copies_list(e, instances)->made)
        fill(e, instances, copies_list(e, instances));
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        if (copies_may(row) && row != instances && copies_list(e, row)->made)
            fill(e, row, copies_list(e, row));
    }
    e->scene->objects = (struct ir_objects){0};
}
