// A block of water, 1 x 1 and 1 deep below y = 0, with ripples on its surface.
#include "tools/meshgen/generators.h"
#include "tools/meshgen/noise.h"

#include <math.h>

enum {
    CELLS = 160,
    CORNERS = CELLS + 1
};

// Long waves in one direction, short ones in others; flat at the rim.
static double ripple(double x, double z) {
    const double wind = x * 0.8 + z * 0.6, bent = wind + 0.05 * noise_fractal(x * 3, z * 3, 2, 821);
    const double rim = noise_smoothstep(0, 0.04, fmin(0.5 - fabs(x), 0.5 - fabs(z)));
    return rim * (0.0022 * sin(44 * bent) + 0.004 * noise_fractal(x * 9, z * 9, 3, 823));
}

static void side(struct mesh *mesh, int first, int step, int bottom_a, int bottom_b) {
    mesh_triangle(mesh, bottom_a, bottom_b, first + CELLS * step);
    for (int i = 0; i < CELLS; i++)
        mesh_triangle(mesh, bottom_a, first + (i + 1) * step, first + i * step);
}

void water_generate(struct mesh *mesh) {
    for (int j = 0; j < CORNERS; j++)
        for (int i = 0; i < CORNERS; i++) {
            const double x = (double)i / CELLS - 0.5, z = (double)j / CELLS - 0.5;
            mesh_vertex(mesh, (vec3){x, ripple(x, z), z});
        }
    for (int j = 0; j < CELLS; j++)
        for (int i = 0; i < CELLS; i++) {
            const int a = j * CORNERS + i;
            mesh_triangle(mesh, a, a + CORNERS, a + CORNERS + 1);
            mesh_triangle(mesh, a, a + CORNERS + 1, a + 1);
        }
    const int low = mesh_vertex(mesh, (vec3){-0.5, -1, -0.5}),
              right = mesh_vertex(mesh, (vec3){0.5, -1, -0.5}),
              both = mesh_vertex(mesh, (vec3){0.5, -1, 0.5}), near = mesh_vertex(mesh, (vec3){-0.5, -1, 0.5});
    const int last = CORNERS * CORNERS - 1;
    side(mesh, CELLS, -1, right, low);
    side(mesh, last, -CORNERS, both, right);
    side(mesh, CELLS * CORNERS, 1, near, both);
    side(mesh, 0, CORNERS, low, near);
    mesh_quad(mesh, low, right, both, near);
}
