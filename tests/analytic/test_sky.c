// Backgrounds that light (docs/language.md, "Light from the background"): an evenly bright one against closed
// forms, images against sums over all directions, and how fast samples come near them, next to random ones.
#include "analytic_kit.h"

#include "core/angle.h"
#include "picture/metrics/metrics.h"
#include "picture/write/image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// An edge makes errors of n^-0.75 in the limit; what is measured varies by a hundredth or two.
#define SLOPE (-0.73)

enum {
    TEXT = 2048,
    SIDE = 16,
};

// Looking straight down at what is there, from so near that it is nearly the same everywhere.
static const struct analytic_camera down = {
    .position = {-0.2, 0.9, 0.1}, .forward = {0, -1, 0}, .up = {0, 0, -1}, .fov = 4};

// Root of the mean square over pixels and channels; `expected` of the middle of a pixel.
static double error_at(struct analytic *a, struct analytic_picture picture, int samples) {
    struct image image;
    double sum = 0;
    picture.samples = samples;
    if (!analytic_take(a, &picture, &image))
        return INFINITY;
    for (uint32_t y = 0; y < image.height; y++)
        for (uint32_t x = 0; x < image.width; x++) {
            double rgb[3];
            picture.color(picture.context, picture.camera.position,
                          analytic_direction(&picture, x + 0.5, y + 0.5), rgb);
            for (int c = 0; c < 3; c++) {
                const double off = (double)image.rgb[3 * ((size_t)y * image.width + x) + (size_t)c] - rgb[c];
                sum += off * off / 3;
            }
        }
    free(image.rgb);
    return sqrt(sum / (SIDE * SIDE));
}

static void check_slope(struct analytic *a, const char *name, const char *scene, analytic_color color,
                        const void *context) {
    const struct analytic_picture picture = {.name = name,
                                             .scene = scene,
                                             .camera = down,
                                             .width = SIDE,
                                             .height = SIDE,
                                             .color = color,
                                             .context = context};
    const double few = error_at(a, picture, 4), many = error_at(a, picture, 1024);
    const double slope = log(many / few) / log(256);
    printf("%s: error %.5f at 4 samples, %.5f at 1024, slope %.2f\n", name, few, many, slope);
    analytic_expect(a, few > 1e-3 && slope <= SLOPE, name, "the error falls too slowly");
    analytic_expect(a, many < 0.01, name, "the mean over 1024 samples is another");
}

// ---- evenly bright

#define FLOOR                                                                                                \
    "rectangles:\n  - {corner: [-9, 0, -9], edge_u: [0, 0, 18], edge_v: [18, 0, 0], material: {%s}}\n"

// A matt floor under the open sky shows what ambient light of that colour would.
static bool matt(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    (void)context;
    (void)origin;
    (void)direction;
    rgb[0] = 0.5 * 0.8;
    rgb[1] = 0.25 * 0.8;
    rgb[2] = 1 * 0.8;
    return true;
}

// Seen from straight above, the highlight of exponent e is 2 / (e + 1).
static bool shiny(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    (void)context;
    (void)origin;
    (void)direction;
    for (int c = 0; c < 3; c++)
        rgb[c] = 0.5 * 2 / (9 + 1);
    return true;
}

// All with x < 0 is covered at y = 1: the open part is between two half planes, whose cosine-weighted share
// is (1 + the cosine between their normals) / 2.
static double below_edge(vec3 p) {
    return (1 + vec3_unit((vec3){1, p.x, 0}).y) / 2;
}

static bool edge(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    (void)context;
    rgb[0] = rgb[1] = rgb[2] = below_edge(analytic_at(origin, direction, -origin.y / direction.y));
    return true;
}

static const char edge_scene[] =
    "background: {color: 1, lights: true}\n"
    "rectangles:\n"
    "  - {corner: [-9, 0, -9], edge_u: [0, 0, 18], edge_v: [18, 0, 0], material: {diffuse_color: 1}}\n"
    "  - {corner: [-3000, 1, -3000], edge_u: [3000, 0, 0], edge_v: [0, 0, 6000]}\n";

