// The text of `glint explain` as Markdown, for clients that show it.
//
// Ownership: appended to the caller's strbuf. Thread safety: pure except for that.
#ifndef GLINT_LSP_MARKDOWN_H
#define GLINT_LSP_MARKDOWN_H

#include "core/strbuf.h"

void markdown_explanation(str text, struct strbuf *out);
// A block of code in a fence that is longer than any in it.
void markdown_code(str code, const char *language, struct strbuf *out);

#endif
