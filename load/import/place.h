// A node's matrix in the words of the language.
//
// Thread safety: pure.
#ifndef GLINT_LOAD_IMPORT_PLACE_H
#define GLINT_LOAD_IMPORT_PLACE_H

#include "core/vec3.h"

struct import_place {
    vec3 scale, rotation, translation; // degrees; T·Rz·Ry·Rx·S
    bool is_sheared;                   // only the matrix says it
    affine3 matrix;
};

// false: the matrix makes the mesh flat, or nearly so.
bool import_place_of(affine3 map, struct import_place *out);
// How much room the matrix leaves a mesh, as a share of what it has where axes stay at right angles.
double import_room(mat3 linear);
// The angles of Rz·Ry·Rx, in degrees, of the rotation whose y and z axes have these directions. Neither must
// be a unit vector, and y only has to be on the upper side.
vec3 import_rotation(vec3 y, vec3 z);
// Removes the rounding error of a number: 0.8000000000000002 becomes 0.8.
double import_tidy(double value);
vec3 import_tidy_vector(vec3 v);

#endif
