// What older versions of the format wrote otherwise, and how `glint format --upgrade` rewrites it.
//
// A table of rules, each for one key or word of one element. A file that says the table's version, or none,
// is not touched; of an older one only the names that rules tell and the version are replaced. Ownership: the
// new text lies in the context's arena, which must be guarded. Thread safety: one call belongs to one
// thread; tables are constant data.
#ifndef GLINT_PARSER_STAGES_UPGRADE_H
#define GLINT_PARSER_STAGES_UPGRADE_H

#include "grammar/schema.h"
#include "parser/tree/reader.h"

struct upgrade_rule {
    int32_t version;                       // the last one that writes it the old way
    const struct schema_element *element;  // what holds it, as it is today
    const char *old_key, *new_key;         // YAML's key and XML's attribute; equal: the rule is for a word
    const char *old_element, *new_element; // XML's child element; NULL: it was and is an attribute
    const char *old_word, *new_word;       // the value; NULL: any, and the key is renamed
};

struct upgrade_table {
    int32_t version; // what files say afterwards
    const struct upgrade_rule *rules;
    uint32_t count;
};

// Of the versions that there have been: one, so that it has no rules yet.
extern const struct upgrade_table UPGRADE_STANDARD;

// The text as today's version writes it; false: it stays as it is.
bool upgrade_text(const struct reader_context *context, const struct upgrade_table *table,
                  const struct tree *tree, str text, str *upgraded);

#endif
