// Codes of diagnostics whose first digit is 2: names and values that do not fit the table.
#ifndef GLINT_DIAG_CODES_BINDING_H
#define GLINT_DIAG_CODES_BINDING_H

#include "diag/diag.h"

enum diag_binding_code {
    DIAG_BEFORE_BINDING = 2 * DIAG_FAMILY - 1,
#define X(NAME, code) DIAG_##NAME,
#include "diag/codes/binding.def"
#undef X
    DIAG_AFTER_BINDING
};

#endif
