#include "core/angle.h"
#include "tools/meshgen/generators.h"

// Proportions of a round brilliant, the girdle's radius being 1. The kites are planar because their side
// corners are placed on the plane of the main facet, wherever along it the star or lower facet ends.
static const double TABLE_RADIUS = 0.56;
static const double CROWN_ANGLE_DEG = 34.5;
static const double PAVILION_ANGLE_DEG = 40.75;
static const double STAR_TIP_RADIUS = 0.76;
static const double LOWER_TIP_RADIUS = 0.24;
static const double GIRDLE_HALF_HEIGHT = 0.02;

enum {
    FOLDS = 8
};

// `steps` sixteenths of a turn about y.
static vec3 ring_point(double radius, double y, int steps) {
    double angle_rad = PI * steps / FOLDS;
    return (vec3){radius * cos(angle_rad), y, radius * sin(angle_rad)};
}

// Height above (or below) the girdle of a main facet's plane at an azimuth half way between two mains.
static double rise_between(double angle_deg, double radius) {
    return tan(angle_deg * PI / 180) * (1 - radius * cos(PI / FOLDS));
}

struct half {
    int inner[FOLDS];      // table corners; the culet, repeated, for the pavilion
    int tips[FOLDS];       // between mains k and k + 1
    int girdle[2 * FOLDS]; // even ones on the mains' azimuths
};

static void place_half(struct mesh *mesh, struct half *half, bool crown) {
    double sign = crown ? 1 : -1;
    double angle_deg = crown ? CROWN_ANGLE_DEG : PAVILION_ANGLE_DEG;
    double tip_radius = crown ? STAR_TIP_RADIUS : LOWER_TIP_RADIUS;
    double inner_radius = crown ? TABLE_RADIUS : 0;
    double inner_rise = tan(angle_deg * PI / 180) * (1 - inner_radius);
    int culet = crown ? 0 : mesh_vertex(mesh, (vec3){0, -(GIRDLE_HALF_HEIGHT + inner_rise), 0});
    for (int k = 0; k < FOLDS; k++) {
        double tip_y = sign * (GIRDLE_HALF_HEIGHT + rise_between(angle_deg, tip_radius));
        double inner_y = sign * (GIRDLE_HALF_HEIGHT + inner_rise);
        half->inner[k] = crown ? mesh_vertex(mesh, ring_point(inner_radius, inner_y, 2 * k)) : culet;
        half->tips[k] = mesh_vertex(mesh, ring_point(tip_radius, tip_y, 2 * k + 1));
    }
    for (int j = 0; j < 2 * FOLDS; j++)
        half->girdle[j] = mesh_vertex(mesh, ring_point(1, sign * GIRDLE_HALF_HEIGHT, j));
}

// Azimuth grows from +x to +z, which is clockwise seen from above (+y).
static void join_half(struct mesh *mesh, const struct half *half, bool crown) {
    for (int k = 0; k < FOLDS; k++) {
        int before = half->tips[(k + FOLDS - 1) % FOLDS], after = half->tips[k];
        int low = half->girdle[2 * k], middle = half->girdle[2 * k + 1];
        int next = half->girdle[(2 * k + 2) % (2 * FOLDS)];
        if (crown) {
            mesh_quad(mesh, half->inner[k], after, low, before);
            mesh_triangle(mesh, half->inner[k], half->inner[(k + 1) % FOLDS], after);
            mesh_triangle(mesh, after, middle, low);
            mesh_triangle(mesh, after, next, middle);
        } else {
            mesh_quad(mesh, half->inner[k], before, low, after);
            mesh_triangle(mesh, after, low, middle);
            mesh_triangle(mesh, after, middle, next);
        }
    }
}

void gem_generate(struct mesh *mesh) {
    struct half crown, pavilion;
    place_half(mesh, &crown, true);
    place_half(mesh, &pavilion, false);
    int table[FOLDS];
    for (int k = 0; k < FOLDS; k++)
        table[k] = crown.inner[FOLDS - 1 - k];
    mesh_face(mesh, table, FOLDS);
    join_half(mesh, &crown, true);
    for (int j = 0; j < 2 * FOLDS; j++) {
        int next = (j + 1) % (2 * FOLDS);
        mesh_quad(mesh, crown.girdle[j], crown.girdle[next], pavilion.girdle[next], pavilion.girdle[j]);
    }
    join_half(mesh, &pavilion, false);
}
