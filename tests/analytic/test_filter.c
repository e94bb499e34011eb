// Images from afar and near by, where it is about digits: means of levels, places in an image that repeats
// many times, and footprints that are nearly round (docs/language.md, "Paint").
#include "analytic_kit.h"

#include <png.h>
#include <stdio.h>

enum {
    SIDE = 64,
};

static const char lamp[] =
    "trace: {shadows: false, precision: double}\nlights:\n  - {direction: [0, 0, -1]}\n";

// ---- images: of each pixel any value from `low` to `high`

struct noise {
    const char *file;
    int width, height, depth, low, high;
};

static const struct noise noises[] = {
    {"dark.png", 64, 64, 8, 0, 3},         {"mixed.png", 64, 64, 8, 0, 255},
    {"odd.png", 37, 101, 8, 0, 40},        {"column.png", 1, 50, 8, 0, 9},
    {"row.png", 200, 3, 8, 1, 2},          {"one.png", 1, 1, 8, 7, 7},
    {"black.png", 128, 128, 8, 0, 1},      {"dark16.png", 64, 64, 16, 0, 1000},
    {"mixed16.png", 37, 50, 16, 0, 65535},
};
#define NOISES (sizeof noises / sizeof *noises)

static int value_of(const struct noise *n, int x, int y, int channel) {
    uint32_t h = (uint32_t)(x * 3 + channel) * 2654435761U ^ (uint32_t)y * 2246822519U;
    h = (h ^ h >> 15) * 2246822519U;
    h = (h ^ h >> 13) * 3266489917U;
    return n->low + (int)((h ^ h >> 16) % (uint32_t)(n->high - n->low + 1));
}

static double linear_of(const struct noise *n, int x, int y, int channel, bool is_srgb) {
    const double c = value_of(n, x, y, channel) / (n->depth == 8 ? 255.0 : 65535.0);
    if (!is_srgb)
        return c;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static void add_bytes(png_structp png, png_bytep bytes, size_t count) {
    strbuf_add(png_get_io_ptr(png), bytes, count);
}

static bool write_noise(struct analytic *a, const struct noise *n) {
    struct strbuf out;
    uint8_t row[6 * 256];
    strbuf_init(&out);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &out, add_bytes, NULL);
    png_set_IHDR(png, info, (uint32_t)n->width, (uint32_t)n->height, n->depth, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int y = 0; y < n->height; y++) {
        for (int i = 0; i < 3 * n->width; i++) {
            const int value = value_of(n, i / 3, y, i % 3);
            if (n->depth == 8) {
                row[i] = (uint8_t)value;
            } else {
                row[2 * i] = (uint8_t)(value >> 8);
                row[2 * i + 1] = (uint8_t)value;
            }
        }
        png_write_row(png, row);
    }
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    const bool good = analytic_write(a, n->file, out.data, out.len);
    strbuf_finish(&out);
    return good;
}

// ---- what is far away is the image's mean

static void check_mean(struct analytic *a, const struct noise *n, bool is_srgb, double most) {
    char scene[512];
    struct image image;
    snprintf(scene, sizeof scene,
             "%srectangles:\n  - {corner: [-2, -2, -4], edge_u: [4, 0, 0], edge_v: [0, 4, 0],\n"
             "     material: {diffuse_color: {image: {file: %s, repeat: 100000}}}}\n",
             lamp, n->file);
    const struct analytic_picture picture = {.name = n->file,
                                             .scene = scene,
                                             .image_text = is_srgb ? ", transfer: srgb" : NULL,
                                             .width = 4,
                                             .height = 4,
                                             .camera = {.fov = 30}};
    if (!analytic_take(a, &picture, &image))
        return;
    double worst = 0;
    for (int channel = 0; channel < 3; channel++) {
        double mean = 0;
        for (int i = 0; i < n->width * n->height; i++)
            mean += linear_of(n, i % n->width, i / n->width, channel, is_srgb) / (n->width * n->height);
        for (int i = 0; i < 16; i++)
            worst = fmax(worst, fabs((double)image.rgb[3 * i + channel] / mean - 1));
    }
    printf("%-12s %s the mean is off by %.2g of it\n", n->file, is_srgb ? "srgb" : "none", worst);
    analytic_expect(a, worst <= most, n->file, "what is far away is not the image's mean");
    image_finish(&image);
}

// ---- places in an image that begins anew many times

struct far_place {
    const char *filter;
    double repeat, offset, rotation;
};

