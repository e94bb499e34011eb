// Bodies in closed form: where a ray first meets one, and its normal there, from the body's own equation, for
// tests that compare tracers with it.
//
// Computed in long double, with nothing of the product's geometry: a sphere and a box by their definition, a
// cylinder or cone by the roots of its quadratic, a torus by steps as long as the distance to it. A body that
// is added to a kit shows the same surface; a torus is a smooth mesh there, within its tolerance. Ownership:
// form_add fills `room`, a zeroed mesh, for a torus; it must outlive the kit, and the caller finishes its
// arena. Thread safety: pure, but for form_add.
#ifndef GLINT_TESTS_UNIT_FORM_KIT_H
#define GLINT_TESTS_UNIT_FORM_KIT_H

#include "flat_kit.h"

enum form_kind {
    FORM_SPHERE,  // radius `a`
    FORM_FRUSTUM, // around y, from radius `a` at y = 0 to radius `b` at y = `c`; the same: a cylinder
    FORM_BOX,     // of edges `a`, `b`, `c`, around the middle
    FORM_TORUS,   // around y: radius `a`, tube `b`
};

struct form {
    const char *name;
    enum form_kind kind;
    double a, b, c;
    double tolerance; // of a torus
    vec3 place;
    vec3 turn; // degrees, about x, then y, then z
};

struct form_hit {
    double t;
    vec3 normal; // outward, unit
    bool enters;
};

void form_add(struct kit *kit, const struct form *form, struct mesh *room);

// A ball around the body.
vec3 form_middle(const struct form *form);
double form_reach(const struct form *form);
// A place deep inside: the middle; in a torus, on the circle that the tube surrounds, at a share of a turn.
vec3 form_inside(const struct form *form, double share);

// The first place of the surface at t > 0; the direction is a unit vector. `grown`: the surface of a torus is
// so far outside the true one.
bool form_first(const struct form *form, vec3 origin, vec3 direction, double grown, struct form_hit *hit);
// What is near a point of space, of a torus: the normal of the surface's nearest place, outward; how far
// outside the point is; and how far from the axis.
struct form_near {
    vec3 normal;
    double outside, around;
};
struct form_near form_near_torus(const struct form *form, vec3 point);

double form_area(const struct form *form);
double form_volume(const struct form *form);

#endif
