// Images on surfaces: where each body shows which place of them, how they repeat, and what is seen from afar
// (docs/language.md, "Paint").
#include "analytic_kit.h"

#include "core/angle.h"
#include "picture/metrics/metrics.h"

#include <png.h>
#include <stdio.h> // jpeglib.h needs it

#include <jpeglib.h>
#include <stdlib.h>
#include <string.h>

enum {
    SIDE = 256, // of the ramps: pixel x, y from the top left has x / 255, y / 255, 0.5
};

static const char lamp[] = "trace: {shadows: false}\nlights:\n  - {direction: [0.25, -0.5, -1]}\n";
static const vec3 TO_LIGHT = {-0.25, 0.5, 1};

static bool write_picture(struct analytic *a, const char *name, int width, int height,
                          double (*value)(int x, int y, int channel)) {
    struct image image;
    struct strbuf bytes;
    if (!image_init(&image, (uint32_t)width, (uint32_t)height))
        return false;
    for (int i = 0; i < width * height * 3; i++)
        image.rgb[i] = (float)value(i / 3 % width, i / 3 / width, i % 3);
    strbuf_init(&bytes);
    image_encode(&image, IMAGE_PNG, (struct image_display){0}, &bytes);
    const bool good = analytic_write(a, name, bytes.data, bytes.len);
    strbuf_finish(&bytes);
    image_finish(&image);
    return good;
}

static void add_bytes(png_structp png, png_bytep bytes, size_t count) {
    strbuf_add(png_get_io_ptr(png), bytes, count);
}

// 16 bits a channel, as they are.
static void png16_of(const struct image *image, struct strbuf *out) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    const uint32_t values = 3 * image->width;
    uint8_t row[6 * SIDE];
    png_set_write_fn(png, out, add_bytes, NULL);
    png_set_IHDR(png, info, image->width, image->height, 16, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (uint32_t y = 0; y < image->height; y++) {
        for (uint32_t i = 0; i < values; i++) {
            const uint32_t value = (uint32_t)lrintf(image->rgb[values * y + i] * 65535);
            row[2 * i] = (uint8_t)(value >> 8);
            row[2 * i + 1] = (uint8_t)value;
        }
        png_write_row(png, row);
    }
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
}

static void jpeg_of(const struct image *image, struct strbuf *out) {
    struct jpeg_compress_struct jpeg = {0};
    struct jpeg_error_mgr errors;
    unsigned char *bytes = NULL;
    unsigned long count = 0;
    JSAMPLE row[3 * SIDE];
    JSAMPROW rows = row;
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &bytes, &count);
    jpeg.image_width = image->width;
    jpeg.image_height = image->height;
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 98, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    for (uint32_t y = 0; y < image->height; y++) {
        for (uint32_t i = 0; i < 3 * image->width; i++)
            row[i] = (JSAMPLE)lrintf(image->rgb[3 * image->width * y + i] * 255);
        jpeg_write_scanlines(&jpeg, &rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    strbuf_add(out, bytes, count);
    jpeg_destroy_compress(&jpeg);
    free(bytes);
}

static double ramp(int x, int y, int channel) {
    return channel == 0 ? x / 255.0 : channel == 1 ? y / 255.0 : 0.5;
}

// Between the middles of its pixels a ramp is linear. false: beside them, where it begins anew.
static bool ramp_at(double u, double v, double rgb[3]) {
    const double x = (u - floor(u)) * SIDE - 0.5, y = (1 - (v - floor(v))) * SIDE - 0.5;
    rgb[0] = x / 255;
    rgb[1] = y / 255;
    rgb[2] = 128 / 255.0; // as it is stored
    return x > 1 && x < 254 && y > 1 && y < 254;
}

static void shade(vec3 normal, double rgb[3]) {
    const double facing = fmax(0, vec3_dot(vec3_unit(normal), vec3_unit(TO_LIGHT)));
    for (int i = 0; i < 3; i++)
        rgb[i] *= facing;
}

static void check(struct analytic *a, const char *name, const char *scene, analytic_color color,
                  const void *context, double most_beside) {
    const struct analytic_picture picture = {.name = name,
                                             .scene = scene,
                                             .width = 96,
                                             .height = 64,
                                             .color = color,
                                             .context = context,
                                             .tolerance = 1.0 / 255,
                                             .most_beside = most_beside};
    analytic_check(a, &picture);
}

// ---- a sphere

struct globe {
    vec3 center;
    double radius;
};

static bool globe_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct globe *g = context;
    const double t = analytic_sphere(origin, direction, g->center, g->radius, 0);
    const double rim = vec3_length(vec3_cross(direction, vec3_sub(g->center, origin))) / g->radius;
    if (t < 0 || fabs(rim - 1) < 0.02)
        return fabs(rim - 1) > 0.02;
    const vec3 q = vec3_mul(vec3_sub(analytic_at(origin, direction, t), g->center), 1 / g->radius);
    // Near the poles neighbours in the image lie far apart.
    const bool sure = ramp_at(0.5 + atan2(q.z, q.x) / (2 * PI), 1 - acos(q.y) / PI, rgb) && fabs(q.y) < 0.95;
    shade(vec3_dot(q, direction) <= 0 ? q : vec3_neg(q), rgb);
    return sure;
}

