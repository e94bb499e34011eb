// Codes of diagnostics whose first digit is 4: scenes that cannot be drawn, or hardly as intended.
#ifndef GLINT_DIAG_CODES_RULE_H
#define GLINT_DIAG_CODES_RULE_H

#include "diag/diag.h"

enum diag_rule_code {
    DIAG_BEFORE_RULE = 4 * DIAG_FAMILY - 1,
#define X(NAME, code) DIAG_##NAME,
#include "diag/codes/rule.def"
#undef X
    DIAG_AFTER_RULE
};

#endif
