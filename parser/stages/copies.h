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

// What an instance gives a parameter of its object.
struct given_value {
    const struct ir_with *ir; // NULL: nothing
    struct computed value;
};

struct object;

// An entry that is written with `for` or `if`, an instance, or one of an object.
struct copy_entry {
    const struct schema_row *row; // the list that it is in, of the scene or of an object
    const struct object *in;      // the object; NULL: of the scene
    struct object *object;        // of an instance: what it shows; NULL: another entry, or it is wrong
    struct given_value *given;    // by parameter of the object
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
    bool is_made;   // at least once
};

struct copy_clone {
    const struct copy_entry *entry;
    uint32_t places, instance;
};
// The names in reach that something in place depends on, by their number there.
struct used_names {
    uint16_t *items;
    uint32_t count;
    bool is_known;
};

// A list of the scene.
struct copied_list {
    uint32_t written;            // entries of the scene's list
    struct copy_entry **entries; // of bodies, lights and instances; NULL: as it is written
    bool is_copied;              // some are not
    uint32_t *first;             // of each entry, among what was made
    struct ir_copy *made;
    uint32_t count, capacity;
    // of materials and meshes, some of which are in place in an entry with variables
    uint32_t own;              // so many are as written
    bool *is_replaced;         // by clones
    struct used_names *used;   // by item
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
    struct str_map cloned; // by what is cloned and the values that it depends on: 1 + index
};

// copies_reach.c
// A pool of the scene has items that clones replace.
void copies_list_pool(struct evaluation *e, const struct schema_row *pool);
struct copied_list *copies_list(const struct evaluation *e, const struct schema_row *row);
// The entry that an item of a list comes from; NULL: it is as written.
struct copy_entry *copies_entry(const struct evaluation *e, const struct schema_row *row,
                                const struct ir_copy *copy);
// The names that an entry sees come into reach, without values.
void copies_enter_types(struct evaluation *e, const struct copy_entry *entry);
// Gives a variable one of its values.
bool copies_set(struct evaluation *e, const struct copy_entry *entry, uint32_t variable, uint32_t place);

// copies.c
struct copy_entry *copies_new_entry(struct evaluation *e, const struct schema_row *row, void *memory);
// Reads the formulas of an entry, and of what is in place in it, of which no copies are made.
void copies_read_types(struct evaluation *e, struct copy_entry *entry);
// Adds what `for` and `if` make of an entry to a list of the scene.
void copies_make_entry(struct evaluation *e, struct copied_list *list, struct copy_entry *entry,
                       uint32_t index, uint32_t instance);

// Whether an entry has `for` or `if`.
bool copies_is_copied(const struct schema_row *row, const void *entry);
// Adds an item to what was made of a list.
void copies_push(struct evaluation *e, struct copied_list *list, struct ir_copy copy);
// Keeps the places of a copy; returns where (ir_copies.places).
uint32_t copies_push_places(struct evaluation *e, const uint32_t *places, uint32_t count);
// `for` and `if` of an item are carried out.
void copies_clear_rows(const struct schema_element *schema, void *item);

// copies_fill.c
// Gives the scene's lists what was made.
void copies_fill(struct evaluation *e);

// copies_variables.c
// Reads the variables and the condition of an entry. false: one of them is wrong (reported, or known).
bool copies_read_entry(struct evaluation *e, struct copy_entry *entry);
// The number of values of a variable, for the values of those before it. false: reported.
bool copies_size(struct evaluation *e, const struct copy_entry *entry, uint32_t variable, uint32_t *size);
// Marks the names in reach that expressions in an element have in them.
void copies_mark_used(const struct evaluation *e, const struct schema_element *schema, const void *memory,
                      bool *is_used);
// Bit i: an expression in an element has variable i in it.
uint32_t copies_used(const struct evaluation *e, const struct copy_entry *entry,
                     const struct schema_element *schema, const void *memory);

#endif
