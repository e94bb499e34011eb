// Values that are computed: expressions in the place of a number, truth, vector or colour.
//
// The field has a placeholder until the evaluation has put the value there; writers write the text. All files
// of a scene share one table. A list of formulas never changes once an element has it, since copies of the
// element share it: what is dropped or taken over makes a new list.
// Ownership: the arena of the scene. Thread safety: immutable once the scene is loaded.
#ifndef GLINT_GRAMMAR_IR_FORMULA_H
#define GLINT_GRAMMAR_IR_FORMULA_H

#include "core/arena.h"
#include "core/expression.h"
#include "diag/source.h"

struct ir_head;
struct ir_scene;
struct schema_element;
struct schema_row;

enum {
    IR_FORMULA_WHOLE = -1 // all of the value
};

struct ir_formula {
    const struct schema_row *row; // of the element
    int slot;                     // SCHEMA_FIXED: which value; -1: the only one
    int component;                // of a vector, colour or weights; IR_FORMULA_WHOLE
    str text;                     // as written
    span at;                      // the text in its file, with its quotes
    bool moves;                   // was evaluated, and depends on the frame
    uint32_t next;                // of the same element; 0: none
};
// What a parameter came to in the frame that was loaded; without one: in frame 0.
struct ir_result {
    bool is_known; // else a mistake in it was reported
    bool moves;    // depends on the frame
    enum expression_type type;
    double value[EXPRESSION_WIDTH];
};
struct ir_formulas {
    struct ir_formula *items;
    uint32_t count, capacity;  // items[0] is none
    struct ir_result *results; // of the scene's parameters, by their index; NULL before they are evaluated
};

// As the text of a parameter's value.
str ir_result_text(const struct ir_result *result, struct arena *arena);

struct ir_formulas *ir_formulas_new(struct arena *arena);
struct ir_formulas *ir_formulas_copy(const struct ir_formulas *from, struct arena *arena);
// Adds a formula after the others of the element, whose list is its own: it was just made, or something was
// dropped.
void ir_formula_add(struct arena *arena, struct ir_formulas *formulas, struct ir_head *head,
                    struct ir_formula formula);
// Forgets those of a row, and gives the element a list of its own; of a slot (-1: all of them), of a
// component (IR_FORMULA_WHOLE: all of them).
void ir_formula_drop(struct arena *arena, struct ir_formulas *formulas, struct ir_head *head,
                     const struct schema_row *row, int slot, int component);
// Gives an element those that another has of a row, in the place of its own.
void ir_formula_take(struct arena *arena, struct ir_formulas *formulas, struct ir_head *into,
                     const struct ir_head *from, const struct schema_row *row);
// NULL: the value is written as it is. `formulas` may be NULL.
const struct ir_formula *ir_formula_of(const struct ir_formulas *formulas, const struct ir_head *head,
                                       const struct schema_row *row, int slot, int component);
// Whether any part of the row is computed.
bool ir_formula_in(const struct ir_formulas *formulas, const struct ir_head *head,
                   const struct schema_row *row);

// Forgets those of an element and of all in it: what they came to stays.
void ir_formulas_forget(const struct schema_element *schema, void *element);

#endif
