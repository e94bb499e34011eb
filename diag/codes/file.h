// Codes of diagnostics whose first digit is 6: files.
#ifndef GLINT_DIAG_CODES_FILE_H
#define GLINT_DIAG_CODES_FILE_H

#include "diag/diag.h"

enum diag_file_code {
    DIAG_BEFORE_FILE = 6 * DIAG_FAMILY - 1,
#define X(NAME, code) DIAG_##NAME,
#include "diag/codes/file.def"
#undef X
    DIAG_AFTER_FILE
};

#endif
