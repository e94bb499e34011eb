// A patch from one text to another, in the unified form that patch(1) and git read.
//
// The fewest lines are removed and added (E. Myers, An O(ND) Difference Algorithm and Its Variations, 1986,
// the greedy algorithm of its figure 2), if at most TEXT_DIFF_MOST lines differ, and at most the square root
// of 1024 times the number of lines; beyond that all lines between the first and the last difference are
// replaced. Line ends belong to their lines. Errors: only lack of memory, shown by `out->failed`. Thread
// safety: pure except for `out`.
#ifndef GLINT_CORE_TEXT_DIFF_H
#define GLINT_CORE_TEXT_DIFF_H

#include "core/str.h"
#include "core/strbuf.h"

enum {
    TEXT_DIFF_MOST = 4000
};

// Appends nothing if the texts are equal.
void text_diff(str old_name, str old_text, str new_name, str new_text, struct strbuf *out);

#endif
