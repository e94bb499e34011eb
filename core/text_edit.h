// Changes to a text: ranges of bytes and what replaces them.
//
// Ownership: edits and replacements are the caller's. Thread safety: pure functions.
#ifndef GLINT_CORE_TEXT_EDIT_H
#define GLINT_CORE_TEXT_EDIT_H

#include "core/str.h"
#include "core/strbuf.h"

struct text_edit {
    uint32_t begin, end; // bytes; equal: an insertion
    str text;
    uint32_t order; // of two that overlap or insert at the same place, the lower stays
};

// Sorts the edits by place and drops repeats, and edits that touch a byte or the insertion place of an edit
// with a lower order. Returns how many are left, at the front.
uint32_t text_edits_settle(struct text_edit *edits, uint32_t count);
// The text with all edits made; they must be settled and inside it.
void text_edits_apply(str text, const struct text_edit *edits, uint32_t count, struct strbuf *out);

#endif
