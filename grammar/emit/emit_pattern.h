// The contents of XML elements as patterns in the sense of RELAX NG: made from the table, in one walk, for
// every schema that prints them. Private to this folder.
//
// Ownership: patterns live while they are printed. Errors: only lack of memory; check `out->failed`.
// Thread safety: pure except for `out`.
#ifndef GLINT_GRAMMAR_EMIT_EMIT_PATTERN_H
#define GLINT_GRAMMAR_EMIT_EMIT_PATTERN_H

#include "grammar/emit/emit_lines.h"

enum pattern_kind {
    PATTERN_INTERLEAVE, // all children, in any order: what an element of the table holds
    PATTERN_ELEMENT,    // an element `name` that holds the children, in their order
    PATTERN_ATTRIBUTE,  // an attribute `name`; its only child is its values
    PATTERN_OPTIONAL,   // the only child, or nothing
    PATTERN_MANY,       // the only child, any number of times
    PATTERN_CHOICE,     // one of the children
    PATTERN_GROUP,      // the children in order, the whole group `times` times
    PATTERN_CONTENT,    // what the table's element `name` holds
    // Values of attributes.
    PATTERN_NUMBER, // of the range `name`
    PATTERN_TYPE,   // "boolean", "hex_color", "name" or "some_text", which is not empty
    PATTERN_WORD,   // the word `name`
    PATTERN_TEXT,   // any text
};

struct pattern {
    enum pattern_kind kind;
    uint32_t times;
    const char *name;
    const char *doc; // NULL: none
    struct pattern *first, *last, *next;
};

typedef void emit_pattern_print(struct emit_lines *w, const struct schema_element *schema,
                                const struct pattern *pattern);
// Prints every element of the table.
void emit_patterns(struct emit_lines *w, emit_pattern_print *print);

#endif
