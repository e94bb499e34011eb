// Lights that are seen (docs/language.md, "Lights that are seen"): what they look like from the front, in a
// mirror, through a pane and in a coloured medium, and that what is seen of them is what they light by.
#include "analytic_kit.h"
#include "core/angle.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// So near an outline, as a part of the light's size, either side is right.
#define EDGE 2e-3

enum {
    TEXT = 4096,
};

enum sight {
    SEEN,
    NOT_SEEN,
    AT_EDGE
};

struct panel {
    vec3 corner, edge_u, edge_v;
};

// ---- where rays come to

static enum sight see_ball(vec3 origin, vec3 direction, vec3 center, double radius, double *t) {
    const vec3 way = vec3_sub(center, origin);
    const double middle = vec3_dot(way, direction);
    const double beside = vec3_length(vec3_sub(way, vec3_mul(direction, middle)));
    *t = middle - sqrt(fmax(0, radius * radius - beside * beside));
    if (middle < 0 || beside > radius * (1 + EDGE))
        return NOT_SEEN;
    return beside < radius * (1 - EDGE) ? SEEN : AT_EDGE;
}

// `both`: from behind too, as a body is.
static enum sight see_sheet(vec3 origin, vec3 direction, const struct panel *p, bool both, double *t) {
    const vec3 n = vec3_cross(p->edge_u, p->edge_v);
    const double below = vec3_dot(n, direction);
    *t = vec3_dot(n, vec3_sub(p->corner, origin)) / below;
    if (!(*t > 1e-9) || (!both && below >= 0))
        return NOT_SEEN;
    const vec3 q = vec3_sub(analytic_at(origin, direction, *t), p->corner);
    const double nn = vec3_dot(n, n), a = vec3_dot(vec3_cross(q, p->edge_v), n) / nn,
                 b = vec3_dot(vec3_cross(p->edge_u, q), n) / nn;
    const double out = fmax(fmax(-a, a - 1), fmax(-b, b - 1));
    return out > EDGE ? NOT_SEEN : out < -EDGE ? SEEN : AT_EDGE;
}

static enum sight see_disc(vec3 direction, vec3 to_light, double half_angle) {
    const double angle = acos(fmin(1, vec3_dot(direction, vec3_unit(to_light))));
    if (angle > half_angle * (1 + EDGE))
        return NOT_SEEN;
    return angle < half_angle * (1 - EDGE) ? SEEN : AT_EDGE;
}

// ---- three lights, a wall before one of them, a mirror as the floor, a pane

static const vec3 BALL = {-1.2, 0.9, -6};
static const double BALL_RADIUS = 0.8;
static const struct panel PANEL = {{0.8, -0.4, -5}, {1.2, 0, 0.3}, {0, 1, 0.2}};
static const struct panel AWAY = {{-0.2, 1.6, -5}, {0, 0.8, 0}, {0.8, 0, 0}}; // shines to the other side
static const vec3 TO_SUN = {0.25, 0.5, -1};
static const struct panel WALL = {{-2.5, 0.7, -4}, {1.5, 0, 0}, {0, 0.4, 0}};
static const struct panel PANE = {{0.9, 0.1, -3}, {0.5, 0, 0}, {0, 0.3, 0}};
static const struct panel MIRROR = {{-9, -1, 0}, {18, 0, 0}, {0, 0, -18}};
static const char three[] =
    "background: {color: [0.125, 0.25, 0.5]}\n"
    "lights:\n"
    "  - {position: [-1.2, 0.9, -6], radius: 0.8, intensity: 3, color: [1, 0.5, 0.25], falloff: "
    "inverse_square, visible: "
    "true}\n"
    "  - {rectangle: {corner: [0.8, -0.4, -5], edge_u: [1.2, 0, 0.3], edge_v: [0, 1, 0.2]}, intensity: 0.25, "
    "visible: true}\n"
    "  - {rectangle: {corner: [-0.2, 1.6, -5], edge_u: [0, 0.8, 0], edge_v: [0.8, 0, 0]}, visible: true}\n"
    "  - {direction: [-0.25, -0.5, 1], angle: 16, intensity: 0.5, visible: true}\n"
    "  - {direction: [0.25, -0.5, 1], angle: 16}\n"
    "materials:\n"
    "  dark: {albedo: [0, 0, 0, 0]}\n"
    "rectangles:\n"
    "  - {corner: [-2.5, 0.7, -4], edge_u: [1.5, 0, 0], edge_v: [0, 0.4, 0], material: dark}\n"
    "  - {corner: [0.9, 0.1, -3], edge_u: [0.5, 0, 0], edge_v: [0, 0.3, 0], material: {albedo: [0, 0, 0, "
    "0.5]}}\n"
    "  - {corner: [-9, -1, 0], edge_u: [18, 0, 0], edge_v: [0, 0, -18], material: {albedo: [0, 0, 0.75, "
    "0]}}\n";

