// Projections, lenses and rough surfaces against closed forms (docs/language.md, "Camera" and "Roughness").
#include "analytic_kit.h"
#include "core/angle.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct analytic_picture picture_of(const char *name, const char *scene, const char *camera,
                                          int32_t width, int32_t height, int32_t samples) {
    return (struct analytic_picture){.name = name,
                                     .scene = scene,
                                     .camera_text = camera,
                                     .width = width,
                                     .height = height,
                                     .samples = samples};
}

static double brightness(const struct image *image, int32_t x, int32_t y) {
    return image->rgb[3 * ((size_t)y * image->width + x)];
}

// ---- projections: from the middle of a sphere that shows each direction

static vec3 fisheye(double x, double y, double aspect, double fov) {
    const double r = hypot(x * aspect, y), angle = r * fov / 2 * RADIANS;
    const double part = r > 0 ? sin(angle) / r : 0;
    return (vec3){x * aspect * part, y * part, -cos(angle)};
}

static vec3 panorama(double x, double y) {
    const double longitude = 180 * RADIANS * x, latitude = 90 * RADIANS * y;
    return (vec3){sin(longitude) * cos(latitude), sin(latitude), -cos(longitude) * cos(latitude)};
}

static void check_directions(struct analytic *a, const char *precision, const char *camera, double fov) {
    char scene[1024];
    snprintf(scene, sizeof scene,
             "trace: {shadows: false, precision: %s}\n%sspheres:\n"
             "  - {center: [0, 0, 0], radius: 3, material: {diffuse_color: 1}}\n",
             precision, analytic_sky_lights);
    const struct analytic_picture picture = picture_of(camera, scene, camera, 50, 30, 1);
    struct image image;
    double worst = 0;
    if (!analytic_take(a, &picture, &image))
        return;
    for (int32_t y = 0; y < 30; y++)
        for (int32_t x = 0; x < 50; x++) {
            const double right = 2 * (x + 0.5) / 50 - 1, up = 1 - 2 * (y + 0.5) / 30;
            const vec3 d = fov > 0 ? fisheye(right, up, 50 / 30.0, fov) : panorama(right, up);
            double rgb[3];
            analytic_sky((vec3){0, 0, 0}, d, rgb);
            for (int k = 0; k < 3; k++)
                worst = fmax(worst, fabs(rgb[k] - image.rgb[3 * (y * 50 + x) + k]));
        }
    free(image.rgb);
    analytic_expect(a, worst < 2e-6, camera, "a direction is wrong");
}

// Discs of known places, wherever they are along the view.
static void check_orthographic(struct analytic *a) {
    static const double discs[3][4] = {{-1, 0.5, 0, 0.8}, {1.25, -0.25, -40, 0.5}, {0.5, 1.25, 3, 0.25}};
    const struct analytic_picture picture =
        picture_of("orthographic",
                   "background: {color: 1}\nmaterials: {black: {albedo: [0, 0, 0, 0]}}\nspheres:\n"
                   "  - {center: [-1, 0.5, 0], radius: 0.8, material: black}\n"
                   "  - {center: [1.25, -0.25, -40], radius: 0.5, material: black}\n"
                   "  - {center: [0.5, 1.25, 3], radius: 0.25, material: black}\n",
                   "camera: {position: [0, 0, 9], projection: orthographic, size: 4}", 96, 64, 1);
    struct image image;
    int wrong = 0;
    if (!analytic_take(a, &picture, &image))
        return;
    for (int32_t y = 0; y < 64; y++)
        for (int32_t x = 0; x < 96; x++) {
            const double px = (2 * (x + 0.5) / 96 - 1) * 3, py = (1 - 2 * (y + 0.5) / 64) * 2;
            bool inside = false;
            for (int k = 0; k < 3; k++)
                inside |= hypot(px - discs[k][0], py - discs[k][1]) < discs[k][3];
            wrong += (brightness(&image, x, y) < 0.5) != inside;
        }
    free(image.rgb);
    analytic_expect(a, wrong == 0, "orthographic", "a sphere is elsewhere");
}

// ---- lens

