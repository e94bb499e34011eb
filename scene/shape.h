// What is asked of a body's shape, one function for each question: a shape is described by its cases.
//
// A new shape is a case of every `switch` over enum scene_shape, which has no default: -Wswitch, an error in
// every build, lists those that lack it (CONTRIBUTING.md, "How to add a shape"). All in double precision and
// scene units. Ownership: nothing is kept. Errors: none; a mesh that was not loaded is a body without
// triangles. Thread safety: pure.
#ifndef GLINT_SCENE_SHAPE_H
#define GLINT_SCENE_SHAPE_H

#include "scene/scene.h"

// What trees store for a body, and rays are intersected with.
enum shape_items {
    SHAPE_BALL, // it is one sphere
    SHAPE_TRIANGLES,
    SHAPE_CONE, // it is one cone
};

struct shape_traits {
    enum shape_items items;
    bool needs_mesh;  // without a mesh it does not exist
    bool is_flat;     // one plane face: two triangles that are the same surface, u and v along its edges
    bool has_radius;  // its size is the body's radius, so that its object space is as large as the scene's
    bool sees_itself; // light that leaves its surface may come back to it
};
struct shape_traits shape_traits(enum scene_shape shape);

// Whether there is something to hit: false where its mesh could not be loaded.
bool shape_is_there(const struct scene_body *body);
// How many items trees store for it.
uint32_t shape_item_count(const struct scene_body *body);
// Whether two bodies have the same surface, to the bit: shape, place and size. What it shows is not compared.
bool shape_is_same(const struct scene_body *a, const struct scene_body *b);
// What a camera focuses on, and where a light in the body sits: a sphere's centre, a parallelogram's middle,
// the middle of a cone's axis, or of the box around a mesh.
vec3 shape_middle(const struct scene_body *body);
// Of a closed body; 0 of another.
double shape_volume(const struct scene_body *body);

// A way in the own axes of a sphere or a cone.
vec3 shape_into_frame(const struct scene_body *body, vec3 way);

// ---- cones

struct shape_cone {
    vec3 from, axis; // unit
    double radius, radius_to, height;
};
struct shape_cone shape_cone_of(const struct scene_body *body);
// How far a point is from the surface; negative inside.
double shape_cone_distance(const struct shape_cone *cone, vec3 point);
// Where a line runs inside, in multiples of its direction, which need not be a unit vector; *side: whether it
// enters, and leaves, through the side, else through a disc. false: nowhere.
bool shape_cone_crossing(const struct shape_cone *cone, vec3 point, vec3 direction, double t[2],
                         bool side[2]);

#endif