static void add(double rgb[3], double weight, vec3 color) {
    rgb[0] += weight * color.x;
    rgb[1] += weight * color.y;
    rgb[2] += weight * color.z;
}

static vec3 panel_radiance(vec3 eye) {
    const vec3 middle = vec3_add(PANEL.corner, vec3_mul(vec3_add(PANEL.edge_u, PANEL.edge_v), 0.5));
    const double far = vec3_length(vec3_sub(middle, eye));
    const double size = vec3_length(vec3_cross(PANEL.edge_u, PANEL.edge_v)),
                 value = PI * 0.25 * far * far / size;
    return (vec3){value, value, value};
}

struct nearest {
    double t;
    int what; // -1: the background
};

static bool find(vec3 origin, vec3 direction, int from, struct nearest *found) {
    double t[6];
    const enum sight s[6] = {see_ball(origin, direction, BALL, BALL_RADIUS, &t[0]),
                             see_sheet(origin, direction, &PANEL, false, &t[1]),
                             see_sheet(origin, direction, &AWAY, false, &t[2]),
                             see_sheet(origin, direction, &WALL, true, &t[3]),
                             see_sheet(origin, direction, &PANE, true, &t[4]),
                             see_sheet(origin, direction, &MIRROR, true, &t[5])};
    *found = (struct nearest){INFINITY, -1};
    for (int i = 0; i < 6; i++) {
        if (s[i] == AT_EDGE)
            return false;
        if (s[i] == SEEN && i != from && t[i] < found->t)
            *found = (struct nearest){t[i], i};
    }
    return true;
}

static bool three_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const vec3 eye = *(const vec3 *)context;
    double weight = 1;
    struct nearest at = {0, -1};
    for (int depth = 0; depth < 4; depth++) {
        if (!find(origin, direction, at.what, &at))
            return false;
        const double ball = 3 / (BALL_RADIUS * BALL_RADIUS);
        switch (at.what) {
        case 0:
            add(rgb, weight, (vec3){ball, ball * 0.5, ball * 0.25});
            return true;
        case 1:
            add(rgb, weight, panel_radiance(eye));
            return true;
        case 3:
            return true;
        case 4:
            weight *= 0.5;
            break;
        case 5:
            weight *= 0.75;
            origin = analytic_at(origin, direction, at.t);
            direction = analytic_mirrored(direction, (vec3){0, 1, 0});
            break;
        default: {
            const double half = 8 * PI / 180, sun = 0.5 / (sin(half) * sin(half));
            const enum sight sight = see_disc(direction, TO_SUN, half);
            add(rgb, weight, (vec3){0.125, 0.25, 0.5});
            if (sight == SEEN)
                add(rgb, weight, (vec3){sun, sun, sun});
            return sight != AT_EDGE;
        }
        }
    }
    return false;
}