// A square far away is a disc: its second moment about its middle, less that of the square, is half of the
// squared radius (of a uniform disc), and so is that of each pixel.
static void check_confusion(struct analytic *a, const char *camera, double aperture, double focus) {
    enum {
        SIDE = 64
    };
    const double z = 40, half = 0.4, tangent = tan(15 * RADIANS), pixels = SIDE / 2 / tangent;
    const struct analytic_picture picture =
        picture_of("circle of confusion",
                   "trace: {shadows: false}\nlights:\n  - {direction: [0, 0, -1]}\nrectangles:\n"
                   "  - {corner: [-0.4, -0.4, -40], edge_u: [0.8, 0, 0], edge_v: [0, 0.8, 0], material: "
                   "{diffuse_color: 1}}\n",
                   camera, SIDE, SIDE, 256);
    struct image image;
    double sum = 0, squares = 0;
    if (!analytic_take(a, &picture, &image))
        return;
    for (int32_t y = 0; y < SIDE; y++)
        for (int32_t x = 0; x < SIDE; x++) {
            const double dx = x + 0.5 - SIDE / 2, dy = y + 0.5 - SIDE / 2, value = brightness(&image, x, y);
            sum += value;
            squares += value * (dx * dx + dy * dy);
        }
    free(image.rgb);
    const double dot = half / z * pixels;
    const double diameter = 2 * sqrt(2 * (squares / sum - 2 * dot * dot / 3 - 1 / 6.0));
    const double expected = aperture * fabs(1 / focus - 1 / z) * pixels;
    fprintf(stderr, "circle of confusion: %.4f pixels, expected %.4f\n", diameter, expected);
    analytic_expect(a, fabs(diameter - expected) < 0.01 * expected, camera,
                    "the blur disc has another diameter");
}

static bool same_bytes(struct analytic *a, const struct analytic_picture *one,
                       const struct analytic_picture *other) {
    struct image first, second;
    bool same = false;
    if (!analytic_take(a, one, &first))
        return false;
    if (analytic_take(a, other, &second)) {
        same = memcmp(first.rgb, second.rgb, sizeof(float) * 3 * first.width * first.height) == 0;
        free(second.rgb);
    }
    free(first.rgb);
    return same;
}

// Another camera and another material make the kernel one that knows lenses and rough surfaces.
static void check_nothing_changes(struct analytic *a) {
#define BODIES                                                                                               \
    "background: {color: [0.3, 0.5, 0.9]}\nlights:\n  - {position: [3, 5, 6]}\nspheres:\n"                   \
    "  - {center: [-1, 0, 0], radius: 1, material: {albedo: [0.5, 0.5, 0.4, 0]}}\n"                          \
    "  - {center: [1, 0, 0], radius: 1, material: {albedo: [0, 0.5, 0.1, 0.8], refractive_index: 1.5}}\n"
    const char *const plain = "cameras: {main: {position: [0, 1, 6], look_at: [0, 0, 0]}}\n";
    const char *const lens = "cameras: {main: {position: [0, 1, 6], look_at: [0, 0, 0], aperture: 0},"
                             " other: {position: [0, 1, 6], look_at: [0, 0, 0], aperture: 0.3}}\n";
    const struct analytic_picture before = picture_of("a pinhole", BODIES, plain, 48, 32, 4);
    const struct analytic_picture after = picture_of("a pinhole", BODIES, lens, 48, 32, 4);
    const struct analytic_picture rough =
        picture_of("smooth",
                   BODIES "  - {center: [0, -900, 0], radius: 1, material: {albedo: [0, 0, 1, 0],"
                          " roughness: 0.5}}\n",
                   plain, 48, 32, 4);
    analytic_expect(a, same_bytes(a, &before, &after), "aperture 0", "the picture is not the pinhole's");
    analytic_expect(a, same_bytes(a, &before, &rough), "roughness 0", "the picture is not the smooth one");
}

// ---- roughness

// The share of facets that are tilted by less than an angle, seen straight.
static double tilted_less(double angle, double alpha) {
    const double t = tan(angle);
    return t * t / (alpha * alpha + t * t);
}

static double mean_of(struct analytic *a, const char *name, const char *scene, const char *camera) {
    const struct analytic_picture picture = picture_of(name, scene, camera, 32, 32, 64);
    struct image image;
    double sum = 0;
    if (!analytic_take(a, &picture, &image))
        return NAN;
    for (size_t i = 0; i < 32 * 32; i++)
        sum += image.rgb[3 * i];
    free(image.rgb);
    return sum / (32 * 32);
}

// A mirror that is seen straight, and a black ball behind the camera before a white background.
static void check_lobe(struct analytic *a, const char *precision, double roughness, double cone) {
    char scene[1024];
    snprintf(scene, sizeof scene,
             "trace: {precision: %s}\nbackground: {color: 1}\nmaterials:\n  black: {albedo: [0, 0, 0, 0]}\n"
             "  mirror: {albedo: [0, 0, 1, 0], roughness: %g}\nspheres:\n"
             "  - {center: [0, 0, 100], radius: %.17g, material: black}\nrectangles:\n"
             "  - {corner: [-1, -1, 0], edge_u: [2, 0, 0], edge_v: [0, 2, 0], material: mirror}\n",
             precision, roughness, 100 * sin(cone * RADIANS));
    const double alpha = roughness * roughness, half = cone / 2 * RADIANS;
    const double turned_back = 1 - tilted_less(90 * RADIANS - half, alpha);
    const double expected = 1 - tilted_less(half, alpha) - turned_back;
    const double got =
        mean_of(a, "lobe", scene, "camera: {position: [0, 0, 1], projection: orthographic, size: 0.01}");
    fprintf(stderr, "roughness %g, cone of %g degrees: %.5f, expected %.5f\n", roughness, cone, got,
            expected);
    analytic_expect(a, fabs(got - expected) < 2e-3, scene, "the lobe is another one");
}

