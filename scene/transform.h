// Transforms in double precision: a model's transform, inverses and what normals need.
//
// Thread safety: pure functions.
#ifndef GLINT_SCENE_TRANSFORM_H
#define GLINT_SCENE_TRANSFORM_H

#include "core/vec3.h"

// Scaled, then turned about x, y and z (degrees), then moved: T·Rz·Ry·Rx·S.
affine3 transform_of(vec3 scale, vec3 rotation, vec3 translation);
// The inverse of any map whose determinant is not 0; its offset, too.
affine3 transform_inverse(affine3 map);
// What turns normals: the inverse transpose times a positive number.
mat3 transform_for_normals(mat3 linear);
// The same map into coordinates whose origin is `origin`.
static inline affine3 transform_relative(affine3 map, vec3 origin) {
    return (affine3){map.linear, vec3_sub(map.offset, origin)};
}

#endif
