#include "analytic_kit.h"
#include "core/angle.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int analytic_open(struct analytic *analytic, int argc, char **argv) {
    *analytic = (struct analytic){0};
    if (argc < 2) {
        fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
        return 2;
    }
    analytic->folder = argv[1];
    return picture_kit_open(&analytic->kit) ? 0 : 77;
}

int analytic_close(struct analytic *analytic) {
    uint32_t messages = picture_kit_close(&analytic->kit);
    if (messages)
        fprintf(stderr, "%u validation messages\n", messages);
    printf("%d pictures, %d failures\n", analytic->pictures, analytic->failed);
    return analytic->failed || messages || analytic->pictures == 0;
}

bool analytic_write(struct analytic *analytic, const char *name, const void *bytes, size_t size) {
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", analytic->folder, name);
    FILE *file = fopen(path, "wb");
    bool good = file && fwrite(bytes, 1, size, file) == size;
    if (file && fclose(file) != 0)
        good = false;
    analytic_expect(analytic, good, name, "cannot be written");
    return good;
}

void analytic_expect(struct analytic *analytic, bool good, const char *name, const char *what) {
    if (good)
        return;
    fprintf(stderr, "FAIL %s: %s\n", name, what);
    analytic->failed++;
}

static struct analytic_camera camera_of(const struct analytic_picture *picture) {
    struct analytic_camera camera = picture->camera;
    if (vec3_is_zero(camera.forward))
        camera.forward = (vec3){0, 0, -1};
    if (vec3_is_zero(camera.up))
        camera.up = (vec3){0, 1, 0};
    camera.fov = camera.fov > 0 ? camera.fov : 60;
    return camera;
}

static int32_t width_of(const struct analytic_picture *picture) {
    return picture->width ? picture->width : 48;
}
static int32_t height_of(const struct analytic_picture *picture) {
    return picture->height ? picture->height : 32;
}

static bool write_scene(struct analytic *analytic, const struct analytic_picture *picture) {
    char camera[512];
    const size_t size = (picture->scene ? strlen(picture->scene) : 0) + 4096;
    char *text = malloc(size);
    struct analytic_camera c = camera_of(picture);
    snprintf(camera, sizeof camera,
             "camera: {position: [%.17g, %.17g, %.17g], direction: [%.17g, %.17g, %.17g],"
             " up: [%.17g, %.17g, %.17g], fov: %.17g}",
             c.position.x, c.position.y, c.position.z, c.forward.x, c.forward.y, c.forward.z, c.up.x, c.up.y,
             c.up.z, c.fov);
    int length =
        snprintf(text, size, "glint: 1\nimage: {width: %d, height: %d, samples: %d%s}\n%s\n%s\n",
                 width_of(picture), height_of(picture), picture->samples ? picture->samples : 1,
                 picture->image_text ? picture->image_text : "",
                 picture->camera_text ? picture->camera_text : camera, picture->scene ? picture->scene : "");
    const bool good = length > 0 && (size_t)length < size &&
                      analytic_write(analytic, "picture.glint.yaml", text, (size_t)length);
    free(text);
    return good;
}

bool analytic_take(struct analytic *analytic, const struct analytic_picture *picture, struct image *image) {
    char path[1024];
    struct picture_options options = {0};
    *image = (struct image){0};
    snprintf(path, sizeof path, "%s/picture.glint.yaml", analytic->folder);
    bool good = write_scene(analytic, picture) && picture_take(&analytic->kit, path, &options, image);
    analytic->pictures++;
    analytic_expect(analytic, good, picture->name, "no picture");
    return good;
}

vec3 analytic_direction(const struct analytic_picture *picture, double x, double y) {
    struct analytic_camera c = camera_of(picture);
    double width = width_of(picture), height = height_of(picture);
    double most = tan(c.fov * (PI / 360));
    vec3 f = vec3_unit(c.forward), s = vec3_unit(vec3_cross(f, c.up)), u = vec3_cross(s, f);
    vec3 d = vec3_add(f, vec3_mul(s, (2 * x / width - 1) * (width / height) * most));
    return vec3_unit(vec3_add(d, vec3_mul(u, (1 - 2 * y / height) * most)));
}

void analytic_offset(int n, double *a, double *b) {
    static const double phi = 1.32471795724474602596;
    double whole;
    *a = modf(0.5 + n / phi, &whole);
    *b = modf(0.5 + n / (phi * phi), &whole);
}

// The mean over the samples of a pixel.
static bool expected_pixel(const struct analytic_picture *picture, int32_t x, int32_t y, double rgb[3]) {
    int samples = picture->samples ? picture->samples : 1;
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int n = 0; n < samples; n++) {
        double a, b, color[3] = {0, 0, 0};
        analytic_offset(n, &a, &b);
        if (!picture->color(picture->context, picture->camera.position,
                            analytic_direction(picture, x + a, y + b), color))
            return false;
        for (int i = 0; i < 3; i++)
            rgb[i] += color[i] / samples;
    }
    return true;
}