static void check_globes(struct analytic *a) {
    static const struct globe globes[] = {{{0.5, -0.25, -5}, 2}, {{0, 0.25, 0.5}, 3}, {{300, 20, -800}, 250}};
    char scene[1024];
    for (size_t i = 0; i < sizeof globes / sizeof *globes; i++) {
        const struct globe *g = &globes[i];
        snprintf(scene, sizeof scene,
                 "%sspheres:\n  - {center: [%.17g, %.17g, %.17g], radius: %.17g,\n"
                 "     material: {diffuse_color: {image: {file: ramp.png, filter: bilinear}}}}\n",
                 lamp, g->center.x, g->center.y, g->center.z, g->radius);
        check(a, "image on a sphere", scene, globe_color, g, 0.2);
    }
}

// ---- a rectangle

struct sheet {
    vec3 corner, u, v;
    double repeat[2], offset[2], rotation;
};

// How far along both edges.
static bool sheet_place(const struct sheet *s, vec3 origin, vec3 direction, double place[2], vec3 *normal) {
    *normal = vec3_cross(s->u, s->v);
    const double t = analytic_plane(origin, direction, s->corner, *normal);
    const vec3 p = vec3_sub(analytic_at(origin, direction, t), s->corner);
    const double uu = vec3_dot(s->u, s->u), uv = vec3_dot(s->u, s->v), vv = vec3_dot(s->v, s->v);
    const double pu = vec3_dot(p, s->u), pv = vec3_dot(p, s->v), det = uu * vv - uv * uv;
    place[0] = (pu * vv - pv * uv) / det;
    place[1] = (pv * uu - pu * uv) / det;
    if (vec3_dot(*normal, direction) > 0)
        *normal = vec3_neg(*normal);
    return t > 0;
}

static bool sheet_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct sheet *s = context;
    double place[2];
    vec3 normal;
    const bool ahead = sheet_place(s, origin, direction, place, &normal);
    const double outside = fmax(fmax(-place[0], place[0] - 1), fmax(-place[1], place[1] - 1));
    if (!ahead || outside > 0)
        return !ahead || outside > 1e-3;
    // Moved back, turned back about the middle, then counted in images.
    const double angle = s->rotation * PI / 180, x = place[0] - s->offset[0] - 0.5,
                 y = place[1] - s->offset[1] - 0.5;
    const double u = s->repeat[0] * (x * cos(angle) + y * sin(angle) + 0.5);
    const double v = s->repeat[1] * (-x * sin(angle) + y * cos(angle) + 0.5);
    const bool sure = ramp_at(u, v, rgb) && outside < -1e-3;
    shade(normal, rgb);
    return sure;
}

static void check_sheets(struct analytic *a) {
    static const struct sheet sheets[] = {
        {{-2, -1.5, -4}, {4, 0, 0}, {0, 3, 0}, {1, 1}, {0, 0}, 0},
        {{-2, -1.5, -4}, {0, 3, 0}, {4, 0, 0}, {1, 1}, {0, 0}, 0}, // seen from its back
        {{2, 1, -5}, {-4.5, 0.25, 0.5}, {0.7, -2.5, 1}, {2, 1.5}, {0.25, -0.125}, 30},
        {{-2, -1.5, -4}, {4, 0, 0}, {0, 3, 0}, {1, 1}, {0, 0}, 90},
        {{-2, -1.5, -4}, {4, 0, 0}, {0, 3, 0}, {0.5, 2}, {-3, 0.7}, -137},
    };
    char scene[1024];
    for (size_t i = 0; i < sizeof sheets / sizeof *sheets; i++) {
        const struct sheet *s = &sheets[i];
        snprintf(scene, sizeof scene,
                 "%srectangles:\n  - corner: [%.17g, %.17g, %.17g]\n    edge_u: [%.17g, %.17g, %.17g]\n"
                 "    edge_v: [%.17g, %.17g, %.17g]\n    material: {diffuse_color: {image: {file: ramp.png, "
                 "filter: bilinear, repeat: [%.17g, %.17g], offset: [%.17g, %.17g], rotation: %.17g}}}\n",
                 lamp, s->corner.x, s->corner.y, s->corner.z, s->u.x, s->u.y, s->u.z, s->v.x, s->v.y, s->v.z,
                 s->repeat[0], s->repeat[1], s->offset[0], s->offset[1], s->rotation);
        check(a, "image on a rectangle", scene, sheet_color, s, 0.1);
    }
}

