#include "scene/transform.h"

affine3 transform_of(vec3 scale, vec3 rotation, vec3 translation) {
    affine3 map = {mat3_rotation(rotation), translation};
    const double by[3] = {scale.x, scale.y, scale.z};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            map.linear.m[i][j] *= by[j];
    return map;
}

// By cofactors: columns of the inverse are cross products of rows, over the determinant. Entries lie within
// 1e-18 to 1e18, so no product of three overflows.
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

// The matrix of cofactors is the inverse transpose times the determinant; here the determinant's sign is
// removed.
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
