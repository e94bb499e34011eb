#include "load/import/place.h"

#include "core/angle.h"

#define DEGREES (180 / PI)
#define SHEAR   1e-6 // cosine between two axes that still counts as a right angle
#define LEAST   1e-18
#define ROOM    1e-6  // below it, ten digits of a matrix no longer say what it does
#define NOISE   1e-14 // of the largest number in a column of a matrix: what rounding leaves of 0

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

vec3 import_tidy_vector(vec3 v) {
    return (vec3){import_tidy(v.x), import_tidy(v.y), import_tidy(v.z)};
}

double import_room(mat3 linear) {
    double sizes = 1;
    for (int i = 0; i < 3; i++)
        sizes *= vec3_length(mat3_column(linear, i));
    return fabs(mat3_determinant(linear)) / sizes;
}

static affine3 tidy_matrix(affine3 map) {
    for (int i = 0; i < 3; i++) {
        const double noise = NOISE * vec3_max_abs(mat3_column(map.linear, i));
        for (int k = 0; k < 3; k++)
            map.linear.m[k][i] = fabs(map.linear.m[k][i]) < noise ? 0 : import_tidy(map.linear.m[k][i]);
    }
    return (affine3){map.linear, import_tidy_vector(map.offset)};
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
    out->is_sheared = false;
    for (int i = 0; i < 3; i++)
        out->is_sheared |= fabs(vec3_dot(axis[i], axis[(i + 1) % 3])) > SHEAR;
    out->matrix = tidy_matrix(map);
    if (out->is_sheared)
        return import_room(map.linear) >= ROOM;
    if (vec3_dot(axis[0], vec3_cross(axis[1], axis[2])) < 0) { // mirrored
        axis[0] = vec3_neg(axis[0]);
        size[0] = -size[0];
    }
    out->scale = import_tidy_vector((vec3){size[0], size[1], size[2]});
    out->rotation = angles_of(columns(axis[0], axis[1], axis[2]));
    out->translation = import_tidy_vector(map.offset);
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
