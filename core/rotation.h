// Rotations by angles in degrees, in double precision. Pure; thread-safe.
#ifndef GLINT_CORE_ROTATION_H
#define GLINT_CORE_ROTATION_H

#include "core/vec3.h"

// Rz·Ry·Rx of angles in degrees; exact for multiples of 90.
mat3 rotation_of(vec3 degrees);

#endif
