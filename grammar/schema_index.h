// The table's names hashed, and each element's defaults ready to copy: for binding many elements.
//
// Ownership: the arena passed to schema_index_init, which must be guarded.
// Thread safety: immutable once made.
#ifndef GLINT_GRAMMAR_SCHEMA_INDEX_H
#define GLINT_GRAMMAR_SCHEMA_INDEX_H

#include "core/str_map.h"
#include "grammar/schema.h"

// The place where a name is written.
enum schema_name_kind {
    SCHEMA_NAME_KEY,       // YAML
    SCHEMA_NAME_ATTRIBUTE, // XML
    SCHEMA_NAME_CHILD,     // XML
    SCHEMA_NAME_KINDS,
};

// Facts about an element that each binding of it needs. Sets of rows are masks: bit i is row i.
struct schema_facts {
    const void *defaults;
    int short_row, key_row; // as schema_short_row, schema_key_row
    int name_row;           // the element's own name, or -1
    uint64_t names;         // key rows and names
    uint64_t required;
    bool has_choices; // whether there are choices of which one must be taken
    // By name: 1 + the row, with the lowest bit set if the name is that of a single item.
    struct str_map rows[SCHEMA_NAME_KINDS];
};

struct schema_index {
    struct schema_facts *facts; // in the order of schema_elements
};

void schema_index_init(struct schema_index *index, struct arena *arena);
// As schema_find_yaml and schema_find_child; an XML attribute names the row that schema_find_row finds, if
// that can be an attribute.
int schema_index_find(const struct schema_index *index, const struct schema_element *element,
                      enum schema_name_kind kind, str name, bool *is_single);
const struct schema_facts *schema_index_facts(const struct schema_index *index,
                                              const struct schema_element *element);
// As schema_init; the contents of `memory` are overwritten.
void schema_index_defaults(const struct schema_index *index, const struct schema_element *element,
                           void *memory);

#endif
