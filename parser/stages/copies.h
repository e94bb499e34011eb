// What `for` and `if` make of entries. Private to parser/stages/copies*.c.
#ifndef GLINT_PARSER_STAGES_COPIES_H
#define GLINT_PARSER_STAGES_COPIES_H

#include "core/str_map.h"
#include "grammar/ir_walk.h"
#include "parser/bind/bind.h"
#include "parser/stages/evaluate.h"

struct entry_variable {
    const struct ir_variable *ir;
    bool is_list;
    struct computed *values; // of a list
    uint32_t value_count;
    uint32_t depends;                 // bit i: on variable i, as its values are computed
    const struct ir_formula *formula; // of a count; NULL: it is a number
    struct expression expression;
};

// An entry that is written with `for` or `if`.
struct copy_entry {
    const struct schema_row *row; // the scene's list
    void *memory;                 // as written
    struct bind_frame *frame;
    struct entry_variable *variables;
    struct copy_variable types[IR_VARIABLES_MOST];
    uint32_t variable_count;
    const struct ir_formula *condition; // NULL: it is not computed
    struct expression if_expression;
    uint32_t used;  // bit i: an expression has variable i in it
    uint64_t count; // of copies
    bool is_good;   // its variables, count and condition can be read
};

struct copy_clone {
    const struct copy_entry *entry;
    uint32_t places;
};

// A list of the scene.
struct copied_list {
    struct copy_entry **entries; // of bodies and lights; NULL: all are as written; an item: this one is
    uint32_t *first;             // of each entry, among what was made
    struct ir_copy *made;
    uint32_t count, capacity;
    // of materials and meshes, some of which are in place in an entry with variables
    uint32_t own;              // so many are as written
    bool *is_replaced;         // by clones
    struct copy_clone *clones; // they follow those of their own
    uint32_t clone_count, clone_capacity;
};

struct copying {
    struct ir_scene written;   // the scene before
    struct copied_list *lists; // by row of the scene
    uint32_t *places;          // as those of ir_copies
    uint32_t place_count, place_capacity;
    uint64_t steps;        // places so far
    bool is_over;          // the limit on them, which was reported
    struct str_map cloned; // by what is cloned and the places that it depends on: 1 + index
};

// copies_reach.c
struct copied_list *copies_list(const struct evaluation *e, const struct schema_row *row);
// Gives a variable one of its values.
bool copies_set(struct evaluation *e, const struct copy_entry *entry, uint32_t variable, uint32_t place);

// copies_variables.c
// Reads the variables and the condition of an entry. false: one of them is wrong (reported, or known).
bool copies_read_entry(struct evaluation *e, struct copy_entry *entry);
// The number of values of a variable, for the values of those before it. false: reported.
bool copies_size(struct evaluation *e, const struct copy_entry *entry, uint32_t variable, uint32_t *size);
// Bit i: an expression in an element has variable i in it.
uint32_t copies_used(const struct evaluation *e, const struct copy_entry *entry,
                     const struct schema_element *schema, const void *memory);

#endif
