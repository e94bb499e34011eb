// Codes of diagnostics whose first digit is 7: devices.
#ifndef GLINT_DIAG_CODES_DEVICE_H
#define GLINT_DIAG_CODES_DEVICE_H

#include "diag/diag.h"

enum diag_device_code {
    DIAG_BEFORE_DEVICE = 7 * DIAG_FAMILY - 1,
#define X(NAME, code) DIAG_##NAME,
#include "diag/codes/device.def"
#undef X
    DIAG_AFTER_DEVICE
};

#endif