static double texel(long double u, long double v, bool is_nearest, int channel) {
    const struct noise *n = &noises[1];
    u -= floorl(u);
    v -= floorl(v);
    const long double x = u * SIDE - (is_nearest ? 0 : 0.5L), y = (1 - v) * SIDE - (is_nearest ? 0 : 0.5L);
    const long double x0 = floorl(x), y0 = floorl(y);
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        const int column = ((int)x0 + i % 2 + SIDE) % SIDE, row = ((int)y0 + i / 2 + SIDE) % SIDE;
        const double across = (double)(i % 2 ? x - x0 : 1 - (x - x0)),
                     down = (double)(i / 2 ? y - y0 : 1 - (y - y0));
        const double weight = is_nearest ? i == 0 : across * down;
        sum += weight * linear_of(n, column, row, channel, false);
    }
    return sum;
}

static bool far_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct far_place *f = context;
    const long double t = -(4.0L + (long double)origin.z) / (long double)direction.z;
    const long double a =
        ((long double)origin.x + t * (long double)direction.x + 4) / 8 - (long double)f->offset - 0.5L;
    const long double b =
        ((long double)origin.y + t * (long double)direction.y + 4) / 8 - (long double)f->offset - 0.5L;
    const long double angle = (long double)f->rotation * acosl(-1) / 180, c = cosl(angle), s = sinl(angle);
    const long double u = (long double)f->repeat * (a * c + b * s + 0.5L),
                      v = (long double)f->repeat * (b * c - a * s + 0.5L);
    const bool is_nearest = f->filter[0] == 'n';
    for (int channel = 0; channel < 3; channel++)
        rgb[channel] = texel(u, v, is_nearest, channel);
    const long double x = u * SIDE, y = v * SIDE;
    return !is_nearest || fminl(fabsl(x - roundl(x)), fabsl(y - roundl(y))) > 1e-5L;
}

static void check_far(struct analytic *a) {
    static const struct far_place places[] = {
        {"nearest", 2711.3, 0.3, 33},     {"bilinear", 2711.3, 0.3, 33}, {"nearest", 95123.7, 0.3, -121},
        {"bilinear", 95123.7, 0.3, -121}, {"nearest", 987654.3, -3, 12}, {"bilinear", 100, 9753.1, 12}};
    char scene[512];
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const struct far_place *f = &places[i];
        snprintf(
            scene, sizeof scene,
            "%srectangles:\n  - {corner: [-4, -4, -4], edge_u: [8, 0, 0], edge_v: [0, 8, 0],\n"
            "     material: {diffuse_color: {image: {file: mixed.png, filter: %s, repeat: %.17g, offset: "
            "[%.17g, %.17g], rotation: %.17g}}}}\n",
            lamp, f->filter, f->repeat, f->offset, f->offset, f->rotation);
        const struct analytic_picture picture = {.name = "an image that repeats many times",
                                                 .scene = scene,
                                                 .color = far_color,
                                                 .context = f,
                                                 .tolerance = 1e-6,
                                                 .most_beside = 0.01};
        analytic_check(a, &picture);
    }
}

// ---- where numbers are large, the device in double precision and the reference agree

struct pair {
    const char *name, *scene, *camera;
};

#define SIZE(size) "material: {diffuse_color: {checker: {colors: [0, 1], size: " size ", antialias: true}}}"
#define IMAGE      "material: {diffuse_color: {image: {file: mixed.png, repeat: 3}}}"
#define NARROW     ", projection: orthographic, size: "

static const struct pair pairs[] = {
    {"edges of a checker from near by",
     "rectangles:\n  - {corner: [-8, -8, -4], edge_u: [16, 0, 0], edge_v: [0, 16, -8], " SIZE("0.5") "}\n",
     "camera: {look_at: [0, 0, -4]" NARROW "0.001}"},
    {"the same at a million",
     "rectangles:\n  - {corner: [999992, -8, -4], edge_u: [16, 0, 0], edge_v: [0, 16, -8], " SIZE(
         "0.5") "}\n",
     "camera: {position: [1000000, 0, 0], look_at: [1000000, 0, -4]" NARROW "0.001}"},
    {"cells of a sphere", "spheres:\n  - {center: [0, 0, -4], radius: 2, " SIZE("0.5") "}\n",
     "camera: {look_at: [0, 0, -4]" NARROW "0.01}"},
    {"cells of a sphere at a billion",
     "spheres:\n  - {center: [1000000000, 0, -4], radius: 2, " SIZE("0.5") "}\n",
     "camera: {position: [1000000000, 0, 0], look_at: [1000000000, 0, -4]" NARROW "0.01}"},
    {"an image on a long triangle", "models:\n  - {mesh: long.obj, " IMAGE "}\n", "camera: {}"},
    {"cells of a long triangle", "models:\n  - {mesh: long.obj, " SIZE("0.05") "}\n", "camera: {}"},
    {"cells near where a ball gathers light",
     "spheres:\n  - {center: [0, 0, -4], radius: 1, material: {albedo: [0, 0, 0, 1], refractive_index: "
     "1.5}}\n"
     "rectangles:\n  - {corner: [-30, -30, -5.5], edge_u: [60, 0, 0], edge_v: [0, 60, 0], " SIZE(
         "0.03") "}\n",
     "camera: {look_at: [0, 0, -4], fov: 20}"},
    {"an image at a sphere's pole",
     "ambient: 1\nspheres:\n  - {center: [0, 0, 0], radius: 2, material: {diffuse_color: {image: {file: "
     "mixed.png, repeat: 5}}}}\n",
     "camera: {position: [0.00001, 4, 0], look_at: [0.00001, 0, -0.00002], up: [0, 0, -1], fov: 0.001}"},
};

