// Features of other tools that glint lacks or names differently (concepts.def): for the message about an
// unknown name (E202), `glint explain` and docs/limits.md.
//
// Input: an element of the table and a word in snake_case. Output: a row of constant data. Errors: none.
// Thread safety: pure.
#ifndef GLINT_GRAMMAR_CONCEPT_H
#define GLINT_GRAMMAR_CONCEPT_H

#include "core/strbuf.h"
#include "grammar/schema.h"

// The columns of concepts.def.
struct concept {
    const char *chapter, *title, *words, *in, *lacks, *instead, *use, *example;
};

// All concepts, chapter by chapter; a row without title at the end.
extern const struct concept concepts[];

// The concept that `word`, in the singular or plural, means in the element, or anywhere if the element is
// NULL; NULL: none. A row that the element has under this name or another (schema_find_also) takes
// precedence.
const struct concept *concept_find(const struct schema_element *element, str word);
// Whether the row applies to this element only, so that its words cannot be misspelt names.
bool concept_is_special(const struct concept *concept);
// The row of the table to write instead; NULL: none.
const struct schema_row *concept_use(const struct concept *concept);
// Cuts the next word of a list off *rest; empty at the end.
str concept_next_word(str *rest);

#endif
