#include "scene/transform.h"

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

mat3 transform_rotation(vec3 degrees) {
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

affine3 transform_of_model(const struct ir_model *model) {
    affine3 map = {transform_rotation(model->rotation), model->translation};
    double scale[3] = {model->scale.x, model->scale.y, model->scale.z};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            map.linear.m[i][j] *= scale[j];
    return map;
}

// By cofactors: columns of the inverse are cross products of rows, over the determinant. Entries lie within
// 1e-18 to 1e18, so that no product of three overflows.
affine3 transform_inverse(affine3 map) {
    vec3 rows[3], columns[3];
    for (int i = 0; i < 3; i++)
        rows[i] = (vec3){map.linear.m[i][0], map.linear.m[i][1], map.linear.m[i][2]};
    for (int i = 0; i < 3; i++)
        columns[i] = vec3_cross(rows[(i + 1) % 3], rows[(i + 2) % 3]);
    double determinant = vec3_dot(rows[0], columns[0]);
    affine3 inverse;
    for (int i = 0; i < 3; i++) {
        inverse.linear.m[0][i] = columns[i].x / determinant;
        inverse.linear.m[1][i] = columns[i].y / determinant;
        inverse.linear.m[2][i] = columns[i].z / determinant;
    }
    inverse.offset = vec3_neg(mat3_apply(inverse.linear, map.offset));
    return inverse;
}

// The matrix of cofactors is the inverse transpose times the determinant, whose sign is taken back.
mat3 transform_for_normals(mat3 linear) {
    double sign = mat3_determinant(linear) < 0 ? -1 : 1;
    mat3 out;
    for (int i = 0; i < 3; i++) {
        const double *p = linear.m[(i + 1) % 3];
        const double *q = linear.m[(i + 2) % 3];
        for (int k = 0; k < 3; k++)
            out.m[i][k] = sign * (p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3]);
    }
    return out;
}
