// Mountains round a lake, as heights on rings about the eye, and their colours.
//
// Kilometres; the lake's surface is at height 0. Column i looks in azimuth 2 pi (i + 1/2) / columns - pi,
// from +x to +z; ring j lies at land_distance(j). Ownership: land_create's result is freed with
// land_destroy. Thread safety: read-only after creation.
#ifndef GLINT_MESHGEN_LAND_H
#define GLINT_MESHGEN_LAND_H

#include "core/vec3.h"

enum {
    LAND_RINGS = 1280
};

struct land {
    int columns;
    float *heights; // [column][ring]
};

// Heights of all columns, on all processors. NULL: out of memory.
struct land *land_create(int columns);
void land_destroy(struct land *land);

double land_distance(int ring);
double land_azimuth(const struct land *land, int column);

// Light from the ground at a column and ring, before the air (linear).
vec3 land_colour(const struct land *land, int column, int ring);

#endif
