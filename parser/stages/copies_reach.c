// Variables of copies come into reach of expressions, and leave it.
#include "parser/stages/copies.h"

#include "grammar/ir_walk.h"

#include <string.h>

struct copied_list *copies_list(const struct evaluation *e, const struct schema_row *row) {
    return &e->copying->lists[row - SCHEMA_SCENE.rows];
}

bool copies_set(struct evaluation *e, const struct copy_entry *entry, uint32_t variable, uint32_t place) {
    const struct entry_variable *v = &entry->variables[variable];
    double *value = e->values + (size_t)EXPRESSION_WIDTH * (e->count + variable);
    if (v->is_list)
        return computed_value(
            e, &v->values[place],
            ir_place_value(&e->loader->output->origin, &v->ir->head, &SCHEMA_VARIABLE, "values"), value);
    *value = place;
    return true;
}

void copies_leave(struct evaluation *e) {
    e->entry = NULL;
    e->variable_count = 0;
}

void copies_enter_again(struct evaluation *e, const struct copy_entry *entry, uint32_t places) {
    if (!entry) {
        copies_leave(e);
        return;
    }
    if (e->entry != entry || e->variable_count != entry->variable_count) {
        e->entry = entry;
        e->variable_count = entry->variable_count;
        memcpy(e->variables, entry->types, sizeof e->variables);
        for (uint32_t i = 0; i < entry->variable_count; i++)
            e->names[e->count + i] = entry->variables[i].ir->name;
    }
    for (uint32_t i = 0; places && i < entry->variable_count; i++)
        copies_set(e, entry, i, e->copying->places[places + 1 + i]);
}

bool copies_enter(struct evaluation *e, const struct schema_row *row, uint32_t index) {
    const struct copied_list *list = e->copying ? copies_list(e, row) : NULL;
    if (!list || (!list->made && !list->is_replaced))
        return true;
    copies_leave(e);
    if (list->made) {
        const struct ir_copy *copy = &list->made[index];
        if (list->entries[copy->entry])
            copies_enter_again(e, list->entries[copy->entry], copy->places);
        e->places = copy->places;
        return true;
    }
    if (index < list->own)
        return !list->is_replaced[index];
    const struct copy_clone *clone = &list->clones[index - list->own];
    copies_enter_again(e, clone->entry, clone->places);
    e->places = clone->places;
    return true;
}

uint32_t copies_of(const struct evaluation *e, const struct schema_row *row, uint32_t entry,
                   uint32_t *count) {
    const struct copied_list *list = e && e->copying ? copies_list(e, row) : NULL;
    *count = 1;
    if (!list || !list->made)
        return entry;
    *count = list->first[entry + 1] - list->first[entry];
    return list->first[entry];
}
