// Codes of diagnostics whose first digit is 5: limits.
#ifndef GLINT_DIAG_CODES_LIMIT_H
#define GLINT_DIAG_CODES_LIMIT_H

#include "diag/diag.h"

enum diag_limit_code {
    DIAG_BEFORE_LIMIT = 5 * DIAG_FAMILY - 1,
#define X(NAME, code) DIAG_##NAME,
#include "diag/codes/limit.def"
#undef X
    DIAG_AFTER_LIMIT
};

#endif
