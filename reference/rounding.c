// How single precision would round a number: the error of its computation is taken as half a unit in the last
// place, up or down at random (Parker 1997, "Monte Carlo Arithmetic"), drawn from the number's own bits, so
// that every run draws the same.
#include "core/splitmix.h"
#include "reference/reference_internal.h"

#include <string.h>

// 1 or -1.
static double drawn(double value) {
    uint64_t z;
    memcpy(&z, &value, sizeof z);
    return splitmix(z) & 1 ? 1 : -1;
}

double reference_rounded(const struct reference *r, double value, double size) {
    if (!r->input.as_single)
        return value;
    return (double)(float)(value + REFERENCE_SINGLE * size * drawn(value));
}

vec3 reference_rounded3(const struct reference *r, vec3 v, double size) {
    if (!r->input.as_single)
        return v;
    return (vec3){reference_rounded(r, v.x, size), reference_rounded(r, v.y, size),
                  reference_rounded(r, v.z, size)};
}

double reference_stored(const struct reference *r, double value) {
    return r->input.as_single ? (double)(float)value : value;
}

vec3 reference_stored3(const struct reference *r, vec3 v) {
    return (vec3){reference_stored(r, v.x), reference_stored(r, v.y), reference_stored(r, v.z)};
}
