// The air of the landscape: the sun, the colour of the clear sky, clouds, and haze before what is far.
//
// Colours are linear. Directions are unit vectors, y up. Thread safety: pure functions.
#ifndef GLINT_MESHGEN_AIR_H
#define GLINT_MESHGEN_AIR_H

#include "core/vec3.h"

// Where the sun stands, and its light on a surface that faces it.
vec3 air_sun_direction(void);
vec3 air_sun_colour(void);

// Sky with sun and clouds; directions below the horizon give the horizon's colour.
vec3 air_colour(vec3 direction);

// What a surface `distance_km` away in `direction` looks like through the air.
vec3 air_haze(vec3 colour, vec3 direction, double distance_km);

vec3 air_mix(vec3 a, vec3 b, double t);

#endif
