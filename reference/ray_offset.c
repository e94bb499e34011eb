// Where a ray that leaves a surface starts, so that it does not hit that surface again.
#include "reference/reference_internal.h"

// Displaced by the point's error, then one number outward (Pharr, Jakob, Humphreys 2023, section 6.8.6). The
// error along the normal is not enough: the error along the surface can carry the point across an edge.
struct start reference_leave(const struct reference *r, const struct surface *s, vec3 side) {
    double distance = fmax(vec3_dot(vec3_abs(side), s->error), vec3_max_abs(s->error));
    vec3 shift = vec3_mul(side, distance);
    vec3 at = vec3_add(s->point, shift);
    if (shift.x != 0)
        at.x = nextafter(at.x, shift.x > 0 ? INFINITY : -INFINITY);
    if (shift.y != 0)
        at.y = nextafter(at.y, shift.y > 0 ? INFINITY : -INFINITY);
    if (shift.z != 0)
        at.z = nextafter(at.z, shift.z > 0 ? INFINITY : -INFINITY);
    if (reference_is_round(r, s->primitive)) {
        struct start start = reference_start(at);
        start.cone = reference_is_cone(r, s->primitive) ? s->primitive : NO_PRIMITIVE;
        start.inward = (vec3_dot(side, s->geometric) > 0) != s->enters;
        return start;
    }
    return (struct start){at, s->primitive, s->b1, s->b2, NO_PRIMITIVE, false};
}
