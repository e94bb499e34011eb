// Parameters of objects, and what instances give them.
#include "diag/codes/binding.h"
#include "diag/codes/reference.h"
#include "parser/stages/objects.h"

#include "parser/bind/say.h"
#include "parser/tree/mend.h"

static struct diag_sink *sink(const struct evaluation *e) {
    return e->loader->input->sink;
}

static span place_of(const struct evaluation *e, const struct ir_parameter *ir, const char *row) {
    return ir_place_value(&e->loader->output->origin, &ir->head, &SCHEMA_PARAMETER, row);
}

static span place_given(const struct evaluation *e, const struct ir_with *ir, const char *row) {
    return ir_place_value(&e->loader->output->origin, &ir->head, &SCHEMA_WITH, row);
}

static int find(const struct object *object, str name) {
    const struct ir_parameters *all = &object->ir->parameters;
    for (uint32_t i = 0; i < all->count; i++)
        if (str_equal(all->items[i].name, name))
            return (int)i;
    return -1;
}

// ---- types

static bool name_fits(const struct evaluation *e, const struct object *object, uint32_t i) {
    const str name = object->ir->parameters.items[i].name;
    const span at = place_of(e, &object->ir->parameters.items[i], "name");
    if (!evaluation_name_fits(e, name, at, "parameter"))
        return false;
    const int first = find(object, name);
    if (first >= 0 && (uint32_t)first < i) {
        diag_add(sink(e), DIAG_DUPLICATE_NAME, at, "two parameters of the object have the name '%.*s'",
                 STR_ARG(name));
        diag_note(sink(e), place_of(e, &object->ir->parameters.items[first], "name"),
                  "the first one is here");
        diag_help(sink(e), "rename one of the two");
        return false;
    }
    for (uint32_t k = 0; k < object->outer; k++)
        if (str_equal(object->names[k], name)) {
            diag_add(sink(e), DIAG_VARIABLE, at, "the parameter '%.*s' has the name of something around it",
                     STR_ARG(name));
            diag_help(sink(e), "rename one of the two");
            return false;
        }
    return true;
}

static void declare(struct evaluation *e, struct object *object, uint32_t i) {
    struct parameter *p = &object->parameters[i];
    struct copy_variable *type = &object->types[object->outer + i];
    const str what = arena_format(&e->loader->scratch, "parameter '%.*s'", STR_ARG(p->ir->name));
    const bool good = !p->ir->head.poisoned && name_fits(e, object, i) &&
                      computed_read(e, p->ir->value, what, place_of(e, p->ir, "value"), &p->value) &&
                      parameter_bounds_fit(e, p);
    p->state = good ? PARAMETER_DONE : PARAMETER_BAD;
    p->moves = good && p->value.moves;
    *type = (struct copy_variable){p->value.type, p->moves, !good, &p->is_used};
    object->names[object->outer + i] = p->ir->name;
    e->names[e->count + object->outer + i] = p->ir->name;
    e->variables[object->outer + i] = *type;
    if (good)
        object->order[object->ordered++] = i;
}

// Whether all of the object's parameters that it is computed from are declared. `on`: one that is not.
static bool is_next(const struct object *object, uint32_t i, uint32_t *on) {
    size_t at = 0;
    str name;
    while (expression_next_name(object->ir->parameters.items[i].value, &at, &name)) {
        const int other = find(object, name);
        if (other >= 0 && object->parameters[other].state == PARAMETER_NEW) {
            *on = (uint32_t)other;
            return false;
        }
    }
    return true;
}

// All that are left depend on each other, or on those that do.
static void report_ring(struct evaluation *e, struct object *object, uint32_t first) {
    uint32_t next = first;
    for (uint32_t i = 0; i < object->ir->parameters.count; i++) // ends within the ring
        is_next(object, next, &next);
    diag_add(sink(e), DIAG_PARAMETER_RING, place_of(e, object->parameters[next].ir, "value"),
             "parameter '%.*s' depends on itself", STR_ARG(object->parameters[next].ir->name));
    if (str_map_find(&e->by_name, object->parameters[next].ir->name))
        diag_help(
            sink(e),
            "in the object '%.*s' is this parameter, which hides the scene's: choose another name for it",
            STR_ARG(object->parameters[next].ir->name));
    else
        diag_help(sink(e), "give it a value of its own");
    for (uint32_t i = 0; i < object->ir->parameters.count; i++) {
        struct parameter *p = &object->parameters[i];
        if (p->state != PARAMETER_NEW)
            continue;
        p->state = PARAMETER_BAD;
        object->names[object->outer + i] = p->ir->name;
        object->types[object->outer + i].is_bad = true;
    }
}

static void declare_all(struct evaluation *e, struct object *object) {
    const uint32_t count = object->ir->parameters.count;
    bool any = true;
    while (any) {
        uint32_t left = count, on = 0;
        any = false;
        for (uint32_t i = 0; i < count; i++) {
            if (object->parameters[i].state != PARAMETER_NEW)
                continue;
            left = i;
            if (!is_next(object, i, &on))
                continue;
            declare(e, object, i);
            any = true;
        }
        if (!any && left < count)
            report_ring(e, object, left);
    }
}

