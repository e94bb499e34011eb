#include "load/import/place.h"

#include "core/angle.h"

#define DEGREES (180 / PI)
#define SHEAR   1e-6 // cosine between two axes that still counts as a right angle
#define LEAST   1e-18

double import_tidy(double value) {
    if (value == 0 || !isfinite(value))
        return 0;
    const double unit = pow(10, floor(log10(fabs(value))) - 9);
    const double rounded = round(value / unit) * unit;
    // Powers of ten below 1 are not exact: the division gives the nearest double to the decimal number.
    return unit < 1 ? round(value / unit) / round(1 / unit) : rounded;
}

static double tidy_angle(double degrees) {
    return round(degrees * 1e7) / 1e7 + 0;
}

// Angles of a rotation matrix (Slabaugh 1999).
static vec3 angles_of(mat3 r) {
    const double across = hypot(r.m[0][0], r.m[1][0]);
    double x, z = 0;
    if (across > 1e-9) {
        x = atan2(r.m[2][1], r.m[2][2]);
        z = atan2(r.m[1][0], r.m[0][0]);
    } else {
        x = atan2(-r.m[1][2], r.m[1][1]);
    }
    double y = atan2(-r.m[2][0], across);
    // The same turn has two sets of angles: the one that is easier to read.
    if (fabs(x) > PI / 2 && fabs(z) > PI / 2) {
        x -= copysign(PI, x);
        z -= copysign(PI, z);
        y = copysign(PI, y) - y;
    }
    return (vec3){tidy_angle(x * DEGREES), tidy_angle(y * DEGREES), tidy_angle(z * DEGREES)};
}

static mat3 columns(vec3 x, vec3 y, vec3 z) {
    return (mat3){{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
}

bool import_place_of(affine3 map, struct import_place *out) {
    vec3 axis[3];
    double size[3];
    for (int i = 0; i < 3; i++) {
        axis[i] = mat3_column(map.linear, i);
        size[i] = vec3_length(axis[i]);
        if (!(size[i] >= LEAST))
            return false;
        axis[i] = vec3_unit(axis[i]);
    }
    for (int i = 0; i < 3; i++)
        if (fabs(vec3_dot(axis[i], axis[(i + 1) % 3])) > SHEAR)
            return false;
    if (vec3_dot(axis[0], vec3_cross(axis[1], axis[2])) < 0) { // mirrored
        axis[0] = vec3_neg(axis[0]);
        size[0] = -size[0];
    }
    out->scale = (vec3){import_tidy(size[0]), import_tidy(size[1]), import_tidy(size[2])};
    out->rotation = angles_of(columns(axis[0], axis[1], axis[2]));
    out->translation =
        (vec3){import_tidy(map.offset.x), import_tidy(map.offset.y), import_tidy(map.offset.z)};
    return true;
}

vec3 import_rotation(vec3 y, vec3 z) {
    const vec3 forward = vec3_unit(z);
    vec3 side = vec3_cross(y, forward);
    if (vec3_is_zero(side))
        side = vec3_cross((vec3){0, fabs(forward.y) < 0.9, fabs(forward.y) >= 0.9}, forward);
    side = vec3_unit(side);
    return angles_of(columns(side, vec3_cross(forward, side), forward));
}
