#include "assets/made/fault.h"

#include <stdarg.h>
#include <stdio.h>

enum {
    TRIANGLES_MOST = 1 << 28, // corners are counted in 32 bits
};

void made_begin(struct made *out) {
    *out = (struct made){
        .fault = {.points = {IR_NO_INDEX, IR_NO_INDEX}, .outlines = {IR_NO_INDEX, IR_NO_INDEX}}};
}

bool made_fail(struct made_fault *fault, enum made_code code, const char *format, ...) {
    va_list values;
    fault->code = code;
    va_start(values, format);
    vsnprintf(fault->text, sizeof fault->text, format, values);
    va_end(values);
    return false;
}

bool made_check_size(double value, const char *what, struct made_fault *fault) {
    if (value > 0 && value <= MESH_COORDINATE_MAX)
        return true;
    return made_fail(fault, MADE_RANGE, "%s must be more than 0 and at most 1e18; it is %.6g", what, value);
}

bool made_check_tolerance(double tolerance, struct made_fault *fault) {
    if (tolerance > 0 && tolerance <= MADE_TOLERANCE_MOST)
        return true;
    return made_fail(fault, MADE_RANGE, "the tolerance must be more than 0 and at most %g; it is %.6g",
                     MADE_TOLERANCE_MOST, tolerance);
}

bool made_check_bevel(double bevel, double thickness, const char *what, struct made_fault *fault) {
    if (bevel >= 0 && bevel <= thickness / 2)
        return true;
    if (!(bevel >= 0))
        return made_fail(fault, MADE_RANGE, "the bevel must be at least 0; it is %.6g", bevel);
    fault->most = thickness / 2;
    return made_fail(fault, MADE_BEVEL, "a bevel of %.6g is more than half of the %s, %.6g", bevel, what,
                     thickness);
}

bool made_count(struct made *out, const struct made_to *to, uint64_t triangles) {
    const uint64_t most = to->triangles_most < TRIANGLES_MOST ? to->triangles_most : TRIANGLES_MOST;
    out->triangle_count = triangles;
    if (triangles <= most)
        return true;
    return made_fail(&out->fault, MADE_TRIANGLES,
                     "it has %llu triangles, more than the %llu that are allowed",
                     (unsigned long long)triangles, (unsigned long long)most);
}