bool objects_declare(struct evaluation *e, struct object *object) {
    struct arena *scratch = &e->loader->scratch;
    const struct ir_parameters *all = &object->ir->parameters;
    if (object->state != OBJECT_NEW)
        return object->reach <= REACH_MOST;
    object->state = OBJECT_DECLARED;
    copies_leave_all(e);
    if (object->owner)
        copies_enter_types(e, object->owner);
    object->outer = e->variable_count;
    object->reach = object->outer + all->count;
    if (object->reach > REACH_MOST) {
        diag_add(sink(e), DIAG_VARIABLE, place_of(e, &all->items[0], "name"),
                 "there are more than %d names of objects and 'for' here", REACH_MOST);
        return false;
    }
    object->parameters = ARENA_ARRAY(scratch, struct parameter, (size_t)all->count + 1);
    object->order = ARENA_ARRAY(scratch, uint32_t, (size_t)all->count + 1);
    object->names = ARENA_ARRAY(scratch, str, (size_t)object->reach + 1);
    object->types = ARENA_ARRAY(scratch, struct copy_variable, (size_t)object->reach + 1);
    for (uint32_t i = 0; i < object->outer; i++) {
        object->names[i] = e->names[e->count + i];
        object->types[i] = e->variables[i];
    }
    for (uint32_t i = 0; i < all->count; i++) {
        object->parameters[i] = (struct parameter){.ir = &all->items[i]};
        e->names[e->count + object->outer + i] = object->names[object->outer + i] = STR("");
        e->variables[object->outer + i] = (struct copy_variable){.is_bad = true};
    }
    e->variable_count = object->reach;
    e->base = object->reach;
    declare_all(e, object);
    return true;
}

// ---- what an instance gives

static void report_unknown(const struct evaluation *e, const struct object *object,
                           const struct ir_with *ir) {
    const span at = place_given(e, ir, "name");
    const struct ir_parameters *all = &object->ir->parameters;
    struct mend_search search = mend_begin(sink(e), &e->loader->scratch, ir->name);
    str list = STR("");
    for (uint32_t i = 0; i < all->count; i++) {
        mend_offer_str(&search, all->items[i].name, (int)i);
        list = arena_format(&e->loader->scratch, "%.*s%s%.*s", STR_ARG(list), i ? ", " : "",
                            STR_ARG(all->items[i].name));
    }
    diag_add(sink(e), DIAG_WITH, at, "the object '%.*s' has no parameter '%.*s'", STR_ARG(object->ir->name),
             STR_ARG(say_text(&e->loader->scratch, ir->name)));
    if (search.best) {
        diag_help(sink(e), "did you mean '%s'?", search.best);
        diag_fix(sink(e), mend_is_safe(&search), at, str_from(search.best));
    } else if (all->count) {
        diag_help(sink(e), "it has: %.*s", STR_ARG(list));
    } else {
        diag_help(sink(e), "it has none; write 'parameters: {%.*s: ...}' in the object",
                  STR_ARG(say_text(&e->loader->scratch, ir->name)));
    }
}

static void read_given(struct evaluation *e, struct copy_entry *entry, const struct ir_with *ir) {
    struct object *object = entry->object;
    const int number = find(object, ir->name);
    if (ir->head.poisoned)
        return;
    if (number < 0) {
        report_unknown(e, object, ir);
        return;
    }
    struct given_value *given = &entry->given[number];
    struct parameter *p = &object->parameters[number];
    if (given->ir) {
        diag_add(sink(e), DIAG_GIVEN_TWICE, place_given(e, ir, "name"), "'%.*s' is given twice",
                 STR_ARG(ir->name));
        diag_note(sink(e), place_given(e, given->ir, "name"), "first given here");
        diag_help(sink(e), "remove one of the two");
        return;
    }
    const span at = place_given(e, ir, "value");
    const str what = arena_format(&e->loader->scratch, "'%.*s'", STR_ARG(ir->name));
    if (p->state != PARAMETER_DONE || !computed_read(e, ir->value, what, at, &given->value)) {
        entry->is_good = false;
        return;
    }
    if (given->value.type != p->value.type) {
        diag_add(sink(e), DIAG_WITH, at, "'%.*s' is %s here, and %s where the object declares it",
                 STR_ARG(ir->name), expression_type_name(given->value.type),
                 expression_type_name(p->value.type));
        diag_note(sink(e), place_of(e, p->ir, "name"), "it is declared here");
        entry->is_good = false;
        return;
    }
    given->ir = ir;
    p->moves |= given->value.moves;
}

void objects_read_given(struct evaluation *e, struct copy_entry *entry) {
    const struct ir_instance *instance = entry->memory;
    entry->given =
        ARENA_ARRAY(&e->loader->scratch, struct given_value, (size_t)entry->object->ir->parameters.count + 1);
    if (instance->with.count && entry->object->ir->name.len == 0) {
        diag_add(sink(e), DIAG_WITH,
                 ir_place_label(&e->loader->output->origin, &instance->with.items[0].head),
                 "an object in place takes no values: it sees all names around it");
        diag_help(sink(e), "write the value where it is used, or as the parameter's own");
        return;
    }
    for (uint32_t i = 0; i < instance->with.count; i++)
        read_given(e, entry, &instance->with.items[i]);
}