static bool write_long(struct analytic *a) {
    static const char text[] = "v -100000 -8 -4\nv 100000 -7 -4.1\nv 0.1 9 -4\n"
                               "vt 0 0\nvt 28571.4 28570.9\nvt 14285.7 14084.5\nf 1/1 2/2 3/3\n";
    return analytic_write(a, "long.obj", text, sizeof text - 1);
}

static void check_pair(struct analytic *a, const struct pair *p) {
    char scene[512];
    struct image device, reference;
    double worst = 0;
    snprintf(scene, sizeof scene, "%s%s", lamp, p->scene);
    const struct analytic_picture picture = {.name = p->name, .scene = scene, .camera_text = p->camera};
    if (!analytic_take(a, &picture, &device))
        return;
    a->kit.by_reference = true;
    if (analytic_take(a, &picture, &reference)) {
        analytic_expect(a, picture_variety(&reference) > 9, p->name, "the picture shows nothing");
        for (size_t at = 0; at < (size_t)3 * device.width * device.height; at++)
            worst = fmax(worst, fabs((double)device.rgb[at] - (double)reference.rgb[at]));
        image_finish(&reference);
    }
    a->kit.by_reference = false;
    image_finish(&device);
    printf("%-32s differs by %.2g\n", p->name, worst);
    analytic_expect(a, worst <= 1e-6, p->name, "the reference shows something else");
}

static void check_pairs(struct analytic *a) {
    if (a->kit.by_reference)
        return;
    analytic_expect(a, write_long(a), "long.obj", "it could not be written");
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        check_pair(a, &pairs[i]);
}

// ---- a footprint that changes by a millionth changes nothing

static bool take_turned(struct analytic *a, double repeat, double aspect, double by, struct image *image) {
    char scene[512], camera[128];
    snprintf(
        scene, sizeof scene,
        "%srectangles:\n  - {corner: [-3, -3, -4], edge_u: [6, 0, 0], edge_v: [0, 6, 0],\n"
        "     material: {diffuse_color: {image: {file: mixed.png, repeat: [%.17g, %.17g], rotation: 45}}}}\n",
        lamp, repeat, repeat * aspect);
    snprintf(camera, sizeof camera,
             "camera: {look_at: [%.17g, %.17g, -4], projection: orthographic, size: 4}", by, -by);
    const struct analytic_picture picture = {
        .name = "a round footprint", .scene = scene, .camera_text = camera};
    return analytic_take(a, &picture, image);
}

static void check_even(struct analytic *a) {
    static const double repeats[] = {1, 3, 7.37, 11.3, 40}, aspects[] = {1, 3, 5};
    double worst = 0;
    for (size_t i = 0; i < sizeof repeats / sizeof *repeats; i++)
        for (size_t k = 0; k < sizeof aspects / sizeof *aspects; k++) {
            struct image still, turned;
            if (!take_turned(a, repeats[i], aspects[k], 0, &still))
                return;
            if (take_turned(a, repeats[i], aspects[k], 4e-7, &turned)) {
                for (size_t at = 0; at < (size_t)3 * still.width * still.height; at++)
                    worst = fmax(worst, fabs((double)still.rgb[at] - (double)turned.rgb[at]));
                image_finish(&turned);
            }
            image_finish(&still);
        }
    printf("a camera turned by a millionth: %.2g\n", worst);
    analytic_expect(a, worst <= 3e-4, "a round footprint", "the filter jumps");
}

int main(int argc, char **argv) {
    struct analytic a;
    const int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    for (size_t i = 0; i < NOISES; i++) {
        analytic_expect(&a, write_noise(&a, &noises[i]), noises[i].file, "it could not be written");
        for (int is_srgb = 0; is_srgb < 2; is_srgb++)
            check_mean(&a, &noises[i], is_srgb, noises[i].depth == 8 ? 1e-4 : 1e-6);
    }
    check_far(&a);
    check_pairs(&a);
    check_even(&a);
    return analytic_close(&a);
}
