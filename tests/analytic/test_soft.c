// Lights with extent behind an edge, ambient light beside a wall, and emission (docs/language.md, "Soft
// light", "Ambient light"): shares of caps and rectangles by their vector irradiance (Lambert 1760; Arvo
// 1994, "The Irradiance Jacobian"), and how fast samples come near them, next to random ones.
#include "analytic_kit.h"

#include "core/angle.h"
#include "picture/metrics/metrics.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    TEXT = 2048,
};

// ---- closed forms: the integral of unit vectors l over a region of directions

// The part of a cap around `axis` where l . side > 0.
static vec3 over_cap(vec3 axis, double half_angle, vec3 side) {
    const double cosine = cos(half_angle), sine = sin(half_angle), c = vec3_dot(axis, side);
    const double b = sqrt(fmax(0, 1 - c * c)), k = b > 0 ? -cosine * c / (sine * b) : c > 0 ? -1 : 1;
    if (k <= -1)
        return vec3_mul(axis, PI * sine * sine);
    if (k >= 1)
        return (vec3){0, 0, 0};
    const vec3 across = vec3_mul(vec3_sub(side, vec3_mul(axis, c)), 1 / b);
    const double end = acos(k), arc = 2 * asin(fmin(1, sine * sin(end)));
    const vec3 round =
        vec3_sub(vec3_mul(axis, sine * sine * end), vec3_mul(across, sine * cosine * sin(end)));
    return vec3_add(round, vec3_mul(side, arc / 2));
}

// The part of a convex polygon, counterclockwise as seen from the place, where l . side > 0.
static vec3 over_polygon(const vec3 *corners, int count, vec3 side) {
    vec3 kept[16], sum = {0, 0, 0};
    int n = 0;
    for (int i = 0; i < count; i++) {
        const vec3 p = corners[i], q = corners[(i + 1) % count];
        const double a = vec3_dot(p, side), b = vec3_dot(q, side);
        if (a > 0)
            kept[n++] = p;
        if ((a > 0) != (b > 0))
            kept[n++] = vec3_add(p, vec3_mul(vec3_sub(q, p), a / (a - b)));
    }
    for (int i = 0; i < n; i++) {
        const vec3 p = vec3_unit(kept[i]), q = vec3_unit(kept[(i + 1) % n]), across = vec3_cross(p, q);
        const double size = vec3_length(across);
        if (size > 0)
            sum = vec3_add(sum, vec3_mul(across, atan2(size, vec3_dot(p, q)) / 2 / size));
    }
    return sum;
}

// ---- a floor, y = 0, below an edge along z at x = 0, y = 1; all with x < 0 is covered

enum lamp {
    SPHERE,
    DISC,
    PANEL
};

struct floor_scene {
    enum lamp lamp;
    vec3 place;  // middle of the light, or the unit vector towards it
    double size; // radius, half angle in radians, or half of an edge
};

// What the floor at p shows, whose colour is white.
static double floor_light(const struct floor_scene *f, vec3 p) {
    const vec3 up = {0, 1, 0}, side = vec3_unit((vec3){1, p.x, 0}), way = vec3_sub(f->place, p);
    if (f->lamp == DISC)
        return vec3_dot(up, over_cap(f->place, f->size, side)) / (PI * sin(f->size) * sin(f->size));
    if (f->lamp == SPHERE) {
        const double half_angle = asin(f->size / vec3_length(way));
        return vec3_dot(up, over_cap(vec3_unit(way), half_angle, side)) /
               (PI * sin(half_angle) * sin(half_angle));
    }
    const double e = f->size;
    const vec3 corners[4] = {{way.x - e, way.y, way.z - e},
                             {way.x - e, way.y, way.z + e},
                             {way.x + e, way.y, way.z + e},
                             {way.x + e, way.y, way.z - e}};
    return fabs(vec3_dot(up, over_polygon(corners, 4, side))) / (4 * e * e);
}

