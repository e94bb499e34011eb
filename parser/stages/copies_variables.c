// Variables of copies: their names, their values, and which of them an expression has in it.
#include "diag/codes/binding.h"
#include "parser/stages/copies.h"

#include "core/heap.h"
#include "grammar/ir_values.h"
#include "parser/bind/say.h"

#include <string.h>

static struct diag_sink *sink(const struct evaluation *e) {
    return e->loader->input->sink;
}

static span place_of(const struct evaluation *e, const struct ir_variable *v, const char *row) {
    return ir_place_value(&e->loader->output->origin, &v->head, &SCHEMA_VARIABLE, row);
}

// ---- names

static bool hides_parameter(const struct evaluation *e, str name, span at) {
    const uint32_t number = str_map_find(&e->by_name, name);
    if (!number)
        return false;
    const span there =
        ir_place_value(&e->loader->output->origin, &e->items[number - 1].ir->head, &SCHEMA_PARAMETER, "name");
    if (there.source != at.source)
        return false;
    diag_add(sink(e), DIAG_VARIABLE, at, "the variable '%.*s' has the name of a parameter", STR_ARG(name));
    diag_note(sink(e), there, "the parameter is here");
    diag_help(sink(e), "rename one of the two");
    return true;
}

static bool name_fits(const struct evaluation *e, const struct entry_variable *v) {
    const str name = v->ir->name;
    const span at = place_of(e, v->ir, "name");
    if (!evaluation_name_fits(e, name, at, "variable") || hides_parameter(e, name, at))
        return false;
    for (uint32_t i = 0; i < e->variable_count; i++)
        if (str_equal(e->names[e->count + i], name)) {
            diag_add(sink(e), DIAG_VARIABLE, at,
                     i < e->base ? "the variable '%.*s' has the name of one around it, or of a parameter"
                                 : "two variables of this entry have the name '%.*s'",
                     STR_ARG(name));
            diag_help(sink(e), "rename one of the two");
            return false;
        }
    return true;
}

// ---- what an expression has in it

static uint32_t named_in(const struct copy_entry *entry, str text) {
    uint32_t used = 0;
    size_t at = 0;
    str name;
    while (expression_next_name(text, &at, &name))
        for (uint32_t i = 0; i < entry->variable_count; i++)
            if (str_equal(entry->variables[i].ir->name, name))
                used |= UINT32_C(1) << i | entry->variables[i].depends;
    return used;
}

// ---- values

static void report_moves(const struct evaluation *e, const struct ir_formula *f, const char *what) {
    size_t at = 0;
    str name;
    diag_add(sink(e), DIAG_COPIES_MOVE, f->at, "%s depends on the frame; copies are the same in all frames",
             what);
    while (expression_next_name(f->text, &at, &name)) {
        const uint32_t number = str_map_find(&e->by_name, name);
        if (number && e->items[number - 1].moves)
            diag_note(sink(e), ir_place_label(&e->loader->output->origin, &e->items[number - 1].ir->head),
                      "'%.*s' depends on it, or a track moves it", STR_ARG(name));
    }
    diag_help(sink(e), "leave 'frame' and 'time' out of it, and parameters that depend on them");
}

static struct bind_frame frame_of(const struct evaluation *e, const struct copy_entry *entry,
                                  const struct entry_variable *v) {
    const struct schema_element *schema = entry->row->child;
    return (struct bind_frame){.parent = entry->frame,
                               .schema = &SCHEMA_VARIABLE,
                               .via = &schema->rows[schema_find_row(schema, STR("for"))],
                               .memory = (void *)v->ir,
                               .name = v->ir->name,
                               .label = place_of(e, v->ir, "name")};
}

static bool read_count(struct evaluation *e, const struct copy_entry *entry, struct entry_variable *v) {
    const struct schema_row *row = &SCHEMA_VARIABLE.rows[schema_find_row(&SCHEMA_VARIABLE, STR("count"))];
    v->formula = ir_formula_of(e->scene->formulas, &v->ir->head, row, -1, IR_FORMULA_WHOLE);
    if (!v->formula)
        return true;
    const struct bind_frame frame = frame_of(e, entry, v);
    if (!evaluate_read(e, &frame, v->formula, &v->expression))
        return false;
    if (v->expression.moves)
        report_moves(e, v->formula, "how many copies there are");
    return !v->expression.moves;
}

static bool read_values(struct evaluation *e, struct entry_variable *v, struct copy_variable *type) {
    const str what = arena_format(&e->loader->scratch, "a value of '%.*s'", STR_ARG(v->ir->name));
    const span at = place_of(e, v->ir, "values");
    str rest = v->ir->values, text, inside;
    v->values = ARENA_ARRAY(&e->loader->scratch, struct computed, ir_values_count(rest) + 1);
    for (; ir_values_next(&rest, &text); v->value_count++) {
        struct computed *value = &v->values[v->value_count];
        if (!computed_read(e, ir_values_open(text, &inside) ? inside : text, what, at, value))
            return false;
        type->moves |= value->moves;
        if (v->value_count == 0)
            type->type = value->type;
        if (value->type == type->type)
            continue;
        diag_add(sink(e), DIAG_VARIABLE, at, "the values of '%.*s' are not alike: one is %s, another %s",
                 STR_ARG(v->ir->name), expression_type_name(type->type), expression_type_name(value->type));
        diag_help(sink(e), "write all of them as numbers, or all as vectors or colours");
        return false;
    }
    return true;
}

