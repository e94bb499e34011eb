// Values and what they are computed by, as all writers need them. Part of the writers (ir_print.h).
// Thread safety: pure.
#ifndef GLINT_GRAMMAR_PRINT_PRINT_VALUE_H
#define GLINT_GRAMMAR_PRINT_PRINT_VALUE_H

#include "grammar/ir.h"
#include "grammar/ir_formula.h"
#include "grammar/schema.h"

// A value of an element: of a row, or one of a fixed number of values; slot -1: the only one.
struct print_value {
    const struct schema_row *row;
    const void *element;
    int slot;
};
static inline const void *print_field(const struct print_value *v) {
    return (const char *)schema_field_const(v->row, v->element) +
           (v->slot > 0 ? (size_t)v->slot * v->row->size : 0);
}
// The expression that the value, or a component of it, is computed by; NULL: it is written.
static inline const struct ir_formula *print_formula(const struct ir_scene *scene,
                                                     const struct print_value *v, int component) {
    return scene ? ir_formula_of(scene->formulas, v->element, v->row, v->slot, component) : NULL;
}
static inline bool print_is_computed(const struct ir_scene *scene, const struct print_value *v) {
    return scene && ir_formula_in(scene->formulas, v->element, v->row);
}

#endif