static bool floor_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const vec3 p = analytic_at(origin, direction, -origin.y / direction.y);
    rgb[0] = rgb[1] = rgb[2] = floor_light(context, p);
    return true;
}

static void write_floor(const struct floor_scene *f, const char *precision, char text[TEXT]) {
    char light[512];
    const vec3 p = f->place;
    if (f->lamp == SPHERE)
        snprintf(light, sizeof light, "position: [%.17g, %.17g, %.17g], radius: %.17g", p.x, p.y, p.z,
                 f->size);
    else if (f->lamp == DISC)
        snprintf(light, sizeof light, "direction: [%.17g, %.17g, %.17g], angle: %.17g", -p.x, -p.y, -p.z,
                 f->size * 360 / PI);
    else
        snprintf(light, sizeof light,
                 "rectangle: {corner: [%.17g, %.17g, %.17g], edge_u: [%.17g, 0, 0], edge_v: [0, 0, %.17g]},"
                 " falloff: inverse_square",
                 p.x - f->size, p.y, p.z - f->size, 2 * f->size, 2 * f->size);
    snprintf(
        text, TEXT,
        "trace: {precision: %s}\nlights:\n  - {%s}\nrectangles:\n"
        "  - {corner: [-9, 0, -9], edge_u: [18, 0, 0], edge_v: [0, 0, 18], material: {diffuse_color: 1}}\n"
        "  - {corner: [-3000, 1, -3000], edge_u: [3000, 0, 0], edge_v: [0, 0, 6000]}\n",
        precision, light);
}

// Below the edge, looking down.
static struct analytic_picture floor_picture(const struct floor_scene *f, const char *name,
                                             const char *text) {
    return (struct analytic_picture){
        .name = name,
        .scene = text,
        .camera = {.position = {0.2, 0.9, 0.1}, .forward = {0, -1, 0}, .up = {0, 0, -1}, .fov = 70},
        .color = floor_color,
        .context = f};
}

// Root of the mean square over the pixels, of the device's picture at its own places in them.
static double error_at(struct analytic *a, struct analytic_picture picture, int samples) {
    struct image image;
    double sum = 0;
    picture.samples = samples;
    if (!analytic_take(a, &picture, &image))
        return INFINITY;
    for (uint32_t y = 0; y < image.height; y++)
        for (uint32_t x = 0; x < image.width; x++) {
            double expected = 0;
            for (int n = 0; n < samples; n++) {
                double i, j, rgb[3];
                analytic_offset(n, &i, &j);
                picture.color(picture.context, picture.camera.position,
                              analytic_direction(&picture, x + i, y + j), rgb);
                expected += rgb[0] / samples;
            }
            const double off = (double)image.rgb[3 * ((size_t)y * image.width + x)] - expected;
            sum += off * off;
        }
    sum = sqrt(sum / (image.width * image.height));
    free(image.rgb);
    return sum;
}

static const struct floor_scene lamps[] = {
    {SPHERE, {0.4, 3, -0.3}, 0.5}, {DISC, {0.28, 0.96, 0}, 0.16}, {PANEL, {0.3, 2.5, 0.2}, 0.6}};
static const char *const lamp_names[] = {"a sphere behind an edge", "a disc behind an edge",
                                         "a panel behind an edge"};

// An edge through the light makes errors of n^-0.75 in the limit, random points n^-0.5; what is measured
// varies by a hundredth or two.
#define SLOPE (-0.73)

