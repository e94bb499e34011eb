// The table's names hashed, and each element's defaults ready to copy: for those who bind many elements.
//
// Ownership: the arena given to schema_index_init, whose guard is set by the caller.
// Thread safety: immutable once made.
#ifndef GLINT_GRAMMAR_SCHEMA_INDEX_H
#define GLINT_GRAMMAR_SCHEMA_INDEX_H

#include "core/arena.h"
#include "grammar/schema.h"

// The place where a name stands.
enum schema_name_kind {
    SCHEMA_NAME_KEY,       // YAML
    SCHEMA_NAME_ATTRIBUTE, // XML
    SCHEMA_NAME_CHILD,     // XML
};

struct schema_slot {
    const struct schema_element *element; // NULL: free
    const char *name;
    uint32_t hash;
    uint16_t length;
    uint8_t kind; // schema_name_kind
    bool single;
    int row;
};

struct schema_index {
    struct schema_slot *slots;
    uint32_t mask;
    const void **defaults; // in the order of schema_elements
};

void schema_index_init(struct schema_index *index, struct arena *arena);
// As schema_find_yaml, schema_find_attribute and schema_find_child.
int schema_index_find(const struct schema_index *index, const struct schema_element *element,
                      enum schema_name_kind kind, str name, bool *is_single);
// As schema_init; what `memory` holds is overwritten.
void schema_index_defaults(const struct schema_index *index, const struct schema_element *element,
                           void *memory);

#endif