static bool read_variable(struct evaluation *e, struct copy_entry *entry, uint32_t i) {
    struct entry_variable *v = &entry->variables[i];
    struct copy_variable *type = &entry->types[i];
    v->is_list = v->ir->kind == IR_VARIABLE_VALUES;
    v->depends = v->is_list ? named_in(entry, v->ir->values) : 0;
    if (v->ir->head.poisoned || !name_fits(e, v) ||
        !(v->is_list ? read_values(e, v, type) : read_count(e, entry, v)))
        return false;
    e->names[e->count + e->base + i] = v->ir->name;
    e->variables[e->base + i] = *type;
    e->variable_count = e->base + i + 1;
    return true;
}

static bool read_condition(struct evaluation *e, struct copy_entry *entry) {
    const struct schema_element *schema = entry->row->child;
    const struct ir_head *head = ir_walk_head(entry->memory);
    const uint32_t row = (uint32_t)schema_find_row(schema, STR("if"));
    entry->condition = ir_formula_of(e->scene->formulas, head, &schema->rows[row], -1, IR_FORMULA_WHOLE);
    if (head->poisoned & bind_bit(row))
        return false;
    if (!entry->condition)
        return true;
    if (!evaluate_read(e, entry->frame, entry->condition, &entry->if_expression))
        return false;
    if (entry->if_expression.moves)
        report_moves(e, entry->condition, "'if'");
    return !entry->if_expression.moves;
}

bool copies_read_entry(struct evaluation *e, struct copy_entry *entry) {
    const struct schema_element *schema = entry->row->child;
    const uint32_t row = (uint32_t)schema_find_row(schema, STR("for"));
    const struct ir_any_list list = ir_walk_list(&schema->rows[row], entry->memory);
    if (ir_walk_head(entry->memory)->poisoned & bind_bit(row))
        return false;
    if (list.count > IR_VARIABLES_MOST || e->base + list.count > REACH_MOST) {
        const uint32_t beyond = list.count > IR_VARIABLES_MOST ? IR_VARIABLES_MOST : 0;
        const struct ir_variable *v = ir_walk_item(&schema->rows[row], list, beyond);
        if (list.count > IR_VARIABLES_MOST)
            diag_add(sink(e), DIAG_VARIABLE, place_of(e, v, "name"),
                     "an entry can have %d variables; this one has %u", IR_VARIABLES_MOST, list.count);
        else
            diag_add(sink(e), DIAG_VARIABLE, place_of(e, v, "name"),
                     "there are more than %d names of objects and 'for' here", REACH_MOST);
        return false;
    }
    entry->variable_count = list.count;
    entry->variables = ARENA_ARRAY(&e->loader->scratch, struct entry_variable, list.count + 1);
    copies_leave(e);
    e->entry = entry;
    for (uint32_t i = 0; i < list.count; i++)
        entry->variables[i].ir = ir_walk_item(&schema->rows[row], list, i);
    for (uint32_t i = 0; i < list.count; i++)
        if (!read_variable(e, entry, i))
            return false;
    return read_condition(e, entry);
}

bool copies_size(struct evaluation *e, const struct copy_entry *entry, uint32_t variable, uint32_t *size) {
    const struct entry_variable *v = &entry->variables[variable];
    struct expression_fault fault;
    double value[EXPRESSION_WIDTH];
    if (v->is_list || !v->formula) {
        *size = v->is_list ? v->value_count : (uint32_t)v->ir->count;
        return true;
    }
    const struct bind_frame frame = frame_of(e, entry, v);
    const uint32_t in_reach = e->variable_count;
    e->variable_count = e->base + variable; // messages give the values of those before it
    bool good = expression_at(&v->expression, &e->at, value, &fault);
    if (!good)
        evaluation_fault(e, DIAG_EXPRESSION, v->formula->text, v->formula->at, true, &fault);
    else
        good = evaluate_fits(e, bind_subject(&frame, v->formula->row), v->formula, value[0]);
    e->variable_count = in_reach;
    *size = good ? (uint32_t)value[0] : 0;
    return good;
}

static void mark_named(const struct evaluation *e, str text, bool *is_used) {
    size_t at = 0;
    str name;
    while (expression_next_name(text, &at, &name))
        for (uint32_t i = e->variable_count; i-- > 0;)
            if (str_equal(e->names[e->count + i], name)) {
                is_used[i] = true;
                break; // it hides those before it
            }
}

void copies_mark_used(const struct evaluation *e, const struct schema_element *schema, const void *memory,
                      bool *is_used) {
    for (uint32_t i = ir_walk_head(memory)->formulas; i; i = e->scene->formulas->items[i].next)
        mark_named(e, e->scene->formulas->items[i].text, is_used);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_any_list list = ir_walk_list(row, memory);
        for (uint32_t k = 0; k < list.count; k++)
            copies_mark_used(e, row->child, ir_walk_item(row, list, k), is_used);
        if (row->kind == SCHEMA_ELEMENT)
            copies_mark_used(e, row->child, schema_field_const(row, memory), is_used);
    }
}

uint32_t copies_used(const struct evaluation *e, const struct copy_entry *entry,
                     const struct schema_element *schema, const void *memory) {
    uint32_t used = 0;
    for (uint32_t i = ir_walk_head(memory)->formulas; i; i = e->scene->formulas->items[i].next)
        used |= named_in(entry, e->scene->formulas->items[i].text);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_any_list list = ir_walk_list(row, memory);
        for (uint32_t k = 0; k < list.count; k++)
            used |= copies_used(e, entry, row->child, ir_walk_item(row, list, k));
        if (row->kind == SCHEMA_ELEMENT)
            used |= copies_used(e, entry, row->child, schema_field_const(row, memory));
        if (schema_has_values(row))
            used |= named_in(entry, *(const str *)schema_field_const(row, memory));
    }
    return used;
}