static void check_profile(struct analytic *a, int lamp, const char *precision) {
    char text[TEXT], name[128];
    write_floor(&lamps[lamp], precision, text);
    snprintf(name, sizeof name, "%s, %s precision", lamp_names[lamp], precision);
    struct analytic_picture picture = floor_picture(&lamps[lamp], name, text);
    picture.width = picture.height = 32;
    // Pixels so small that all samples of one see nearly the same edge of the light.
    picture.camera.fov = 4;
    picture.camera.position.x = -0.2;
    const double few = error_at(a, picture, 4), many = error_at(a, picture, 256);
    const double slope = log(many / few) / log(64);
    printf("%s: error %.5f at 4 samples, %.5f at 256, slope %.2f\n", name, few, many, slope);
    analytic_expect(a, few > 1e-3 && slope <= SLOPE, name, "the error falls too slowly");
    analytic_expect(a, many < 0.01, name, "the mean over 256 samples is another");
}

// ---- next to random points

static double next_random(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

// The share of the sphere's cap that is seen from p, by one random direction of it.
static double random_light(const struct floor_scene *f, vec3 p, uint64_t *state) {
    const vec3 way = vec3_sub(f->place, p), axis = vec3_unit(way);
    const double sine = f->size / vec3_length(way), gap = 1 - sqrt(1 - sine * sine);
    const double lacks = gap * next_random(state), turn = 2 * PI * next_random(state);
    const vec3 first = vec3_unit(vec3_cross(axis, (vec3){1, 0, 0})), second = vec3_cross(axis, first);
    const double wide = sqrt(lacks * (2 - lacks));
    const vec3 l = vec3_add(vec3_mul(axis, 1 - lacks),
                            vec3_add(vec3_mul(first, wide * cos(turn)), vec3_mul(second, wide * sin(turn))));
    return l.x + p.x * l.y > 0 ? 2 / (2 - gap) * l.y : 0;
}

static double flip_of(const float *rgb, const float *reference, uint32_t size) {
    struct measure_options options = measure_options_default();
    struct measure_result result;
    options.metrics = 1u << METRIC_FLIP;
    return measure_pictures(size, size, rgb, reference, &options, &result, NULL, NULL)
               ? result.value[METRIC_FLIP]
               : NAN;
}

// At 16 samples our points look at most 0.7 times as far from the truth as random ones.
static void check_against_random(struct analytic *a) {
    enum {
        SIZE = 96,
        SAMPLES = 16
    };
    static float truth[3 * SIZE * SIZE], random[3 * SIZE * SIZE];
    char text[TEXT];
    struct image image;
    uint64_t state = 1;
    write_floor(&lamps[0], "single", text);
    struct analytic_picture picture = floor_picture(&lamps[0], "16 samples", text);
    picture.width = picture.height = SIZE;
    picture.samples = SAMPLES;
    if (!analytic_take(a, &picture, &image))
        return;
    for (int i = 0; i < SIZE * SIZE; i++) {
        double exact = 0, rough = 0;
        for (int n = 0; n < SAMPLES; n++) {
            double u, v;
            analytic_offset(n, &u, &v);
            const vec3 d = analytic_direction(&picture, i % SIZE + u, i / SIZE + v);
            const vec3 p = analytic_at(picture.camera.position, d, -picture.camera.position.y / d.y);
            exact += floor_light(&lamps[0], p) / SAMPLES;
            rough += random_light(&lamps[0], p, &state) / SAMPLES;
        }
        for (int c = 0; c < 3; c++) {
            truth[3 * i + c] = (float)exact;
            random[3 * i + c] = (float)rough;
        }
    }
    const double own = flip_of(image.rgb, truth, SIZE), other = flip_of(random, truth, SIZE);
    printf("FLIP at 16 samples: %.4f, of random points %.4f: %.2f of it\n", own, other, own / other);
    analytic_expect(a, other > 0.005 && own <= 0.7 * other, "16 samples", "look like random ones");
    free(image.rgb);
}

// ---- ambient light, emission

struct corner {
    double reach; // of occlusion
};

// A floor beside a wall without end: directions that come to the wall within the reach are a half of a cap
// around -x.
static bool corner_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct corner *c = context;
    const vec3 p = analytic_at(origin, direction, -origin.y / direction.y), up = {0, 1, 0};
    double open = 1;
    if (p.x < c->reach)
        open -= vec3_dot(up, over_cap((vec3){-1, 0, 0}, acos(p.x / c->reach), up)) / PI;
    for (int i = 0; i < 3; i++)
        rgb[i] = 0.75 * open;
    return true;
}

