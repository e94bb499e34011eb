// Variables of copies and parameters of objects come into reach of expressions, and leave it.
#include "parser/stages/objects.h"

#include "grammar/ir_walk.h"

#include <string.h>

struct copied_list *copies_list(const struct evaluation *e, const struct schema_row *row) {
    return &e->copying->lists[row - SCHEMA_SCENE.rows];
}

void copies_list_pool(struct evaluation *e, const struct schema_row *row) {
    struct copied_list *pool = copies_list(e, row);
    if (pool->is_replaced)
        return;
    pool->own = ir_walk_list(row, e->scene).count;
    pool->is_replaced = ARENA_ARRAY(&e->loader->scratch, bool, pool->own + 1);
    pool->used = ARENA_ARRAY(&e->loader->scratch, struct used_names, pool->own + 1);
}

struct copy_entry *copies_entry(const struct evaluation *e, const struct schema_row *row,
                                const struct ir_copy *copy) {
    if (!copy->instance)
        return copies_list(e, row)->entries[copy->entry];
    const struct schema_row *instances = ir_walk_pool(&SCHEMA_INSTANCE);
    const struct copy_entry *instance =
        copies_entry(e, instances, &copies_list(e, instances)->made[copy->instance - 1]);
    const struct schema_row *list = ir_walk_list_of(&SCHEMA_OBJECT, row->child);
    return instance->object->entries[list - SCHEMA_OBJECT.rows][copy->entry];
}

bool copies_set(struct evaluation *e, const struct copy_entry *entry, uint32_t variable, uint32_t place) {
    const struct entry_variable *v = &entry->variables[variable];
    double *value = e->values + (size_t)EXPRESSION_WIDTH * (e->count + e->base + variable);
    if (v->is_list)
        return computed_value(
            e, &v->values[place],
            ir_place_value(&e->loader->output->origin, &v->ir->head, &SCHEMA_VARIABLE, "values"), value);
    *value = place;
    return true;
}

void copies_leave(struct evaluation *e) {
    e->entry = NULL;
    e->variable_count = e->base;
}

void copies_leave_all(struct evaluation *e) {
    e->base = e->base_of = 0;
    copies_leave(e);
}

void objects_reach(struct evaluation *e, const struct object *object) {
    copies_leave_all(e);
    if (!object)
        return;
    e->base = e->variable_count = object->reach;
    for (uint32_t i = 0; i < object->reach; i++) {
        e->names[e->count + i] = object->names[i];
        e->variables[i] = object->types[i];
    }
}

static void put_names(struct evaluation *e, const struct copy_entry *entry) {
    e->entry = entry;
    e->variable_count = e->base + entry->variable_count;
    for (uint32_t i = 0; i < entry->variable_count; i++) {
        e->variables[e->base + i] = entry->types[i];
        e->names[e->count + e->base + i] = entry->variables[i].ir->name;
    }
}

void copies_enter_types(struct evaluation *e, const struct copy_entry *entry) {
    objects_reach(e, entry->in);
    put_names(e, entry);
    for (uint32_t i = e->base; i < e->variable_count && !entry->is_good; i++)
        e->variables[i].is_bad = true;
}

// ---- parameters of objects, with the values that they have in an instance

static bool give(struct evaluation *e, struct object *object, uint32_t number, const double *given) {
    struct parameter *p = &object->parameters[number];
    double *value = e->values + (size_t)EXPRESSION_WIDTH * (e->count + object->outer + number);
    const span at = ir_place_value(&e->loader->output->origin, &p->ir->head, &SCHEMA_PARAMETER, "value");
    if (given) {
        memcpy(value, given, EXPRESSION_WIDTH * sizeof *value);
        return true;
    }
    return computed_value(e, &p->value, at, value) && parameter_is_in_bounds(e, p, *value, at);
}

// What the instance gives is computed from what the instance sees, before the object's names take its place.
static bool compute_given(struct evaluation *e, const struct copy_entry *entry, double *values) {
    const struct object *object = entry->object;
    for (uint32_t i = 0; i < object->ir->parameters.count; i++) {
        const struct ir_with *ir = entry->given[i].ir;
        double *value = values + (size_t)EXPRESSION_WIDTH * i;
        if (!ir)
            continue;
        const span at = ir_place_value(&e->loader->output->origin, &ir->head, &SCHEMA_WITH, "value");
        if (!computed_value(e, &entry->given[i].value, at, value) ||
            !parameter_is_in_bounds(e, &object->parameters[i], *value, at))
            return false;
    }
    return true;
}

// The names that the entries of an instance's object see come into reach, with their values. `instance`: 1 +
// that of the scene. false: a parameter has no value (reported).
static bool enter(struct evaluation *e, uint32_t instance) {
    const struct schema_row *row = ir_walk_pool(&SCHEMA_INSTANCE);
    const struct ir_copy *copy = &copies_list(e, row)->made[instance - 1];
    const struct copy_entry *entry = copies_entry(e, row, copy);
    struct object *object = entry->object;
    double values[REACH_MOST * EXPRESSION_WIDTH];
    if (!copies_enter_again(e, entry, copy->places, copy->instance) || !compute_given(e, entry, values))
        return false;
    objects_reach(e, object);
    for (uint32_t i = 0; i < object->ordered; i++) // messages give the values that are known
        e->variables[object->outer + object->order[i]].is_bad = true;
    for (uint32_t i = 0; i < object->ordered; i++) {
        const uint32_t number = object->order[i];
        if (!give(e, object, number,
                  entry->given[number].ir ? values + (size_t)EXPRESSION_WIDTH * number : NULL))
            return false;
        e->variables[object->outer + number].is_bad = false;
    }
    e->base_of = instance;
    return true;
}

// ---- entries

bool copies_enter_again(struct evaluation *e, const struct copy_entry *entry, uint32_t places,
                        uint32_t instance) {
    if (!entry || !instance) {
        if (e->base)
            copies_leave_all(e);
        if (!entry) {
            copies_leave(e);
            return true;
        }
    } else if (e->base_of != instance && !enter(e, instance)) {
        e->base_of = 0;
        return false;
    }
    if (e->entry != entry || e->variable_count != e->base + entry->variable_count)
        put_names(e, entry);
    for (uint32_t i = 0; places && i < entry->variable_count; i++)
        copies_set(e, entry, i, e->copying->places[places + 1 + i]);
    e->places = places;
    e->instance = instance;
    return true;
}

bool copies_enter(struct evaluation *e, const struct schema_row *row, uint32_t index) {
    const struct copied_list *list = e->copying ? copies_list(e, row) : NULL;
    if (!list || (!list->made && !list->is_replaced))
        return true;
    if (list->made) {
        const struct ir_copy *copy = &list->made[index];
        return copies_enter_again(e, copies_entry(e, row, copy), copy->places, copy->instance);
    }
    copies_leave_all(e);
    if (index < list->own)
        return !list->is_replaced[index];
    const struct copy_clone *clone = &list->clones[index - list->own];
    return copies_enter_again(e, clone->entry, clone->places, clone->instance);
}

bool copies_is_of(const struct evaluation *e, const struct schema_row *row, uint32_t index,
                  const void *entry) {
    const struct ir_copy *copy = &copies_list(e, row)->made[index];
    return copy->instance && copies_entry(e, row, copy)->memory == entry;
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
