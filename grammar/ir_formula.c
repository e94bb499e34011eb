#include "grammar/ir_formula.h"

#include "core/heap.h"
#include "grammar/ir.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

#include <string.h>

static uint32_t push(struct arena *arena, struct ir_formulas *formulas, struct ir_formula formula) {
    if (ARENA_IS_FULL(formulas))
        formulas->items = arena_regrow(arena, formulas->items, formulas->count, &formulas->capacity,
                                       sizeof *formulas->items);
    formulas->items[formulas->count++] = formula;
    return formulas->count - 1;
}

str ir_result_text(const struct ir_result *result, struct arena *arena) {
    struct strbuf value;
    strbuf_init(&value);
    expression_print(result->type, result->value, &value);
    str text = strbuf_view(&value);
    if (text.len && text.ptr[0] == '[')
        text = str_slice(text, 1, text.len - 1);
    text = arena_copy(arena, text);
    strbuf_finish(&value);
    return text;
}

struct ir_formulas *ir_formulas_new(struct arena *arena) {
    struct ir_formulas *formulas = ARENA_NEW(arena, struct ir_formulas);
    push(arena, formulas, (struct ir_formula){.row = NULL});
    return formulas;
}

struct ir_formulas *ir_formulas_copy(const struct ir_formulas *from, struct arena *arena) {
    struct ir_formulas *formulas = ARENA_NEW(arena, struct ir_formulas);
    *formulas =
        (struct ir_formulas){.items = arena_alloc(arena, heap_times(from->count, sizeof *from->items)),
                             .count = from->count,
                             .capacity = from->count};
    memcpy(formulas->items, from->items, from->count * sizeof *from->items);
    return formulas;
}

// Adds to the element a copy of a list, of what `keeps` says.
static void copy_list(struct arena *arena, struct ir_formulas *formulas, struct ir_head *head, uint32_t list,
                      bool (*keeps)(const struct ir_formula *, const void *), const void *context) {
    for (uint32_t i = list; i; i = formulas->items[i].next)
        if (keeps(&formulas->items[i], context))
            ir_formula_add(arena, formulas, head, formulas->items[i]);
}

void ir_formula_add(struct arena *arena, struct ir_formulas *formulas, struct ir_head *head,
                    struct ir_formula formula) {
    formula.next = 0;
    const uint32_t added = push(arena, formulas, formula);
    uint32_t *last = &head->formulas;
    while (*last)
        last = &formulas->items[*last].next;
    *last = added;
}

struct part {
    const struct schema_row *row;
    int slot, component;
};

static bool is_other(const struct ir_formula *formula, const void *context) {
    const struct part *part = context;
    return formula->row != part->row || (part->slot >= 0 && formula->slot != part->slot) ||
           (part->component != IR_FORMULA_WHOLE && formula->component != part->component);
}

static bool is_of_row(const struct ir_formula *formula, const void *row) {
    return formula->row == row;
}

void ir_formula_drop(struct arena *arena, struct ir_formulas *formulas, struct ir_head *head,
                     const struct schema_row *row, int slot, int component) {
    const struct part part = {row, slot, component};
    const uint32_t list = head->formulas;
    if (!list)
        return;
    head->formulas = 0;
    copy_list(arena, formulas, head, list, is_other, &part);
}

void ir_formula_take(struct arena *arena, struct ir_formulas *formulas, struct ir_head *into,
                     const struct ir_head *from, const struct schema_row *row) {
    ir_formula_drop(arena, formulas, into, row, -1, IR_FORMULA_WHOLE);
    copy_list(arena, formulas, into, from->formulas, is_of_row, row);
}

const struct ir_formula *ir_formula_of(const struct ir_formulas *formulas, const struct ir_head *head,
                                       const struct schema_row *row, int slot, int component) {
    for (uint32_t i = formulas ? head->formulas : 0; i; i = formulas->items[i].next) {
        const struct ir_formula *formula = &formulas->items[i];
        if (formula->row == row && formula->slot == slot && formula->component == component)
            return formula;
    }
    return NULL;
}

bool ir_formula_in(const struct ir_formulas *formulas, const struct ir_head *head,
                   const struct schema_row *row) {
    for (uint32_t i = formulas ? head->formulas : 0; i; i = formulas->items[i].next)
        if (formulas->items[i].row == row)
            return true;
    return false;
}

void ir_formulas_forget(const struct schema_element *schema, void *element) {
    ((struct ir_head *)element)->formulas = 0;
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_any_list list = ir_walk_list(row, element);
        for (uint32_t k = 0; k < list.count; k++)
            ir_formulas_forget(row->child, ir_walk_item(row, list, k));
        if (row->kind == SCHEMA_ELEMENT)
            ir_formulas_forget(row->child, schema_field(row, element));
    }
}