// ---- a mesh: a flat face of four corners, whose coordinates are those of its corners

static const char mesh_text[] =
    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0.1 0.1\nvt 0.9 0.2\nvt 0.8 0.9\nvt 0 0.8\n"
    "f -4/-4 -3/-3 -2/-2 -1/-1\n";

// The same as a rectangle whose image is placed so that both show the same: 0.1 + 0.8 a - 0.1 b, 0.1 + 0.1 a
// + 0.7 b.
static bool mesh_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct sheet *s = context;
    double place[2];
    vec3 normal;
    const bool ahead = sheet_place(s, origin, direction, place, &normal);
    const double outside = fmax(fmax(-place[0], place[0] - 1), fmax(-place[1], place[1] - 1));
    if (!ahead || outside > 0)
        return !ahead || outside > 1e-3;
    const bool sure =
        ramp_at(0.1 + 0.8 * place[0] - 0.1 * place[1], 0.1 + 0.1 * place[0] + 0.7 * place[1], rgb);
    shade(normal, rgb);
    return sure && outside < -1e-3;
}

static void check_meshes(struct analytic *a) {
    // As the mesh is scaled: mirrored, too; two of one mesh are instances where that is possible.
    static const struct {
        vec3 scale;
        struct sheet sheet;
    } cases[] = {
        {{2, 1.5, 1}, {{-2, -1.5, -4}, {4, 0, 0}, {0, 3, 0}, {1, 1}, {0, 0}, 0}},
        {{-2, 1.5, 1}, {{2, -1.5, -4}, {-4, 0, 0}, {0, 3, 0}, {1, 1}, {0, 0}, 0}},
    };
    char scene[1024];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const vec3 scale = cases[i].scale;
        snprintf(scene, sizeof scene,
                 "%smodels:\n  - {mesh: quad.obj, scale: [%.17g, %.17g, %.17g], translation: [0, 0, -4],\n"
                 "     material: {diffuse_color: {image: {file: ramp.png, filter: bilinear}}}}\n",
                 lamp, scale.x, scale.y, scale.z);
        check(a, "image on a mesh", scene, mesh_color, &cases[i].sheet, 0.1);
    }
}

// ---- wrap and filter near by: 2 x 2 pixels

static double four(int x, int y, int channel) {
    return channel == 0 ? x : channel == 1 ? y : 0;
}

struct way {
    const char *filter, *wrap;
};

static double wrapped(double t, const char *wrap) {
    if (!strcmp(wrap, "clamp"))
        return fmin(fmax(t, 0), 1);
    if (!strcmp(wrap, "mirror"))
        return fabs(t - 2 * floor(t / 2 + 0.5));
    return t - floor(t);
}

// One coordinate of an image of two pixels, 0 and 1.
static double two(double t, const struct way *way) {
    t = wrapped(t, way->wrap);
    if (!strcmp(way->filter, "nearest"))
        return t < 0.5 ? 0 : 1;
    if (!strcmp(way->wrap, "repeat") && (t < 0.25 || t > 0.75))
        return t < 0.25 ? 0.5 - 2 * t : 1 - 2 * (t - 0.75);
    return fmin(fmax(2 * t - 0.5, 0), 1);
}

static bool way_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    static const struct sheet sheet = {{-2, -1.5, -4}, {4, 0, 0}, {0, 3, 0}, {3, 3}, {0, 0}, 0};
    double place[2];
    vec3 normal;
    sheet_place(&sheet, origin, direction, place, &normal);
    const double outside = fmax(fmax(-place[0], place[0] - 1), fmax(-place[1], place[1] - 1));
    if (outside > 0)
        return outside > 1e-3;
    const double u = 3 * place[0] - 1, v = 3 * place[1] - 1;
    rgb[0] = two(u, context);
    rgb[1] = two(1 - v, context);
    rgb[2] = 0;
    shade(normal, rgb);
    const double edge = fmin(fabs(2 * u - nearbyint(2 * u)), fabs(2 * v - nearbyint(2 * v)));
    return outside < -1e-3 && edge > 1e-3;
}

