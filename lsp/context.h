// Which element's attributes belong at a place of a text that is being typed, and so is seldom valid. Judged
// by indentation and brackets in YAML, by open tags in XML.
//
// Output: a row of the table's elements, nothing that is allocated. Thread safety: pure functions.
#ifndef GLINT_LSP_CONTEXT_H
#define GLINT_LSP_CONTEXT_H

#include "grammar/ir_copies.h"
#include "grammar/schema.h"

struct context {
    const struct schema_element *schema; // NULL: none that is known
    const struct schema_element *named;  // YAML: a name of such a thing belongs there, as a key
    bool is_xml;
    bool is_flow;     // YAML: inside { }
    bool in_children; // XML: where a child element begins, else in a tag
};

// `offset`: where the typed word begins.
struct context context_at(str path, str text, size_t offset);

// ---- context_variables.c

// A variable as the text has it.
struct context_variable {
    str name;
    str value; // a count; the items of a list
    bool is_list;
};
// The variables of the entry at a place; returns their number.
uint32_t context_variables(str path, str text, size_t offset,
                           struct context_variable variables[IR_VARIABLES_MOST]);

#endif
