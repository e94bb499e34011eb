// Spot lights on a wall: the square of a ramp between the cosines of two angles, as KHR_lights_punctual has
// it.
#include "analytic_kit.h"

#include <stdio.h>

struct spot {
    vec3 position, look_at;
    double angle, softness;
    bool by_direction, inverse_square;
};

static const double RADIANS = 0.017453292519943295;

#define WALL                                                                                                 \
    "rectangles:\n  - {corner: [-4, -3, -4], edge_u: [8, 0, 0], edge_v: [0, 6, 0], material: "               \
    "wall}\n"                                                                                                \
    "materials: {wall: {diffuse_color: 1}}\n"

static bool wall_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct spot *s = context;
    const double t = analytic_plane(origin, direction, (vec3){0, 0, -4}, (vec3){0, 0, 1});
    const vec3 to_light = vec3_sub(s->position, analytic_at(origin, direction, t));
    const vec3 axis = vec3_sub(s->look_at, s->position);
    const double distance = sqrt(vec3_dot(to_light, to_light));
    const double cosine = -vec3_dot(to_light, axis) / distance / sqrt(vec3_dot(axis, axis));
    const double outer = cos(s->angle / 2 * RADIANS), inner = cos(s->angle / 2 * (1 - s->softness) * RADIANS);
    double share = cosine >= outer ? 1 : 0;
    if (inner > outer)
        share = fmin(fmax((cosine - outer) / (inner - outer), 0), 1);
    else if (fabs(acos(cosine) - s->angle / 2 * RADIANS) < 2e-6)
        return false;
    const double facing = fmax(to_light.z / distance, 0);
    const double light = share * share * facing / (s->inverse_square ? distance * distance : 1);
    rgb[0] = light;
    rgb[1] = 0.5 * light;
    rgb[2] = 0.25 * light;
    return true;
}

static void check(struct analytic *a, struct spot s) {
    char scene[1024], light[512], name[128];
    const vec3 aim = s.by_direction ? vec3_mul(vec3_sub(s.look_at, s.position), 0.125) : s.look_at;
    snprintf(name, sizeof name, "spot of %g, softness %g%s", s.angle, s.softness,
             s.by_direction ? ", by its direction" : "");
    snprintf(light, sizeof light,
             "lights: [{position: [%.17g, %.17g, %.17g], color: [1, 0.5, 0.25], falloff: %s, spot: {%s: "
             "[%.17g, %.17g, "
             "%.17g], angle: %.17g, softness: %.17g}}]",
             s.position.x, s.position.y, s.position.z, s.inverse_square ? "inverse_square" : "none",
             s.by_direction ? "direction" : "look_at", aim.x, aim.y, aim.z, s.angle, s.softness);
    snprintf(scene, sizeof scene, "%s\n%s", light, WALL);
    // A single-precision unit vector is off by some 1e-7, which a narrow ramp makes larger by its slope.
    const double ramp = s.softness * s.angle / 2 * RADIANS;
    const struct analytic_picture picture = {
        .name = name,
        .scene = scene,
        // so near that narrow cones are wider than pixels
        .camera = {.forward = s.look_at, .fov = s.angle > 0 && s.angle < 20 ? 2 * s.angle : 60},
        .color = wall_color,
        .context = &s,
        .tolerance = 1e-5 + (ramp > 0 ? 4e-7 / ramp : 0),
        .most_beside = 0.02};
    analytic_check(a, &picture);
}

// The same light at the origin of an object that is turned and moved: an instance turned by 180 degrees about
// y looks back.
static bool turned_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct spot *s = context;
    struct spot seen = *s;
    seen.position = (vec3){-s->position.x + 1, s->position.y, -s->position.z};
    seen.look_at = (vec3){-s->look_at.x + 1, s->look_at.y, -s->look_at.z};
    return wall_color(&seen, origin, direction, rgb);
}

static void check_turned(struct analytic *a, struct spot s) {
    char scene[1024];
    snprintf(scene, sizeof scene,
             "instances:\n"
             "  - rotation: [0, 180, 0]\n    translation: [1, 0, 0]\n"
             "    object: {lights: [{position: [%.17g, %.17g, %.17g], color: [1, 0.5, 0.25], spot: {look_at: "
             "[%.17g, %.17g, "
             "%.17g], angle: %.17g, softness: %.17g}}]}\n" WALL,
             s.position.x, s.position.y, s.position.z, s.look_at.x, s.look_at.y, s.look_at.z, s.angle,
             s.softness);
    const struct analytic_picture picture = {.name = "spot in a turned instance",
                                             .scene = scene,
                                             .color = turned_color,
                                             .context = &s,
                                             .tolerance = 1e-5,
                                             .most_beside = 0.02};
    analytic_check(a, &picture);
}

int main(int argc, char **argv) {
    struct analytic a;
    int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    const vec3 near = {0.5, 0.25, -1}, beside = {-2, 1, -2}, wall = {0.25, 0, -4};
    static const double angles[] = {180, 120, 45, 10, 0.5};
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        check(&a, (struct spot){.position = near, .look_at = wall, .angle = angles[i], .softness = 0.15});
        check(&a, (struct spot){.position = near, .look_at = wall, .angle = angles[i], .softness = 1});
        check(&a,
              (struct spot){.position = beside, .look_at = wall, .angle = angles[i], .by_direction = true});
        check(&a, (struct spot){.position = beside,
                                .look_at = wall,
                                .angle = angles[i],
                                .softness = 0.5,
                                .inverse_square = true});
    }
    check(&a, (struct spot){.position = near, .look_at = wall, .softness = 0.5}); // of no width
    check_turned(
        &a, (struct spot){.position = {0.5, 0.25, 1}, .look_at = {0.25, 0, 4}, .angle = 45, .softness = 0.5});
    return analytic_close(&a);
}
