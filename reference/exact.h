// What double precision leaves open about a ray and a triangle, decided with twice the digits. Private to
// reference/.
//
// Begin with exact_begin, once per ray. Positions as in parts.h. Errors: none. Thread safety: pure.
#ifndef GLINT_REFERENCE_EXACT_H
#define GLINT_REFERENCE_EXACT_H

#include "reference/reference_internal.h"
#include "reference/wide.h"

struct exact_ray {
    struct wide3 origin; // on the triangle that the ray leaves, if it leaves one
    vec3 direction;
    int axes[3]; // the last one: the axis of the direction's largest component
    struct wide sx, sy;
    double unit;                  // unit of the scene's numbers
    const struct primitive *left; // NULL: none
    struct primitive left_room;   // holds a triangle of an instance
    vec3 left_normal;
};

void exact_begin(const struct reference *r, const struct ray *ray, const int axes[3], struct exact_ray *out);

// The hit at t > 0, ignoring t_max. t_error: how far the rounding of the scene's own numbers moves t.
bool exact_intersect(const struct exact_ray *ray, const struct primitive *p, struct intersection *out);

// How far the rounding of the scene's numbers moves the place where a ray hits the triangle, in units of the
// ray's t.
double exact_blur(const struct primitive *p, vec3 direction, double unit);

// The unit normal, from the corners as stored.
vec3 exact_normal(const struct primitive *p);

#endif
