// Which element's attributes belong at a place of a text that is being typed, and so is seldom valid. Judged
// by indentation and brackets in YAML, by open tags in XML.
//
// Output: a row of the table's elements, nothing that is allocated. Thread safety: pure functions.
#ifndef GLINT_LSP_CONTEXT_H
#define GLINT_LSP_CONTEXT_H

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

enum {
    CONTEXT_VARIABLES_MOST = 128
};

// A variable of `for`, or a parameter, as the text has it.
struct context_variable {
    str name;
    str value; // a count; the items of a list; what a parameter is
    bool is_list;
    bool is_parameter;
    bool is_around; // not of the innermost entry with `for`
};
// Those that are in reach at a place, the nearest first, with the scene's own parameters in this file;
// returns their number.
uint32_t context_variables(str path, str text, size_t offset,
                           struct context_variable variables[CONTEXT_VARIABLES_MOST]);

// What an instance says of its object.
struct context_given {
    str object;                        // its name; empty: it has none
    str names[CONTEXT_VARIABLES_MOST]; // of parameters that have a value already
    uint32_t count;
};
// `offset`: where the name of a parameter is typed in `with`, which does not count.
void context_given(str path, str text, size_t offset, struct context_given *given);

#endif
