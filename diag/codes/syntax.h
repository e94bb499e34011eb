// Codes of diagnostics whose first digit is 1: what YAML or XML itself does not allow.
#ifndef GLINT_DIAG_CODES_SYNTAX_H
#define GLINT_DIAG_CODES_SYNTAX_H

#include "diag/diag.h"

enum diag_syntax_code {
    DIAG_BEFORE_SYNTAX = 1 * DIAG_FAMILY - 1,
#define X(NAME, code) DIAG_##NAME,
#include "diag/codes/syntax.def"
#undef X
    DIAG_AFTER_SYNTAX
};

#endif