static void check_corner(struct analytic *a, const char *precision) {
    char text[TEXT], name[64];
    const struct corner corner = {1.5};
    snprintf(name, sizeof name, "a corner, %s precision", precision);
    snprintf(
        text, sizeof text,
        "trace: {precision: %s}\nambient: {color: 1.5, intensity: 0.5, occlusion: 1.5}\nrectangles:\n"
        "  - {corner: [-9, 0, -9], edge_u: [18, 0, 0], edge_v: [0, 0, 18], material: {diffuse_color: 1}}\n"
        "  - {corner: [0, 0, -900], edge_u: [0, 900, 0], edge_v: [0, 0, 1800]}\n",
        precision);
    struct analytic_picture picture = {
        .name = name,
        .scene = text,
        .camera = {.position = {1, 0.9, 0.1}, .forward = {0, -1, 0}, .up = {0, 0, -1}, .fov = 4},
        .width = 32,
        .height = 32,
        .color = corner_color,
        .context = &corner};
    const double few = error_at(a, picture, 4), many = error_at(a, picture, 256);
    const double slope = log(many / few) / log(64);
    printf("%s: error %.5f at 4 samples, %.5f at 256, slope %.2f\n", name, few, many, slope);
    analytic_expect(a, few > 1e-3 && slope <= SLOPE && many < 0.01, name,
                    "the corner is not as dark as it must be");
}

// Emission and ambient light that nothing blocks are exact, in a mirror too.
static bool glow_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    (void)context;
    (void)origin;
    const double own[3] = {0.25 + 0.5 * 0.5 * 0.125, 0.5 + 0.5 * 0.5 * 0.25, 2 + 0.5 * 0.5 * 0.5};
    const double shown = fabs(direction.x) < fabs(direction.z) && direction.z > 0 ? 1 : 0.75;
    for (int i = 0; i < 3; i++)
        rgb[i] = own[i] * shown;
    return fabs(fabs(direction.x) - fabs(direction.z)) > 1e-3;
}

static void check_glow(struct analytic *a, const char *precision) {
    char text[TEXT], name[64];
    snprintf(name, sizeof name, "emission, %s precision", precision);
    snprintf(
        text, sizeof text,
        "trace: {precision: %s}\nambient: {color: [0.125, 0.25, 0.5], intensity: 0.5}\n"
        "spheres:\n  - {center: [0, 0, 0], radius: 50, material: {albedo: [0.5, 0, 0, 0], diffuse_color: 1,"
        " emission: [0.25, 0.5, 2]}}\n"
        "rectangles:\n  - {corner: [-9, -9, -4], edge_u: [18, 0, 0], edge_v: [0, 18, 0],"
        " material: {albedo: [0, 0, 0.75, 0]}}\n",
        precision);
    const struct analytic_picture picture = {
        .name = name, .scene = text, .color = glow_color, .tolerance = 1e-6, .most_beside = 0.05};
    analytic_check(a, &picture);
}

// ---- scenes that must look the same

static void check_same(struct analytic *a, const char *name, const char *precision, const char *one,
                       const char *other) {
    struct image images[2] = {{0}};
    float off = 0, most = 0;
    bool good = true;
    for (int i = 0; i < 2; i++) {
        char text[TEXT];
        snprintf(text, sizeof text, "trace: {precision: %s}\nbackground: {color: 0}\n%s", precision,
                 i ? other : one);
        const struct analytic_picture picture = {.name = name,
                                                 .scene = text,
                                                 .camera = {{0, 2, 5}, {0, -0.7, -1}, {0, 0, 0}, 40},
                                                 .width = 32,
                                                 .height = 24,
                                                 .samples = 16};
        good = analytic_take(a, &picture, &images[i]) && good;
    }
    for (int i = 0; good && i < 3 * 32 * 24; i++) {
        off = fmaxf(off, fabsf(images[0].rgb[i] - images[1].rgb[i]));
        most = fmaxf(most, images[0].rgb[i]);
    }
    for (int i = 0; i < 2; i++)
        image_finish(&images[i]);
    analytic_expect(a, good && off < 1e-4F && most > 0.1F, name, "the pictures differ, or are black");
}

