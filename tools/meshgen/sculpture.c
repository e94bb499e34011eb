#include "core/angle.h"
#include "tools/meshgen/generators.h"

// The ribbon's middle line winds twice round the axis and three times through the hole of a torus. Its
// section is a superellipse, long across the ribbon; it makes TURN_HALVES half turns against the torus, so
// that after one round the section meets itself turned, and the two faces of the ribbon are one.
enum {
    STEPS_ALONG = 640,
    STEPS_ROUND = 48,
    WINDS_ROUND = 2,
    WINDS_THROUGH = 3,
    TURN_HALVES = 3,
};

static const double TORUS_RADIUS = 1.0;
static const double TUBE_RADIUS = 0.46;
static const double RIBBON_HALF_WIDTH = 0.27;
static const double RIBBON_HALF_THICKNESS = 0.075;
static const double SECTION_POWER = 0.8; // 1 would be an ellipse, less is fuller

// Signed power, for the superellipse.
static double fuller(double x) {
    return copysign(pow(fabs(x), SECTION_POWER), x);
}

static vec3 middle_line(double t) {
    double ring = TORUS_RADIUS + TUBE_RADIUS * cos(WINDS_THROUGH * t);
    return (vec3){ring * cos(WINDS_ROUND * t), ring * sin(WINDS_ROUND * t),
                  TUBE_RADIUS * sin(WINDS_THROUGH * t)};
}

static vec3 surface(double t, double angle) {
    vec3 centre = middle_line(t);
    vec3 tangent = vec3_unit(vec3_sub(middle_line(t + 1e-4), middle_line(t - 1e-4)));
    vec3 outward = {cos(WINDS_THROUGH * t) * cos(WINDS_ROUND * t),
                    cos(WINDS_THROUGH * t) * sin(WINDS_ROUND * t), sin(WINDS_THROUGH * t)};
    vec3 across = vec3_unit(vec3_cross(tangent, outward));
    vec3 up = vec3_cross(across, tangent);
    double turn = 0.5 * TURN_HALVES * t;
    vec3 wide = vec3_add(vec3_mul(across, cos(turn)), vec3_mul(up, sin(turn)));
    vec3 thin = vec3_cross(tangent, wide);
    return vec3_add(centre, vec3_add(vec3_mul(wide, RIBBON_HALF_WIDTH * fuller(cos(angle))),
                                     vec3_mul(thin, RIBBON_HALF_THICKNESS * fuller(sin(angle)))));
}

// Central differences of the surface itself: the superellipse has no simple normal once it is swept.
static vec3 surface_normal(double t, double angle) {
    vec3 along = vec3_sub(surface(t + 1e-4, angle), surface(t - 1e-4, angle));
    vec3 round = vec3_sub(surface(t, angle + 1e-3), surface(t, angle - 1e-3));
    return vec3_unit(vec3_cross(round, along));
}

// Row `i` may lie one past the end, where the section has turned by TURN_HALVES half turns.
static int vertex_at(int i, int j) {
    int turned = i == STEPS_ALONG ? TURN_HALVES * STEPS_ROUND / 2 : 0;
    return i % STEPS_ALONG * STEPS_ROUND + (j + turned) % STEPS_ROUND;
}

void sculpture_generate(struct mesh *mesh) {
    for (int i = 0; i < STEPS_ALONG; i++) {
        for (int j = 0; j < STEPS_ROUND; j++) {
            double t = 2 * PI * i / STEPS_ALONG, angle = 2 * PI * (j + 0.5) / STEPS_ROUND;
            mesh_vertex_normal(mesh, surface(t, angle), surface_normal(t, angle));
        }
    }
    for (int i = 0; i < STEPS_ALONG; i++) {
        for (int j = 0; j < STEPS_ROUND; j++) {
            int a = vertex_at(i, j), b = vertex_at(i, j + 1), c = vertex_at(i + 1, j + 1),
                d = vertex_at(i + 1, j);
            mesh_triangle(mesh, a, b, c);
            mesh_triangle(mesh, a, c, d);
        }
    }
}
