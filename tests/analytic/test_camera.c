// Directions of pixels and samples (docs/language.md, "Camera"): seen from the middle of a sphere that shows
// each direction, and by the share of a pixel that an edge leaves free.
#include "analytic_kit.h"
#include "core/angle.h"

#include <stdio.h>

// The camera stands anywhere; the sphere stands around it.
static bool sphere_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    (void)context, (void)origin;
    analytic_sky((vec3){0, 0, 0}, direction, rgb);
    return true;
}

static void check_camera(struct analytic *a, const char *name, const char *text,
                         struct analytic_camera camera, int32_t samples) {
    char scene[2048];
    snprintf(scene, sizeof scene,
             "trace: {shadows: false}\n%sspheres:\n"
             "  - {center: [%.17g, %.17g, %.17g], radius: 3, material: {diffuse_color: 1}}\n",
             analytic_sky_lights, camera.position.x, camera.position.y, camera.position.z);
    struct analytic_picture picture = {.name = name,
                                       .scene = scene,
                                       .camera = camera,
                                       .camera_text = text,
                                       .width = samples == 1 ? 50 : 21,
                                       .height = samples == 1 ? 30 : 35,
                                       .samples = samples,
                                       .color = sphere_color,
                                       .tolerance = 1e-6};
    analytic_check(a, &picture);
}

// Rz·Ry·Rx in degrees.
static vec3 turned(vec3 v, vec3 degrees) {
    double x = degrees.x * RADIANS, y = degrees.y * RADIANS, z = degrees.z * RADIANS;
    v = (vec3){v.x, v.y * cos(x) - v.z * sin(x), v.y * sin(x) + v.z * cos(x)};
    v = (vec3){v.x * cos(y) + v.z * sin(y), v.y, -v.x * sin(y) + v.z * cos(y)};
    return (vec3){v.x * cos(z) - v.y * sin(z), v.x * sin(z) + v.y * cos(z), v.z};
}

static void check_cameras(struct analytic *a) {
    static const struct {
        const char *name, *text;
        struct analytic_camera camera;
    } cases[] = {
        {"at the defaults", "camera: {}", {.fov = 60}},
        {"look_at",
         "camera: {position: [3, -2, 7], look_at: [-4, 5.5, 2], fov: 35}",
         {{3, -2, 7}, {-7, 7.5, -5}, {0, 1, 0}, 35}},
        {"direction of any length",
         "camera: {position: [1000, 1, -2], direction: [30, -40, 5]}",
         {{1000, 1, -2}, {30, -40, 5}, {0, 1, 0}, 60}},
        {"up, not at a right angle",
         "camera: {direction: [1, 0.5, -1], up: [5, 2, 3], fov: 120}",
         {{0, 0, 0}, {1, 0.5, -1}, {5, 2, 3}, 120}},
        {"a wide field", "camera: {direction: [0, 0, 1], fov: 179}", {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 179}},
        {"a narrow field",
         "camera: {direction: [1, 2, 1], fov: 0.5}",
         {{0, 0, 0}, {1, 2, 1}, {0, 1, 0}, 0.5}},
        {"straight up", "camera: {direction: [0, 2, 0]}", {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 60}},
        {"straight down", "camera: {look_at: [0, -7, 0]}", {{0, 0, 0}, {0, -1, 0}, {0, 0, -1}, 60}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        check_camera(a, cases[i].name, cases[i].text, cases[i].camera, 1);
        check_camera(a, cases[i].name, cases[i].text, cases[i].camera, 5);
    }
    static const vec3 rotations[] = {{-30, 0, 0}, {0, 50, 0}, {0, 0, 20}, {-25, 140, 33}, {90, 0, 0}};
    for (size_t i = 0; i < sizeof rotations / sizeof rotations[0]; i++) {
        char text[256];
        vec3 r = rotations[i];
        snprintf(text, sizeof text, "camera: {position: [1, 2, 3], rotation: [%g, %g, %g], fov: 70}", r.x,
                 r.y, r.z);
        check_camera(
            a, text, text,
            (struct analytic_camera){{1, 2, 3}, turned((vec3){0, 0, -1}, r), turned((vec3){0, 1, 0}, r), 70},
            1);
    }
}

// A black half plane before white: the share of a pixel's samples beside it.
static bool edge_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    (void)context;
    vec3 p = analytic_at(origin, direction, -4 / direction.z);
    double side = p.x + 0.25 * p.y - 0.1;
    rgb[0] = rgb[1] = rgb[2] = side < 0;
    return fabs(side) > 1e-5;
}

static void check_coverage(struct analytic *a) {
    static const int32_t samples[] = {1, 2, 3, 16, 61};
    for (size_t i = 0; i < sizeof samples / sizeof samples[0]; i++) {
        // An edge along x + y/4 = 0.1 in the plane z = -4.
        struct analytic_picture picture = {
            .name = "edge of a rectangle",
            .scene = "background: {color: 1}\nrectangles:\n"
                     "  - {corner: [25.1, -100, -4], edge_u: [-50, 200, 0], edge_v: [100, 0, 0],"
                     " material: {albedo: [0, 0, 0, 0]}}\n",
            .samples = samples[i],
            .color = edge_color,
            .tolerance = 1e-6,
            .most_beside = 0.01};
        analytic_check(a, &picture);
    }
}

int main(int argc, char **argv) {
    struct analytic a;
    int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    check_cameras(&a);
    check_coverage(&a);
    return analytic_close(&a);
}
