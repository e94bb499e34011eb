// What is wrong with a description: the sentence and the entries to blame (struct made_fault).
//
// Thread safety: pure.
#ifndef GLINT_ASSETS_MADE_FAULT_H
#define GLINT_ASSETS_MADE_FAULT_H

#include "assets/made/made.h"

// Forgets what an earlier build left.
void made_begin(struct made *out);
// Sets code and text; entries and places that are set before stay. Always false.
bool made_fail(struct made_fault *fault, enum made_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
// Sizes: finite, more than 0 and at most MESH_COORDINATE_MAX. `what` names it in the sentence.
bool made_check_size(double value, const char *what, struct made_fault *fault);
// More than 0 and at most MADE_TOLERANCE_MOST.
bool made_check_tolerance(double tolerance, struct made_fault *fault);
// 0 to half of the thickness that it is cut from.
bool made_check_bevel(double bevel, double thickness, const char *what, struct made_fault *fault);
// Notes the count; false: more than the caller wants.
bool made_count(struct made *out, const struct made_to *to, uint64_t triangles);

#endif
