// What older versions of the format spell differently, and how `glint format --upgrade` rewrites it.
//
// A table of rules, each for one key or word of one element. A file with the table's version, or without one,
// is not touched; in an older one only the names in rules and the version are replaced. Ownership: the new
// text is in the context's arena, which must be guarded. Thread safety: one call belongs to one thread;
// tables are constant data.
#ifndef GLINT_PARSER_STAGES_UPGRADE_H
#define GLINT_PARSER_STAGES_UPGRADE_H

#include "grammar/schema.h"
#include "parser/tree/reader.h"

struct upgrade_rule {
    int32_t version;                       // the last version that writes it the old way
    const struct schema_element *element;  // the element that contains it, as it is today
    const char *old_key, *new_key;         // YAML's key and XML's attribute; equal: the rule is for a word
    const char *old_element, *new_element; // XML's child element; NULL: it was and is an attribute
    const char *old_word, *new_word;       // the value; NULL: any, and the key is renamed
};

struct upgrade_table {
    int32_t version; // the version that files state afterwards
    const struct upgrade_rule *rules;
    uint32_t count;
};

// For the versions so far: there is only one, so the table has no rules yet.
extern const struct upgrade_table UPGRADE_STANDARD;

// The text as today's version writes it; false: it stays unchanged.
bool upgrade_text(const struct reader_context *context, const struct upgrade_table *table,
                  const struct tree *tree, str text, str *upgraded);

#endif