static void check_three(struct analytic *a, const char *precision) {
    char text[TEXT], name[64];
    const vec3 eye = {0.1, 0.2, 1};
    snprintf(name, sizeof name, "three lights, %s precision", precision);
    snprintf(text, sizeof text, "trace: {precision: %s}\n%s", precision, three);
    const struct analytic_picture picture = {.name = name,
                                             .scene = text,
                                             .camera = {.position = eye, .fov = 55},
                                             .width = 180,
                                             .height = 120,
                                             .color = three_color,
                                             .context = &eye,
                                             .tolerance = 1e-5,
                                             .most_beside = 0.1};
    analytic_check(a, &picture);
}

// ---- in a coloured ball of index 1, whose middle is the lamp's

struct amber {
    double radius, lamp;
};

static bool amber_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct amber *amber = context;
    static const double left[3] = {0.5, 0.25, 0.125};
    const vec3 middle = {0, 0, -5};
    double outer, inner;
    const enum sight ball = see_ball(origin, direction, middle, amber->radius, &outer),
                     lamp = see_ball(origin, direction, middle, amber->lamp, &inner);
    const double chord = 2 * (vec3_dot(vec3_sub(middle, origin), direction) - outer);
    for (int c = 0; c < 3; c++) {
        const double way = lamp == SEEN ? inner - outer : ball == SEEN ? chord : 0;
        rgb[c] = (lamp == SEEN ? 2 / (amber->lamp * amber->lamp) : 1) * pow(left[c], way);
    }
    return ball != AT_EDGE && lamp != AT_EDGE;
}

static void check_amber(struct analytic *a, const char *precision) {
    char text[TEXT], name[64];
    const struct amber amber = {1.5, 0.5};
    snprintf(name, sizeof name, "in amber, %s precision", precision);
    snprintf(text, sizeof text,
             "trace: {precision: %s}\nbackground: {color: 1}\n"
             "lights: [{position: [0, 0, -5], radius: 0.5, intensity: 2, falloff: inverse_square, visible: "
             "true}]\n"
             "spheres:\n  - {center: [0, 0, -5], radius: 1.5, material: {albedo: [0, 0, 0, 1], "
             "refractive_index: 1,"
             " attenuation_color: [0.5, 0.25, 0.125]}}\n",
             precision);
    const struct analytic_picture picture = {.name = name,
                                             .scene = text,
                                             .camera = {.fov = 50},
                                             .color = amber_color,
                                             .context = &amber,
                                             .tolerance = 2e-5,
                                             .most_beside = 0.1};
    analytic_check(a, &picture);
}

// ---- the light of what is seen

// The mean over all pixels of the first channel.
static double mean_of(struct analytic *a, const char *name, const char *scene, struct analytic_camera camera,
                      int32_t samples) {
    const struct analytic_picture picture = {
        .name = name, .scene = scene, .camera = camera, .width = 8, .height = 8, .samples = samples};
    struct image image;
    double sum = 0;
    if (!analytic_take(a, &picture, &image))
        return (double)NAN;
    for (int i = 0; i < 64; i++)
        sum += (double)image.rgb[3 * i] / 64;
    free(image.rgb);
    return sum;
}

// A white floor shows the radiance of the light times its view factor from there: that of the light itself is
// measured in a picture, not known here. Howell's catalogue has the view factors of a sphere and a disc; of
// the panel, parallel to the floor and right above, four times that of a quarter.
static void check_factor(struct analytic *a, const char *name, const char *light, vec3 from, vec3 towards,
                         double factor) {
    char scene[TEXT];
    snprintf(
        scene, sizeof scene,
        "lights: [{%s, visible: true}]\nrectangles:\n"
        "  - {corner: [-5, 0, 5], edge_u: [10, 0, 0], edge_v: [0, 0, -10], material: {diffuse_color: 1}}\n",
        light);
    const struct analytic_camera at_light = {
        .position = from, .forward = towards, .up = {1, 0, 0.1}, .fov = 0.01};
    const struct analytic_camera at_floor = {
        .position = {0.001, 0.5, 0.002}, .forward = {0, -1, 0}, .up = {0, 0, -1}, .fov = 0.01};
    // Without falloff a light looks as bright as it lights the place of the camera: there is one at the floor
    // too.
    const double radiance = mean_of(a, name, scene, at_light, 1),
                 lit = mean_of(a, name, scene, at_floor, 1024);
    printf("%s: radiance %.6g, on the floor %.6g, by its view factor %.6g\n", name, radiance, lit,
           radiance * factor);
    analytic_expect(a, fabs(lit / (radiance * factor) - 1) < 2e-3, name,
                    "does not light by what is seen of it");
}