static double error_of(const float *got, const double wanted[3]) {
    double most = 0;
    for (int i = 0; i < 3; i++)
        most = fmax(most, isfinite(got[i]) ? fabs((double)got[i] - wanted[i]) / fmax(1, fabs(wanted[i]))
                                           : HUGE_VAL);
    return most;
}

static void compare(struct analytic *analytic, const struct analytic_picture *picture,
                    const struct image *image) {
    int64_t beside = 0, wrong = 0, all = (int64_t)image->width * image->height;
    double worst = 0;
    for (int32_t y = 0; y < (int32_t)image->height; y++)
        for (int32_t x = 0; x < (int32_t)image->width; x++) {
            double wanted[3];
            const float *got = image->rgb + 3 * ((size_t)y * image->width + (size_t)x);
            if (!expected_pixel(picture, x, y, wanted)) {
                beside++;
                continue;
            }
            double error = error_of(got, wanted);
            worst = fmax(worst, error);
            if (error > picture->tolerance && wrong++ == 0)
                fprintf(stderr, "%s: pixel %d,%d is %.9g %.9g %.9g, should be %.9g %.9g %.9g\n",
                        picture->name, x, y, (double)got[0], (double)got[1], (double)got[2], wanted[0],
                        wanted[1], wanted[2]);
        }
    bool told = (double)beside <= picture->most_beside * (double)all && beside < all;
    printf("%s %s: worst error %.2g of %.2g, %lld of %lld pixels beside\n", wrong || !told ? "FAIL" : "ok  ",
           picture->name, worst, picture->tolerance, (long long)beside, (long long)all);
    analytic_expect(analytic, told, picture->name, "too few pixels have a closed form");
    analytic_expect(analytic, wrong == 0, picture->name, "wrong pixels");
}

void analytic_check(struct analytic *analytic, const struct analytic_picture *picture) {
    struct image image;
    if (analytic_take(analytic, picture, &image))
        compare(analytic, picture, &image);
    image_finish(&image);
}

double analytic_sphere(vec3 origin, vec3 direction, vec3 center, double radius, double after) {
    vec3 f = vec3_sub(origin, center);
    double b = -vec3_dot(f, direction);
    vec3 nearest = vec3_add(f, vec3_mul(direction, b));
    double gap = radius * radius - vec3_dot(nearest, nearest);
    if (gap < 0)
        return -1;
    double near = b - sqrt(gap), far = b + sqrt(gap);
    return near > after ? near : far > after ? far : -1;
}

double analytic_plane(vec3 origin, vec3 direction, vec3 point, vec3 normal) {
    double slope = vec3_dot(direction, normal);
    double t = slope == 0 ? -1 : vec3_dot(vec3_sub(point, origin), normal) / slope;
    return t > 0 ? t : -1;
}

vec3 analytic_at(vec3 origin, vec3 direction, double t) {
    return vec3_add(origin, vec3_mul(direction, t));
}

vec3 analytic_mirrored(vec3 direction, vec3 normal) {
    return vec3_sub(direction, vec3_mul(normal, 2 * vec3_dot(direction, normal)));
}

bool analytic_refracted(vec3 direction, vec3 normal, double eta, vec3 *out) {
    double c = -vec3_dot(direction, normal), k = 1 - eta * eta * (1 - c * c);
    *out = direction;
    if (k < 0)
        return false;
    *out = vec3_unit(vec3_add(vec3_mul(direction, eta), vec3_mul(normal, eta * c - sqrt(k))));
    return true;
}

// Directions are those in which light travels: the inside facing -x is lit by light that travels along +x,
// and so on. Each pair of opposite lights has one channel, told apart by strength.
const char analytic_sky_lights[] = "lights:\n"
                                   "  - {direction: [1, 0, 0], color: [1, 0, 0]}\n"
                                   "  - {direction: [-1, 0, 0], color: [0.25, 0, 0]}\n"
                                   "  - {direction: [0, 1, 0], color: [0, 1, 0]}\n"
                                   "  - {direction: [0, -1, 0], color: [0, 0.25, 0]}\n"
                                   "  - {direction: [0, 0, 1], color: [0, 0, 1]}\n"
                                   "  - {direction: [0, 0, -1], color: [0, 0, 0.25]}\n";
const char analytic_sky_sphere[] =
    "  - {center: [0, 0, 0], radius: 64, material: {albedo: [1, 0, 0, 0], diffuse_color: 1}}\n";

void analytic_sky(vec3 origin, vec3 direction, double rgb[3]) {
    double t = analytic_sphere(origin, direction, (vec3){0, 0, 0}, ANALYTIC_SKY_RADIUS, 0);
    vec3 place = vec3_mul(analytic_at(origin, direction, t), 1 / ANALYTIC_SKY_RADIUS);
    const double p[3] = {place.x, place.y, place.z};
    for (int i = 0; i < 3; i++)
        rgb[i] = p[i] > 0 ? p[i] : -0.25 * p[i];
}