static void check_ways(struct analytic *a) {
    static const struct way ways[] = {{"nearest", "repeat"},  {"nearest", "clamp"},  {"nearest", "mirror"},
                                      {"bilinear", "repeat"}, {"bilinear", "clamp"}, {"bilinear", "mirror"},
                                      {"auto", "repeat"}};
    char scene[1024];
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        snprintf(scene, sizeof scene,
                 "%srectangles:\n  - {corner: [-2, -1.5, -4], edge_u: [4, 0, 0], edge_v: [0, 3, 0],\n"
                 "     material: {diffuse_color: {image: {file: four.png, repeat: 3, offset: "
                 "[0.33333333333333331, "
                 "0.33333333333333331], filter: %s, wrap: %s}}}}\n",
                 lamp, ways[i].filter, ways[i].wrap);
        check(a, "wrap and filter", scene, way_color, &ways[i], 0.1);
    }
}

// ---- kinds of files: a gradient, stored as each can

struct kind {
    const char *file;
    double scale; // of what is stored
    double tolerance;
};

static double gradient(double u) {
    return 1 - fabs(2 * u - 1);
}

static bool kind_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    static const struct sheet sheet = {{-2, -1.5, -4}, {4, 0, 0}, {0, 3, 0}, {1, 1}, {0, 0}, 0};
    double place[2];
    vec3 normal;
    (void)context;
    sheet_place(&sheet, origin, direction, place, &normal);
    const double outside = fmax(fmax(-place[0], place[0] - 1), fmax(-place[1], place[1] - 1));
    for (int i = 0; i < 3; i++)
        rgb[i] = outside > 0 ? 0 : gradient(place[0]) * (1 - 0.25 * i);
    shade(normal, rgb);
    const double middle = fabs(place[0] - 0.5);
    return fabs(outside) > 1e-3 && (outside > 0 || (middle > 0.02 && middle < 0.48));
}

static bool write_kind(struct analytic *a, const struct kind *kind) {
    enum {
        WIDTH = 64,
        HEIGHT = 4
    };
    struct strbuf bytes;
    struct image image;
    strbuf_init(&bytes);
    if (!image_init(&image, WIDTH, HEIGHT))
        return false;
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++)
        image.rgb[i] = (float)(kind->scale * gradient((i / 3 % WIDTH + 0.5) / WIDTH) * (1 - 0.25 * (i % 3)));
    if (strstr(kind->file, ".jpg"))
        jpeg_of(&image, &bytes);
    else if (strstr(kind->file, ".hdr"))
        image_encode(&image, IMAGE_HDR, (struct image_display){0}, &bytes);
    else
        png16_of(&image, &bytes);
    const bool good = bytes.len > 0 && analytic_write(a, kind->file, bytes.data, bytes.len);
    strbuf_finish(&bytes);
    image_finish(&image);
    return good;
}

static void check_kinds(struct analytic *a) {
    // Of 16 bits the lower eight alone; beyond 1; and with what JPEG loses.
    static const struct kind kinds[] = {
        {"low.png", 255.0 / 65535, 1.0 / 255}, {"bright.hdr", 40, 1.0 / 255}, {"lossy.jpg", 1, 4.0 / 255}};
    char scene[1024];
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        analytic_expect(a, write_kind(a, &kinds[i]), kinds[i].file, "it could not be written");
        snprintf(scene, sizeof scene,
                 "trace: {shadows: false}\nlights:\n  - {direction: [0.25, -0.5, -1], intensity: %.17g}\n"
                 "rectangles:\n  - {corner: [-2, -1.5, -4], edge_u: [4, 0, 0], edge_v: [0, 3, 0],\n"
                 "     material: {diffuse_color: {image: {file: %s, filter: bilinear}}}}\n",
                 1 / kinds[i].scale, kinds[i].file);
        const struct analytic_picture picture = {.name = kinds[i].file,
                                                 .scene = scene,
                                                 .width = 96,
                                                 .height = 64,
                                                 .color = kind_color,
                                                 .context = &kinds[i],
                                                 .tolerance = kinds[i].tolerance,
                                                 .most_beside = 0.1};
        analytic_check(a, &picture);
    }
}

// ---- from afar

static double tiles(int x, int y, int channel) {
    const bool odd = (x / 16 + y / 16) % 2;
    return odd ? 0.9 - 0.1 * channel : 0.1 + 0.15 * channel + 0.2 * (x % 16) / 16;
}

