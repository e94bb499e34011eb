// Points on discs and frames around a vector: the same samples as in every tracer.
#include "reference/reference_internal.h"

void reference_disc(double across, double down, double *x, double *y) {
    const double u = 2 * across - 1, v = 2 * down - 1;
    const bool is_wide = fabs(u) > fabs(v);
    const double ring = is_wide ? u : v;
    const double angle = ring == 0 ? 0 : 0.78539816339744830962 * (is_wide ? v : u) / ring;
    *x = ring * (is_wide ? cos(angle) : sin(angle));
    *y = ring * (is_wide ? sin(angle) : cos(angle));
}

void reference_frame(vec3 n, vec3 *a, vec3 *b) {
    const vec3 axis = {9 / 25., 12 / 25., 20 / 25.}, other = {12 / 25., -9 / 25., 20 / 25.};
    const bool along = fabs(vec3_dot(axis, n)) > 0.875;
    *a = vec3_unit(vec3_cross(along ? other : axis, n));
    *b = vec3_cross(n, *a);
}

vec3 reference_turned(vec3 n, double x, double y, double along) {
    vec3 a, b;
    reference_frame(n, &a, &b);
    return vec3_add(vec3_mul(n, along), vec3_add(vec3_mul(a, x), vec3_mul(b, y)));
}
