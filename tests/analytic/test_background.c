// What rays see that meet nothing: one colour, and an equirectangular image (docs/language.md, "Background").
#include "analytic_kit.h"
#include "core/angle.h"

#include <stdio.h>
#include <string.h>

// Texels as the file holds them: 0..1, or any size for HDR.
struct sky {
    int width, height;
    double texels[16 * 16][3];
    double rotation, intensity;
};

static double noise(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / 0x1p24;
}

static const double *texel(const struct sky *sky, int x, int y) {
    x = (x + sky->width) % sky->width;
    y = y < 0 ? 0 : y >= sky->height ? sky->height - 1 : y;
    return sky->texels[y * sky->width + x];
}

static bool sky_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct sky *sky = context;
    (void)origin;
    // Near the poles a rounded direction has any longitude.
    if (hypot(direction.x, direction.z) < 0.02)
        return false;
    // Turned by -rotation about +y.
    double angle = -sky->rotation * PI / 180;
    double x = direction.x * cos(angle) + direction.z * sin(angle);
    double z = -direction.x * sin(angle) + direction.z * cos(angle);
    double u = (0.5 + atan2(z, x) / (2 * PI)) * sky->width - 0.5;
    double v = acos(direction.y) / PI * sky->height - 0.5;
    int column = (int)floor(u), row = (int)floor(v);
    double fu = u - column, fv = v - row;
    for (int i = 0; i < 3; i++) {
        double upper = texel(sky, column, row)[i] * (1 - fu) + texel(sky, column + 1, row)[i] * fu;
        double lower = texel(sky, column, row + 1)[i] * (1 - fu) + texel(sky, column + 1, row + 1)[i] * fu;
        rgb[i] = (upper * (1 - fv) + lower * fv) * sky->intensity;
    }
    return true;
}

static bool constant_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    (void)origin, (void)direction;
    memcpy(rgb, context, 3 * sizeof(double));
    return true;
}

// Eight bits a channel: k/255, written as PNG.
static bool write_png(struct analytic *a, const struct sky *sky) {
    struct image image;
    struct strbuf bytes;
    if (!image_init(&image, (uint32_t)sky->width, (uint32_t)sky->height))
        return false;
    for (int i = 0; i < sky->width * sky->height * 3; i++)
        image.rgb[i] = (float)sky->texels[i / 3][i % 3];
    strbuf_init(&bytes);
    image_encode(&image, IMAGE_PNG,
                 (struct image_display){.tone = IR_TONE_CLIP, .transfer = IR_TRANSFER_NONE}, &bytes);
    str text = strbuf_view(&bytes);
    bool good = !bytes.failed && analytic_write(a, "sky.png", text.ptr, text.len);
    strbuf_finish(&bytes);
    image_finish(&image);
    return good;
}

// Shared exponents without compression, for values k/128 * 2^e.
static bool write_hdr(struct analytic *a, const struct sky *sky) {
    unsigned char bytes[64 + 16 * 16 * 4];
    int length = snprintf((char *)bytes, 64, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n",
                          sky->height, sky->width);
    for (int i = 0; i < sky->width * sky->height; i++) {
        for (int k = 0; k < 3; k++)
            bytes[length++] = (unsigned char)(sky->texels[i][k] * 32);
        bytes[length++] = 128 + 8 - 5;
    }
    return analytic_write(a, "sky.hdr", bytes, (size_t)length);
}

static void check_views(struct analytic *a, const struct sky *sky, const char *file, const char *image_text,
                        double tolerance) {
    static const vec3 views[] = {{1, 0, 0},  {-1, 0, 0},    {0, 0, 1},
                                 {0, 0, -1}, {0.3, 1, 0.1}, {0.2, -1, -0.4}};
    char scene[256], name[128];
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++) {
        snprintf(scene, sizeof scene, "background: {image: %s, rotation: %.17g, intensity: %.17g}", file,
                 sky->rotation, sky->intensity);
        snprintf(name, sizeof name, "%s %dx%d turned by %g, view %zu", file, sky->width, sky->height,
                 sky->rotation, i);
        struct analytic_picture picture = {.name = name,
                                           .scene = scene,
                                           .camera = {{5, -3, 2}, views[i], {0, 1, 0.001}, 90},
                                           .image_text = image_text,
                                           .color = sky_color,
                                           .context = sky,
                                           .tolerance = tolerance,
                                           .most_beside = 0.01};
        analytic_check(a, &picture);
    }
}

static void check_colors(struct analytic *a) {
    double color[3] = {0.25 * 3, 0.5 * 3, 2 * 3};
    struct analytic_picture picture = {.name = "a colour times intensity",
                                       .scene = "background: {color: [0.25, 0.5, 2], intensity: 3}",
                                       .color = constant_color,
                                       .context = color};
    analytic_check(a, &picture);
    picture.name = "no background";
    picture.scene = "";
    memset(color, 0, sizeof color);
    analytic_check(a, &picture);
    // Digits of a colour are displayed values.
    for (int i = 0; i < 3; i++) {
        static const int digits[3] = {0x20, 0x80, 0x05};
        double value = digits[i] / 255.0;
        color[i] = value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
    }
    picture.name = "#208005 with transfer srgb";
    picture.scene = "background: {color: \"#208005\"}";
    picture.image_text = ", transfer: srgb";
    picture.tolerance = 1e-7;
    analytic_check(a, &picture);
    picture.name = "#208005 with transfer none";
    picture.image_text = NULL;
    color[0] = 0x20 / 255.0, color[1] = 0x80 / 255.0, color[2] = 0x05 / 255.0;
    analytic_check(a, &picture);
}

static void decode_srgb(struct sky *sky) {
    for (int i = 0; i < sky->width * sky->height * 3; i++) {
        double *value = &sky->texels[i / 3][i % 3];
        *value = *value <= 0.04045 ? *value / 12.92 : pow((*value + 0.055) / 1.055, 2.4);
    }
}

int main(int argc, char **argv) {
    static struct sky sky = {.width = 16, .height = 8, .intensity = 1};
    struct analytic a;
    uint32_t state = 1;
    int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    check_colors(&a);
    for (int i = 0; i < 16 * 8 * 3; i++)
        sky.texels[i / 3][i % 3] = floor(noise(&state) * 256) / 255;
    if (write_png(&a, &sky)) {
        check_views(&a, &sky, "sky.png", NULL, 1e-5);
        sky.rotation = -137.5, sky.intensity = 0.5;
        check_views(&a, &sky, "sky.png", NULL, 1e-5);
        decode_srgb(&sky);
        sky.rotation = 90, sky.intensity = 1;
        check_views(&a, &sky, "sky.png", ", transfer: srgb", 1e-5);
    }
    // An odd width, one column, one row; values above 1 from a file that is linear whatever the transfer.
    static const int sizes[][2] = {{5, 7}, {1, 9}, {11, 1}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        sky = (struct sky){.width = sizes[i][0], .height = sizes[i][1], .rotation = 30, .intensity = 2};
        for (int k = 0; k < sky.width * sky.height * 3; k++)
            sky.texels[k / 3][k % 3] = floor(noise(&state) * 128 + 128) / 32;
        if (write_hdr(&a, &sky))
            check_views(&a, &sky, "sky.hdr", ", transfer: srgb", 1e-5);
    }
    return analytic_close(&a);
}
