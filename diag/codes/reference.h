// Codes of diagnostics whose first digit is 3: names that name nothing.
#ifndef GLINT_DIAG_CODES_REFERENCE_H
#define GLINT_DIAG_CODES_REFERENCE_H

#include "diag/diag.h"

enum diag_reference_code {
    DIAG_BEFORE_REFERENCE = 3 * DIAG_FAMILY - 1,
#define X(NAME, code) DIAG_##NAME,
#include "diag/codes/reference.def"
#undef X
    DIAG_AFTER_REFERENCE
};

#endif