static void check_factors(struct analytic *a) {
    const vec3 up = {0, 1, 0}, floor = {0, 1e-6, 0};
    // At the distance 2 above, radius 0.7: sin^2.
    check_factor(a, "a sphere above",
                 "position: [0, 2, 0], radius: 0.7, intensity: 0.8, falloff: inverse_square", floor, up,
                 0.35 * 0.35);
    check_factor(a, "a sphere above, without falloff", "position: [0, 2, 0], radius: 0.7, intensity: 0.8",
                 floor, up, 0.35 * 0.35);
    // To the side: times the cosine, as long as all of it is above the floor.
    const vec3 side = {1.2, 1.6, 0};
    check_factor(a, "a sphere aside",
                 "position: [1.2, 1.6, 0], radius: 0.7, intensity: 0.8, falloff: inverse_square", floor, side,
                 0.35 * 0.35 * 0.8);
    const double sine = sin(20 * PI / 180);
    check_factor(a, "a disc above", "direction: [0, -1, 0], angle: 40, intensity: 0.8", floor, up,
                 sine * sine);
    // A square of side 2 at the distance 1: quarters of 1 x 1.
    const double k = 1 / sqrt(2), quarter = 2 * k * atan(k) / (2 * PI);
    check_factor(a, "a panel above",
                 "rectangle: {corner: [-1, 1, -1], edge_u: [2, 0, 0], edge_v: [0, 0, 2]}, intensity: 0.8, "
                 "falloff: inverse_square",
                 floor, up, 4 * quarter);
}

// ---- not seen

// The same bytes as without: from inside a sphere, of a point, and where a body has the light's surface.
static void check_unseen(struct analytic *a, const char *name, const char *light, const char *bodies) {
    struct image images[2];
    bool taken = true;
    for (int i = 0; i < 2; i++) {
        char scene[TEXT];
        snprintf(scene, sizeof scene, "background: {color: 0.5}\nlights: [{%s%s}]\n%s", light,
                 i ? ", visible: true" : "", bodies);
        const struct analytic_picture picture = {.name = name, .scene = scene, .samples = 4};
        taken = analytic_take(a, &picture, &images[i]) && taken;
    }
    const size_t bytes = sizeof *images[0].rgb * 3 * 48 * 32;
    analytic_expect(a, taken && memcmp(images[0].rgb, images[1].rgb, bytes) == 0, name, "is seen");
    free(images[0].rgb);
    free(images[1].rgb);
}

int main(int argc, char **argv) {
    static const char *const precisions[] = {"single", "double"};
    static const char ball[] = "spheres: [{center: [0, 0, -4], radius: 1, material: {emission: 0.25}}]\n";
    struct analytic a;
    const int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    for (int i = 0; i < 2; i++) {
        check_three(&a, precisions[i]);
        check_amber(&a, precisions[i]);
    }
    check_factors(&a);
    check_unseen(&a, "a sphere from inside", "position: [0.5, 0, 0], radius: 2", ball);
    check_unseen(&a, "a point", "position: [0, 0, -2]", ball);
    check_unseen(&a, "a sphere that is a body", "position: [0, 0, -4], radius: 1", ball);
    return analytic_close(&a);
}
