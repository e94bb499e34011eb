// Triangles against triangles, points and rays, in double precision, with the caller's tolerances.
//
// A tolerance is a length: what is nearer counts as touching, never as crossing. This keeps good meshes free
// of false alarms: a file with six digits places a vertex no better than 2^-20 of its coordinates, which is a
// billion times the rounding of the double arithmetic here, so no exact predicates are needed. Thread safety:
// pure functions.
#ifndef GLINT_LINT_SHAPE_H
#define GLINT_LINT_SHAPE_H

#include "core/vec3.h"

#include <stdint.h>

struct lint_triangle {
    vec3 p[3];
};

// With its unit normal; zero where it has no area.
struct lint_face {
    struct lint_triangle t;
    vec3 normal;
};

struct lint_box {
    vec3 lower, upper;
};

// The empty box: adding a point makes it that point.
static inline struct lint_box lint_box_empty(void) {
    return (struct lint_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}
static inline struct lint_box lint_box_join(struct lint_box a, struct lint_box b) {
    return (struct lint_box){vec3_least(a.lower, b.lower), vec3_greatest(a.upper, b.upper)};
}
static inline struct lint_box lint_box_of(const struct lint_triangle *t) {
    return (struct lint_box){vec3_least(vec3_least(t->p[0], t->p[1]), t->p[2]),
                             vec3_greatest(vec3_greatest(t->p[0], t->p[1]), t->p[2])};
}
static inline struct lint_box lint_box_grow(struct lint_box box, double by) {
    vec3 margin = {by, by, by};
    return (struct lint_box){vec3_sub(box.lower, margin), vec3_add(box.upper, margin)};
}
static inline bool lint_boxes_overlap(const struct lint_box *a, const struct lint_box *b) {
    return a->lower.x <= b->upper.x && b->lower.x <= a->upper.x && a->lower.y <= b->upper.y &&
           b->lower.y <= a->upper.y && a->lower.z <= b->upper.z && b->lower.z <= a->upper.z;
}
bool lint_box_holds(const struct lint_box *box, vec3 point);
// The box around the images of all points of `box`.
struct lint_box lint_box_place(struct lint_box box, const affine3 *place);

struct lint_triangle lint_triangle_place(struct lint_triangle triangle, const affine3 *place);
struct lint_face lint_face_of(struct lint_triangle triangle);

// Whether they cut through each other: each has corners on both sides of the other's plane, and the segments
// of the planes' common line inside them overlap (Möller 1997), each of these by more than the tolerance and
// a thousandth of the triangle's size. Triangles that share a corner or an edge do not.
bool lint_faces_cross(const struct lint_face *a, const struct lint_face *b, double tolerance);
// Whether they lie in the same plane (all six corners within `near` of the other's) and cover a common area,
// wider than the tolerance and a hundredth of the narrower one in every direction (separating axes:
// Gottschalk, Lin and Manocha 1996). Neighbours along an edge do not.
bool lint_faces_coincide(const struct lint_face *a, const struct lint_face *b, double near, double tolerance);
// A necessary condition for lint_faces_cross and lint_faces_coincide on a triangle and another's plane;
// cheaper, as it needs one normal.
bool lint_reaches_through(const struct lint_triangle *triangle, const struct lint_face *plane,
                          double tolerance);
bool lint_lies_near(const struct lint_triangle *triangle, const struct lint_face *plane, double near);
// The distance from `point` to the nearest point of a triangle (Ericson 2005, section 5.1.5).
double lint_triangle_distance(const struct lint_triangle *triangle, vec3 point);
// Where the line origin + t·direction crosses the triangle: *t, and in *side 1 where it leaves along the
// normal and -1 where it enters (Möller and Trumbore 1997, with signed volumes). false: it does not, or lies
// in its plane.
bool lint_triangle_ray(const struct lint_triangle *triangle, vec3 origin, vec3 direction, double *t,
                       int *side);

#endif