#define FLOOR "rectangles:\n  - {corner: [-9, 0, 9], edge_u: [18, 0, 0], edge_v: [0, 0, -18]}\n"

// A body with the very surface of a light is never in its way: the lamps are above what the camera sees.
static void check_lamps(struct analytic *a, const char *precision) {
    static const char panel[] = "lights:\n  - {rectangle: {corner: [-1.3, 4, -1.1], edge_u: [2.7, 0, 0.1], "
                                "edge_v: [0, 0, 2.3]}}\n" FLOOR;
    static const char ball[] = "lights:\n  - {position: [1.7, 4.1, 0.3], radius: 0.37}\n" FLOOR;
    char with[TEXT];
    snprintf(
        with, sizeof with,
        "%s  - {corner: [-1.3, 4, -1.1], edge_u: [0, 0, 2.3], edge_v: [2.7, 0, 0.1], material: {emission: "
        "1}}\n",
        panel);
    check_same(a, "a panel that is seen", precision, panel, with);
    snprintf(with, sizeof with,
             "%sspheres:\n  - {center: [1.7, 4.1, 0.3], radius: 0.37, material: {emission: 1}}\n", ball);
    check_same(a, "a ball that is seen", precision, ball, with);
}

// However far away a lamp is, it has the extent that it is seen with.
static void check_far(struct analytic *a, const char *precision) {
    static const char ball[] = FLOOR "spheres:\n  - {center: [0, 0.5, 0], radius: 0.4}\n";
    char far[TEXT], farther[TEXT];
    snprintf(far, sizeof far, "lights:\n  - {position: [1e6, 4e6, 2e6], radius: 1e6}\n%s", ball);
    snprintf(farther, sizeof farther, "lights:\n  - {position: [1e16, 4e16, 2e16], radius: 1e16}\n%s", ball);
    check_same(a, "a lamp as far as the stars", precision, far, farther);
    snprintf(
        far, sizeof far,
        "lights:\n  - {rectangle: {corner: [1e6, 4e6, 2e6], edge_u: [1e6, 0, 0], edge_v: [0, 0, 1e6]}}\n%s",
        ball);
    snprintf(farther, sizeof farther,
             "lights:\n  - {rectangle: {corner: [1e16, 4e16, 2e16], edge_u: [1e16, 0, 0], edge_v: [0, 0, "
             "1e16]}}\n%s",
             ball);
    check_same(a, "a panel as far as the stars", precision, far, farther);
}

// Nothing is that near to the floor.
static void check_short_occlusion(struct analytic *a, const char *precision) {
    check_same(a, "occlusion as short as rounding", precision,
               "ambient: {color: 0.5, occlusion: 1e-5}\n" FLOOR, "ambient: {color: 0.5}\n" FLOOR);
}

int main(int argc, char **argv) {
    struct analytic a;
    int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    for (int i = 0; i < 3; i++)
        check_profile(&a, i, "single");
    check_profile(&a, SPHERE, "double");
    check_corner(&a, "single");
    check_corner(&a, "double");
    check_glow(&a, "single");
    check_glow(&a, "double");
    static const char *const precisions[] = {"single", "double"};
    for (int i = 0; i < 2; i++) {
        check_lamps(&a, precisions[i]);
        check_far(&a, precisions[i]);
        check_short_occlusion(&a, precisions[i]);
    }
    check_against_random(&a);
    return analytic_close(&a);
}