// The lobe of a ray at an angle, by facets: how much of it goes to the right of the plane x = 0 (to which all
// is symmetric but the ray).
static double to_the_right(double angle, double alpha) {
    enum {
        STEPS = 1200
    };
    const double vx = sin(angle), vz = cos(angle);
    double right = 0, all = 0;
    for (int i = 0; i < STEPS; i++)
        for (int k = 0; k < STEPS; k++) {
            const double t = (i + 0.5) / STEPS * 90 * RADIANS, p = (k + 0.5) / STEPS * 360 * RADIANS;
            const double mx = sin(t) * cos(p), mz = cos(t), c = vx * mx + vz * mz;
            const double d = alpha * alpha / pow(mz * mz * (alpha * alpha - 1) + 1, 2);
            if (c <= 0)
                continue;
            all += c * d * sin(t);
            right += 2 * c * mx - vx > 0 ? c * d * sin(t) : 0;
        }
    return right / all;
}

// The mirror's upper side shows a white half of the sky and a black one: a wall stands at the mirror's place.
static void check_slanted(struct analytic *a, double roughness, double angle) {
    char scene[1024], camera[256];
    snprintf(scene, sizeof scene,
             "background: {color: 1}\nmaterials:\n  black: {albedo: [0, 0, 0, 0]}\n"
             "  mirror: {albedo: [0, 0, 1, 0], roughness: %g}\nrectangles:\n"
             "  - {corner: [-1, 0, -1], edge_u: [2, 0, 0], edge_v: [0, 0, 2], material: mirror}\n"
             "  - {corner: [0, 0, -20000], edge_u: [0, 20000, 0], edge_v: [0, 0, 40000], material: black}\n",
             roughness);
    // Rays come from the right, and hit a little to the right of the wall's foot.
    snprintf(camera, sizeof camera,
             "camera: {position: [%.17g, %.17g, 0], direction: [%.17g, %.17g, 0], projection: orthographic, "
             "size: 1e-6}",
             0.02 + 0.5 * sin(angle * RADIANS), 0.5 * cos(angle * RADIANS), -sin(angle * RADIANS),
             -cos(angle * RADIANS));
    const double expected = to_the_right(angle * RADIANS, roughness * roughness);
    const double got = mean_of(a, "slanted", scene, camera);
    fprintf(stderr, "roughness %g from %g degrees: %.5f, expected %.5f\n", roughness, angle, got, expected);
    analytic_expect(a, fabs(got - expected) < 3e-3, scene, "the slanted lobe is another one");
}

// In a white world a body that only reflects and refracts is as white.
static void check_furnace(struct analytic *a, const char *material) {
    char scene[512];
    snprintf(scene, sizeof scene,
             "trace: {max_depth: 4, min_weight: 0}\nbackground: {color: 1}\nspheres:\n"
             "  - {center: [0, 0, -4], radius: 1, material: {%s}}\n",
             material);
    const double got = mean_of(a, "furnace", scene, "camera: {fov: 20}");
    analytic_expect(a, fabs(got - 1) < 1e-4, material, "light is lost or made");
}

int main(int argc, char **argv) {
    struct analytic a;
    int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    static const char *const precisions[] = {"single", "double"};
    for (int i = 0; i < 2; i++) {
        check_directions(&a, precisions[i], "camera: {projection: fisheye, fov: 360}", 360);
        check_directions(&a, precisions[i], "camera: {projection: fisheye, fov: 100}", 100);
        check_directions(&a, precisions[i], "camera: {projection: panorama}", 0);
        check_lobe(&a, precisions[i], 0.5, 40);
    }
    check_orthographic(&a);
    check_confusion(&a, "camera: {fov: 30, aperture: 1, focus: 5}", 1, 5);
    check_confusion(&a, "camera: {fov: 30, aperture: 1.2, focus_at: [3, -2, -6]}", 1.2, 6);
    check_nothing_changes(&a);
    check_lobe(&a, "single", 0.2, 8);
    check_lobe(&a, "single", 1, 70);
    check_slanted(&a, 0.5, 50);
    check_furnace(&a, "albedo: [0, 0, 1, 0], roughness: 1");
    check_furnace(&a, "albedo: [0, 0, 1, 1], refractive_index: 1.5, fresnel: true, roughness: 0.5");
    return analytic_close(&a);
}
