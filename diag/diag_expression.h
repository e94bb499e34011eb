// What is wrong with an expression, as a diagnostic: where in the file, what was probably meant, a fix.
//
// Ownership: the sink's. Thread safety: as diag.h.
#ifndef GLINT_DIAG_DIAG_EXPRESSION_H
#define GLINT_DIAG_DIAG_EXPRESSION_H

#include "core/expression.h"
#include "diag/diag.h"

struct diag_expression {
    str text;           // as it was compiled or run
    span at;            // all of it, in its file
    const char *suffix; // of the message: ", in frame 3"; or ""
    const str *names;   // of the scene, that are in reach
    uint32_t name_count;
};

// The place of a part of the text, where the file has the text literally; else of all of it.
span diag_expression_part(const struct source_set *sources, const struct diag_expression *expression,
                          size_t begin, size_t end);
// Whether a name in reach, or a word of expressions that has a value, is spelled almost like the word.
bool diag_expression_is_near(struct diag_sink *sink, const struct diag_expression *expression, str word);
void diag_expression_fault(struct diag_sink *sink, const struct source_set *sources, diag_code code,
                           const struct diag_expression *expression, const struct expression_fault *fault);

#endif