static void check_even(struct analytic *a, const char *precision) {
    char text[TEXT], name[64], rest[TEXT / 4];
    snprintf(name, sizeof name, "a matt floor, %s", precision);
    snprintf(rest, sizeof rest, FLOOR, "diffuse_color: [0.5, 0.25, 1]");
    snprintf(text, sizeof text,
             "trace: {precision: %s}\nbackground: {color: 1, intensity: 0.8, lights: true}\n%s", precision,
             rest);
    check_slope(a, name, text, matt, NULL);
    snprintf(name, sizeof name, "a highlight, %s", precision);
    snprintf(rest, sizeof rest, FLOOR, "albedo: [0, 0.5, 0, 0], specular_exponent: 9");
    snprintf(text, sizeof text, "trace: {precision: %s}\nbackground: {color: 1, lights: true}\n%s", precision,
             rest);
    check_slope(a, name, text, shiny, NULL);
    snprintf(name, sizeof name, "an edge, %s", precision);
    snprintf(text, sizeof text, "trace: {precision: %s}\n%s", precision, edge_scene);
    check_slope(a, name, text, edge, NULL);
}

// ---- images

enum {
    WIDTH = 8,
    HEIGHT = 4,
};

struct sky {
    uint8_t texels[HEIGHT][WIDTH][3];
    double rotation; // degrees
    vec3 normal;
};

static double texel(const struct sky *sky, int row, int column, int channel) {
    row = row < 0 ? 0 : row >= HEIGHT ? HEIGHT - 1 : row;
    return sky->texels[row][(column + WIDTH) % WIDTH][channel] / 255.0;
}

static double seen(const struct sky *sky, double u, double v, int channel) {
    const double x = u * WIDTH - 0.5, y = v * HEIGHT - 0.5, s = x - floor(x), t = y - floor(y);
    const int column = (int)floor(x), row = (int)floor(y);
    return (texel(sky, row, column, channel) * (1 - s) + texel(sky, row, column + 1, channel) * s) * (1 - t) +
           (texel(sky, row + 1, column, channel) * (1 - s) + texel(sky, row + 1, column + 1, channel) * s) *
               t;
}

// Over all directions, of 1 / pi times the radiance times the cosine.
static bool sum_of_sky(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    enum {
        ROWS = 400
    };
    static double kept[3];
    static const void *of;
    const struct sky *sky = context;
    (void)origin;
    (void)direction;
    if (of != context) {
        kept[0] = kept[1] = kept[2] = 0;
        for (int i = 0; i < ROWS; i++)
            for (int k = 0; k < 2 * ROWS; k++) {
                const double v = (i + 0.5) / ROWS, u = (k + 0.5) / (2 * ROWS);
                const double longitude = 2 * PI * (u - 0.5) - sky->rotation * PI / 180;
                const vec3 l = {sin(PI * v) * cos(longitude), cos(PI * v), sin(PI * v) * sin(longitude)};
                const double part = fmax(0, vec3_dot(l, sky->normal)) * sin(PI * v) * PI / ROWS / ROWS;
                for (int c = 0; c < 3; c++)
                    kept[c] += part * seen(sky, u, v, c);
            }
        of = context;
    }
    // The intensity is 2, the floor's colour 0.5.
    memcpy(rgb, kept, sizeof kept);
    return true;
}

static bool write_sky(struct analytic *a, const struct sky *sky) {
    struct image image;
    struct strbuf bytes;
    if (!image_init(&image, WIDTH, HEIGHT))
        return false;
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++)
        image.rgb[i] = (float)((&sky->texels[0][0][0])[i] / 255.0);
    strbuf_init(&bytes);
    image_encode(&image, IMAGE_PNG,
                 (struct image_display){.tone = IR_TONE_CLIP, .transfer = IR_TRANSFER_NONE}, &bytes);
    const str text = strbuf_view(&bytes);
    const bool good = !bytes.failed && analytic_write(a, "lights.png", text.ptr, text.len);
    strbuf_finish(&bytes);
    image_finish(&image);
    return good;
}

