// Edges of hard shadows on a floor: of a rectangle, a sphere and a glass pane, from a point and from far
// away; seen as a whole, and so near that a pixel is a tenth of a thousandth of the scene.
#include "analytic_kit.h"
#include "core/angle.h"

#include <stdio.h>

enum blocker {
    RECTANGLE,
    SPHERE,
};

struct shadow {
    enum blocker blocker;
    bool directional, none;
    vec3 light;    // place, or the way it travels
    double margin; // of the edge, in scene units
};

// The floor is |x| < 8, |z| < 8 at y = 0, the rectangle |x| < 1, |z| < 0.5 at y = 1, the sphere of radius
// 0.75 around (0, 1, 0).
static const vec3 MIDDLE = {0, 1, 0};
static const double RADIUS = 0.75;
static const double FLOOR = 8;

// Signed distance from the edge of the shadow, about; negative inside.
static double beside(const struct shadow *s, vec3 p) {
    vec3 way = s->directional ? vec3_neg(s->light) : vec3_sub(s->light, p);
    vec3 l = vec3_unit(way);
    if (s->blocker == RECTANGLE) {
        // A light below the rectangle is not behind it.
        if (!s->directional && s->light.y < 1)
            return 1;
        vec3 q = analytic_at(p, way, 1 / way.y);
        return fmax(fabs(q.x) - 1, fabs(q.z) - 0.5);
    }
    vec3 f = vec3_sub(MIDDLE, p);
    return vec3_length(vec3_sub(f, vec3_mul(l, vec3_dot(f, l)))) - RADIUS;
}

static bool shadow_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct shadow *s = context;
    double t = analytic_plane(origin, direction, (vec3){0, 0, 0}, (vec3){0, 1, 0});
    vec3 p = analytic_at(origin, direction, t);
    if (t < 0 || fabs(p.x) > FLOOR || fabs(p.z) > FLOOR)
        return fabs(fmax(fabs(p.x), fabs(p.z)) - FLOOR) > 1e-3;
    // The body itself is beside.
    if (s->blocker == SPHERE && analytic_sphere(origin, direction, MIDDLE, RADIUS * 1.01, 0) > 0)
        return false;
    vec3 q = analytic_at(origin, direction, (1 - origin.y) / direction.y);
    if (s->blocker == RECTANGLE && fabs(q.x) < 1.01 && fabs(q.z) < 0.51)
        return false;
    double side = s->none ? 1 : beside(s, p);
    vec3 l = vec3_unit(s->directional ? vec3_neg(s->light) : vec3_sub(s->light, p));
    rgb[0] = rgb[1] = rgb[2] = side > 0 && l.y > 0 ? l.y : 0;
    return s->none || fabs(side) > s->margin;
}

static void check(struct analytic *a, const char *name, struct shadow s, const char *albedo,
                  struct analytic_camera camera, double most_beside) {
    char scene[2048], body[512];
    snprintf(
        body, sizeof body,
        s.blocker == RECTANGLE
            ? "  - {corner: [-1, 1, -0.5], edge_u: [2, 0, 0], edge_v: [0, 0, 1], material: {albedo: %s}}\n"
            : "spheres:\n  - {center: [0, 1, 0], radius: 0.75, material: {albedo: %s}}\n",
        albedo);
    snprintf(scene, sizeof scene,
             "trace: {shadows: %s}\nlights:\n  - {%s: [%.17g, %.17g, %.17g]}\nrectangles:\n"
             "  - {corner: [-8, 0, 8], edge_u: [16, 0, 0], edge_v: [0, 0, -16],"
             " material: {diffuse_color: 1}}\n%s",
             s.none ? "false" : "true", s.directional ? "direction" : "position", s.light.x, s.light.y,
             s.light.z, body);
    struct analytic_picture picture = {.name = name,
                                       .scene = scene,
                                       .camera = camera,
                                       .width = 72,
                                       .height = 48,
                                       .color = shadow_color,
                                       .context = &s,
                                       .tolerance = 2e-6,
                                       .most_beside = most_beside};
    analytic_check(a, &picture);
}

// A camera whose picture's middle is on the shadow's edge, a pixel being `pixel` wide.
static struct analytic_camera camera_at(vec3 target, double pixel) {
    vec3 position = {2, 3, 6};
    vec3 way = vec3_sub(target, position);
    double angle = 48 * pixel / vec3_length(way);
    return (struct analytic_camera){position, way, {0, 1, 0}, angle * 180 / PI};
}

int main(int argc, char **argv) {
    static const vec3 point = {-1, 3, -0.5}, sun = {1, -2, 0.75};
    // From the corner (1, 1, 0.5) of the rectangle, and the middle of its long edge, to the floor.
    static const vec3 edges[2][2] = {{{2, 0, 1}, {0.5, 0, 1}}, {{1.5, 0, 0.875}, {0.5, 0, 0.875}}};
    const struct analytic_camera whole = {{2, 3, 6}, {-2, -2.6, -6}, {0, 1, 0}, 55};
    struct analytic a;
    int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    for (int far = 0; far < 2; far++) {
        struct shadow s = {RECTANGLE, far, false, far ? sun : point, 1e-5};
        check(&a, "shadow of a rectangle", s, "[1, 0, 0, 0]", whole, 0.5);
        check(&a, "shadow of a pane of glass", s, "[0, 0, 0, 1]", whole, 0.5);
        for (int k = 0; k < 2; k++) {
            s.margin = 3e-6;
            check(&a, "edge of a rectangle's shadow", s, "[1, 0, 0, 0]", camera_at(edges[far][k], 1e-4), 0.1);
        }
        s = (struct shadow){SPHERE, far, false, far ? sun : point, 1e-5};
        check(&a, "shadow of a sphere", s, "[1, 0, 0, 0]", whole, 0.5);
        check(&a, "shadow of a glass sphere", s, "[0, 0, 0, 1]", whole, 0.5);
        s.none = true;
        check(&a, "shadows: false", s, "[1, 0, 0, 0]", whole, 0.5);
    }
    struct shadow below = {RECTANGLE, false, false, {0.25, 0.75, 0}, 1e-5};
    check(&a, "a light before the body", below, "[1, 0, 0, 0]", whole, 0.5);
    below.light = (vec3){0.25, -0.75, 0};
    check(&a, "a light under the floor", below, "[1, 0, 0, 0]", whole, 0.5);
    return analytic_close(&a);
}
