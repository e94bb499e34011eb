#include "core/angle.h"
#include "tools/meshgen/generators.h"

// Half of the section, (radius, height): up the outside, over the lip, down the inside to the floor of the
// vase. Few sides on purpose: a scene shows what smooth normals do to them.
static const struct {
    double radius, y;
} PROFILE[] = {
    {0.26, 0.00}, {0.30, 0.05}, {0.42, 0.22}, {0.49, 0.42}, {0.47, 0.62}, {0.36, 0.82}, {0.23, 0.98},
    {0.19, 1.10}, {0.22, 1.22}, {0.31, 1.32}, {0.30, 1.35}, {0.27, 1.34}, {0.18, 1.23}, {0.15, 1.10},
    {0.19, 0.97}, {0.32, 0.80}, {0.42, 0.61}, {0.44, 0.42}, {0.37, 0.24}, {0.24, 0.10},
};

enum {
    RINGS = sizeof PROFILE / sizeof PROFILE[0],
    SIDES = 16,
};

void vase_generate(struct mesh *mesh) {
    const double turn = 2 * PI / SIDES;
    for (int i = 0; i < RINGS; i++)
        for (int k = 0; k < SIDES; k++)
            mesh_vertex(mesh, (vec3){PROFILE[i].radius * cos(k * turn), PROFILE[i].y,
                                     PROFILE[i].radius * sin(k * turn)});
    int foot[SIDES], floor_inside[SIDES];
    for (int k = 0; k < SIDES; k++) {
        foot[k] = k;
        floor_inside[k] = (RINGS - 1) * SIDES + SIDES - 1 - k;
    }
    mesh_face(mesh, foot, SIDES);
    for (int i = 0; i + 1 < RINGS; i++) {
        for (int k = 0; k < SIDES; k++) {
            int a = i * SIDES + k, b = i * SIDES + (k + 1) % SIDES;
            mesh_quad(mesh, b, a, a + SIDES, b + SIDES);
        }
    }
    mesh_face(mesh, floor_inside, SIDES);
}
