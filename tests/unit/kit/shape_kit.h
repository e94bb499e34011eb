// Closed convex bodies of few triangles around the origin, and bodies much longer than wide, for tests that
// send rays at them.
//
// Input: a kit, which owns what is made. Faces are turned outward, whatever the order of their corners.
// Lengths are the scene's units. A long ray's start and direction are in the scene, before flattening.
#ifndef GLINT_TESTS_UNIT_SHAPE_KIT_H
#define GLINT_TESTS_UNIT_SHAPE_KIT_H

#include "flat_kit.h"

struct shape {
    vec3 *corners;
    uint32_t (*faces)[3];
    uint32_t corner_count, face_count;
};

// Its corners are given, its faces are added.
void shape_init(struct kit *kit, struct shape *shape, const vec3 *corners, uint32_t corner_count,
                uint32_t most_faces);
void shape_add(struct shape *shape, uint32_t a, uint32_t b, uint32_t c);
// Both halves of a quadrilateral.
void shape_add_quad(struct shape *shape, const uint32_t corners[4]);
void shape_box(struct kit *kit, struct shape *shape, vec3 half);
// Two regular polygons across y, of these radii and at these heights, and what is between them.
struct drum {
    uint32_t sides;
    double radius[2], height[2];
};
void shape_drum(struct kit *kit, struct shape *shape, const struct drum *drum);
struct mesh *shape_mesh(struct kit *kit, const struct shape *shape);

// ---- long bodies, turned so that no coordinate is round

struct long_body {
    const char *name;
    uint32_t sides; // 0: a pair of rails, 4: a corridor of 2 x 2, else a pipe of radius 1
    double length;
};
#define LONG_RAIL_WIDTH 0.05
#define LONG_PIPE_GIRTH 6.283185307179586

// A corridor or a pipe around the camera, which is the kit's origin; rails below and ahead of it.
void long_make(struct kit *kit, const struct long_body *body);
// A ray that hits the body: from anywhere inside one that is closed; from the camera to anywhere on the
// rails, well away from their sides.
void long_ray(const struct long_body *body, uint64_t seed, vec3 *start, vec3 *direction);

#endif
