// Codes of diagnostics whose first digit is 8: the command line and settings.
#ifndef GLINT_DIAG_CODES_COMMAND_H
#define GLINT_DIAG_CODES_COMMAND_H

#include "diag/diag.h"

enum diag_command_code {
    DIAG_BEFORE_COMMAND = 8 * DIAG_FAMILY - 1,
#define X(NAME, code) DIAG_##NAME,
#include "diag/codes/command.def"
#undef X
    DIAG_AFTER_COMMAND
};

#endif
