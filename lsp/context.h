// Which element's attributes belong at a place of a text that is being typed, and so is seldom valid. Judged
// by indentation and brackets in YAML, by open tags in XML.
//
// Output: a row of the table's elements, nothing that is allocated. Thread safety: pure functions.
#ifndef GLINT_LSP_CONTEXT_H
#define GLINT_LSP_CONTEXT_H

#include "grammar/schema.h"

struct context {
    const struct schema_element *schema; // NULL: none that is known
    bool is_xml;
    bool is_flow;     // YAML: inside { }
    bool in_children; // XML: where a child element begins, else in a tag
};

// `offset`: where the typed word begins.
struct context context_at(str path, str text, size_t offset);

#endif
