#include "tools/meshgen/lathe.h"

#include "core/angle.h"
#include "core/heap.h"

#include <math.h>
#include <stdlib.h>

static int place_ring(struct mesh *mesh, struct lathe_point at, int sides) {
    const double turn = 2 * PI / sides;
    int first = 0;
    for (int k = 0; k < sides; k++) {
        const vec3 corner = {at.radius * cos(k * turn), at.y, at.radius * sin(k * turn)};
        const int vertex = mesh_vertex(mesh, corner);
        first = k ? first : vertex;
    }
    return first;
}

void lathe_turn(struct mesh *mesh, const struct lathe_point *section, int count, int sides) {
    int before = mesh_vertex(mesh, (vec3){0, section[0].y, 0});
    for (int i = 1; i < count; i++) {
        const bool last = i == count - 1;
        const int ring =
            last ? mesh_vertex(mesh, (vec3){0, section[i].y, 0}) : place_ring(mesh, section[i], sides);
        for (int k = 0; k < sides; k++) {
            const int next = (k + 1) % sides;
            if (i == 1)
                mesh_face(mesh, (const int[3]){before, ring + k, ring + next}, 3);
            else if (last)
                mesh_face(mesh, (const int[3]){before + next, before + k, ring}, 3);
            else
                mesh_quad(mesh, before + next, before + k, ring + k, ring + next);
        }
        before = ring;
    }
}

static double curve(double a, double b, double c, double d, double t) {
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

void lathe_turn_curve(struct mesh *mesh, const struct lathe_point *section, int count, int steps, int sides) {
    const int fine = (count - 1) * steps + 1;
    struct lathe_point *points = heap_array(heap_times(count, steps), sizeof *points);
    if (!points) {
        mesh->failed = true;
        return;
    }
    for (int i = 0; i < fine; i++) {
        const int k = i / steps, next = k + 1 < count ? k + 1 : k;
        const struct lathe_point a = section[k ? k - 1 : 0], b = section[k], c = section[next],
                                 d = section[next + 1 < count ? next + 1 : next];
        const double t = (double)(i % steps) / steps;
        points[i] = (struct lathe_point){curve(a.radius, b.radius, c.radius, d.radius, t),
                                         fmax(section[0].y, curve(a.y, b.y, c.y, d.y, t))};
    }
    lathe_turn(mesh, points, fine, sides);
    free(points);
}
