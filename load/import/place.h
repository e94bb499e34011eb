// A node's matrix in the words of the language.
//
// Thread safety: pure.
#ifndef GLINT_LOAD_IMPORT_PLACE_H
#define GLINT_LOAD_IMPORT_PLACE_H

#include "core/vec3.h"

struct import_place {
    vec3 scale, rotation, translation; // degrees; T·Rz·Ry·Rx·S
};

// false: the matrix also shears, or makes the mesh flat.
bool import_place_of(affine3 map, struct import_place *out);
// The angles of Rz·Ry·Rx, in degrees, of a matrix with the directions of y and z as here; both need not be
// unit, and y only be on the side that is up.
vec3 import_rotation(vec3 y, vec3 z);
// Without what rounding leaves of a number, so that 0.8 is not 0.8000000000000002.
double import_tidy(double value);

#endif
