#include "core/rotation.h"

#define DEGREE 0.017453292519943295769 // pi / 180

struct turn {
    double sine, cosine;
};

// Reduced to -45..45 degrees without rounding (remquo is exact), so that quarter turns are.
static struct turn turn_of(double degrees) {
    int quarter;
    double rest = remquo(degrees, 90, &quarter) * DEGREE;
    double s = sin(rest);
    double c = cos(rest);
    switch (quarter & 3) {
    case 0:
        return (struct turn){s, c};
    case 1:
        return (struct turn){c, -s};
    case 2:
        return (struct turn){-s, -c};
    default:
        return (struct turn){-c, s};
    }
}

mat3 rotation_of(vec3 degrees) {
    struct turn x = turn_of(degrees.x);
    struct turn y = turn_of(degrees.y);
    struct turn z = turn_of(degrees.z);
    mat3 rx = {{{1, 0, 0}, {0, x.cosine, -x.sine}, {0, x.sine, x.cosine}}};
    mat3 ry = {{{y.cosine, 0, y.sine}, {0, 1, 0}, {-y.sine, 0, y.cosine}}};
    mat3 rz = {{{z.cosine, -z.sine, 0}, {z.sine, z.cosine, 0}, {0, 0, 1}}};
    mat3 all = mat3_mul(rz, mat3_mul(ry, rx));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            all.m[i][j] += 0.0; // no -0
    return all;
}