// A floor and a wall under an image that is black but for a few texels: where nothing is bright, nothing is
// looked for, and what lies between a bright texel and a black one must not be lost.
static void check_image(struct analytic *a, const char *precision) {
    static struct sky skies[2] = {{.normal = {0, 1, 0}}, {.rotation = 100, .normal = {0.6, 0.8, 0}}};
    for (int i = 0; i < 2; i++) {
        char text[TEXT], name[64];
        uint8_t(*t)[WIDTH][3] = skies[i].texels;
        t[0][1][0] = t[0][1][1] = t[0][1][2] = t[1][6][0] = t[2][5][1] = 255;
        t[1][2][2] = 100;
        if (!write_sky(a, &skies[i]))
            analytic_expect(a, false, "image", "could not be written");
        snprintf(name, sizeof name, "image %d, %s", i, precision);
        // Turned about z, as the normal says.
        snprintf(
            text, sizeof text,
            "trace: {precision: %s}\nbackground: {image: lights.png, rotation: %g, intensity: 2, lights: "
            "true}\n"
            "rectangles:\n  - {corner: [%.17g, %.17g, -9], edge_u: [0, 0, 18], edge_v: [%.17g, %.17g, 0],"
            " material: {diffuse_color: 0.5}}\n",
            precision, skies[i].rotation, -9 * skies[i].normal.y, 9 * skies[i].normal.x,
            18 * skies[i].normal.y, -18 * skies[i].normal.x);
        check_slope(a, name, text, sum_of_sky, &skies[i]);
    }
}

// ---- next to random points

static double next_random(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static double random_light(vec3 p, uint64_t *state) {
    const double y = 1 - 2 * next_random(state), turn = 2 * PI * next_random(state);
    const double x = sqrt(1 - y * y) * cos(turn);
    return y > 0 && x + p.x * y > 0 ? 4 * y : 0;
}

static double flip_of(const float *rgb, const float *reference, uint32_t size) {
    struct measure_options options = measure_options_default();
    struct measure_result result;
    options.metrics = 1u << METRIC_FLIP;
    return measure_pictures(size, size, rgb, reference, &options, &result, NULL, NULL)
               ? result.value[METRIC_FLIP]
               : NAN;
}

static void check_against_random(struct analytic *a) {
    enum {
        SIZE = 96,
        SAMPLES = 16
    };
    static float truth[3 * SIZE * SIZE], random[3 * SIZE * SIZE];
    struct image image;
    uint64_t state = 1;
    const struct analytic_picture picture = {.name = "16 samples",
                                             .scene = edge_scene,
                                             .camera = {{0.2, 0.9, 0.1}, {0, -1, 0}, {0, 0, -1}, 70},
                                             .width = SIZE,
                                             .height = SIZE,
                                             .samples = SAMPLES};
    if (!analytic_take(a, &picture, &image))
        return;
    for (int i = 0; i < SIZE * SIZE; i++) {
        double exact = 0, rough = 0;
        for (int n = 0; n < SAMPLES; n++) {
            double u, v;
            analytic_offset(n, &u, &v);
            const vec3 d = analytic_direction(&picture, i % SIZE + u, i / SIZE + v);
            const vec3 p = analytic_at(picture.camera.position, d, -picture.camera.position.y / d.y);
            exact += below_edge(p) / SAMPLES;
            rough += random_light(p, &state) / SAMPLES;
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

int main(int argc, char **argv) {
    struct analytic a;
    int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    check_even(&a, "single");
    check_even(&a, "double");
    check_image(&a, "single");
    check_image(&a, "double");
    check_against_random(&a);
    return analytic_close(&a);
}