#define FLOOR                                                                                                \
    "background: {color: [0.6, 0.7, 0.8]}\ntrace: {shadows: false}\nlights:\n  - {direction: [0.2, -1, "     \
    "-0.3]}\n"                                                                                               \
    "rectangles:\n  - {corner: [-60, -1, 20], edge_u: [120, 0, 0], edge_v: [0, 0, -120],\n     material: "

static bool take(struct analytic *a, const char *material, double along, int samples, struct image *out) {
    char scene[1024];
    snprintf(scene, sizeof scene, FLOOR "%s}\n", material);
    const struct analytic_picture picture = {
        .name = "floor",
        .scene = scene,
        .width = 120,
        .height = 90,
        .samples = samples,
        .camera = {.position = {0.3, 0.2, -along}, .forward = {-0.05, -0.12, -1}}};
    return analytic_take(a, &picture, out);
}

static double flip_of(const struct image *picture, const struct image *reference) {
    const struct measure_options options = measure_options_default();
    struct measure_result result;
    const bool good = measure_pictures(picture->width, picture->height, picture->rgb, reference->rgb,
                                       &options, &result, NULL, NULL);
    return good ? metric_error(METRIC_FLIP, result.value[METRIC_FLIP]) : INFINITY;
}

// FLIP to 256 samples, at one: of the filtered floor at most `most` of that of the unfiltered one.
static void check_floor(struct analytic *a, const char *name, const char *filtered, const char *plain,
                        double most) {
    struct image one, rough, exact;
    if (!take(a, filtered, 0, 1, &one) || !take(a, plain, 0, 1, &rough) || !take(a, plain, 0, 256, &exact))
        return;
    const double ratio = flip_of(&one, &exact) / flip_of(&rough, &exact);
    printf("%s: FLIP to 256 samples is %.3f of that without a filter\n", name, ratio);
    analytic_expect(a, ratio <= most, name, "more than it may differ");
    image_finish(&one);
    image_finish(&rough);
    image_finish(&exact);
}

// The mean difference of neighbouring frames of a slow dolly over the rows below the horizon, in whose pixels
// many tiles lie.
static double shimmer(struct analytic *a, const char *material) {
    enum {
        FRAMES = 6,
        FAR_ROWS = 4,
        HORIZON = 36
    };
    struct image before = {0}, now;
    double sum = 0;
    size_t count = 0;
    for (int frame = 0; frame < FRAMES; frame++) {
        if (!take(a, material, 0.05 * frame, 1, &now))
            return INFINITY;
        for (size_t i = 0; before.rgb && i < (size_t)FAR_ROWS * now.width * 3; i++, count++)
            sum += fabs((double)now.rgb[i + (size_t)HORIZON * now.width * 3] -
                        (double)before.rgb[i + (size_t)HORIZON * now.width * 3]);
        image_finish(&before);
        before = now;
    }
    image_finish(&before);
    return sum / (double)count;
}

static void check_dolly(struct analytic *a, const char *name, const char *filtered, const char *plain,
                        double most) {
    const double still = shimmer(a, filtered), rough = shimmer(a, plain);
    printf("%s: neighbouring frames differ by %.5f, without a filter by %.5f\n", name, still, rough);
    analytic_expect(a, still <= most, name, "it shimmers");
    analytic_expect(a, rough > 4 * most, name, "the test could not tell");
}

#define IMAGE(filter)   "{diffuse_color: {image: {file: tiles.png, repeat: 60, filter: " filter "}}}"
#define CHECKER(filter) "{diffuse_color: {checker: {colors: [0.9, 0.1], size: 0.3, antialias: " filter "}}}"

int main(int argc, char **argv) {
    struct analytic a;
    const int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    if (write_picture(&a, "ramp.png", SIDE, SIDE, ramp) && write_picture(&a, "four.png", 2, 2, four) &&
        write_picture(&a, "tiles.png", 96, 64, tiles) &&
        analytic_write(&a, "quad.obj", mesh_text, sizeof mesh_text - 1)) {
        check_globes(&a);
        check_sheets(&a);
        check_meshes(&a);
        check_ways(&a);
        check_kinds(&a);
        check_floor(&a, "an image", IMAGE("auto"), IMAGE("bilinear"), 0.35);
        check_floor(&a, "a checker", CHECKER("true"), CHECKER("false"), 0.35);
        check_dolly(&a, "an image", IMAGE("auto"), IMAGE("bilinear"), 0.002);
        check_dolly(&a, "a checker", CHECKER("true"), CHECKER("false"), 0.002);
    }
    return analytic_close(&a);
}
