// What the program writes: bytes floor(255 clamp(c) + 1/2) after tone and transfer, and floats before them
// (docs/language.md, "Output"). A background of HDR texels makes any value a pixel.
#include "analytic_kit.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    WIDTH = 64,
    HEIGHT = 48
};

static bool run(const char *glint, const char *folder, const char *output) {
    char command[4096];
    snprintf(command, sizeof command, "'%s' render '%s/picture.glint.yaml' -o '%s/%s' --quiet", glint, folder,
             folder, output);
    return system(command) == 0;
}

static uint8_t *read_png(const char *folder, const char *name) {
    char path[1024];
    png_image png = {.version = PNG_IMAGE_VERSION};
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (!png_image_begin_read_from_file(&png, path))
        return NULL;
    // Eight bits of three channels, without a colour space that a viewer would turn.
    bool plain = png.width == WIDTH && png.height == HEIGHT && png.format == PNG_FORMAT_RGB;
    uint8_t *bytes = plain ? malloc(PNG_IMAGE_SIZE(png)) : NULL;
    if (bytes && png_image_finish_read(&png, NULL, bytes, 0, NULL))
        return bytes;
    png_image_free(&png);
    free(bytes);
    return NULL;
}

// "PF", size, -1.0 for little endian, rows from the bottom.
static float *read_pfm(const char *folder, const char *name) {
    static const char header[] = "PF\n64 48\n-1.0\n";
    char path[1024], found[sizeof header] = "";
    size_t count = (size_t)WIDTH * HEIGHT * 3;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    float *values = malloc(count * sizeof *values), *out = malloc(count * sizeof *out);
    bool good = file && values && out && fread(found, 1, sizeof header - 1, file) == sizeof header - 1 &&
                strcmp(found, header) == 0 && fread(values, sizeof *values, count, file) == count &&
                fgetc(file) == EOF;
    if (file)
        fclose(file);
    for (int y = 0; good && y < HEIGHT; y++)
        memcpy(out + y * WIDTH * 3, values + (HEIGHT - 1 - y) * WIDTH * 3, WIDTH * 3 * sizeof *out);
    free(values);
    if (good)
        return out;
    free(out);
    return NULL;
}

static double srgb_encode(double value) {
    return value <= 0.0031308 ? value * 12.92 : 1.055 * pow(value, 1 / 2.4) - 0.055;
}

// Whether a byte is right for a linear value; at the very border between two bytes both are.
static bool is_byte(uint8_t got, double value, bool srgb) {
    value = fmin(1, fmax(0, value));
    double wanted = 255 * (srgb ? srgb_encode(value) : value) + 0.5;
    return got == floor(wanted - 1e-4) || got == floor(wanted + 1e-4);
}

static bool are_bytes(const uint8_t *bytes, const float *linear, bool normalize, bool srgb) {
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        const float *rgb = linear + 3 * i;
        double most = fmax(rgb[0], fmax(rgb[1], rgb[2])), divisor = normalize && most > 1 ? most : 1;
        for (int k = 0; k < 3; k++)
            if (!is_byte(bytes[3 * i + (size_t)k], rgb[k] / divisor, srgb)) {
                fprintf(stderr, "value %zu is byte %d of %.9g\n", 3 * i + (size_t)k, bytes[3 * i + (size_t)k],
                        (double)rgb[k]);
                return false;
            }
    }
    return true;
}

static void check(struct analytic *a, const char *glint, bool normalize, bool srgb) {
    char display[64];
    snprintf(display, sizeof display, ", tone: %s, transfer: %s", normalize ? "normalize" : "clip",
             srgb ? "srgb" : "none");
    struct analytic_picture picture = {.name = display,
                                       .scene = "background: {image: values.hdr}",
                                       .image_text = display,
                                       .width = WIDTH,
                                       .height = HEIGHT};
    struct image image;
    if (!analytic_take(a, &picture, &image))
        return;
    uint8_t *bytes = NULL;
    float *linear = NULL;
    bool good = run(glint, a->folder, "out.png") && run(glint, a->folder, "out.pfm");
    analytic_expect(a, good, display, "the program failed");
    if (good) {
        bytes = read_png(a->folder, "out.png");
        linear = read_pfm(a->folder, "out.pfm");
        analytic_expect(a, bytes && linear, display, "a file cannot be read back");
    }
    if (bytes && linear) {
        bool same = memcmp(linear, image.rgb, (size_t)WIDTH * HEIGHT * 3 * sizeof *linear) == 0;
        analytic_expect(a, same, display, "the PFM is not the picture before tone and transfer");
        analytic_expect(a, picture_variety(&image) > 1000 && are_bytes(bytes, linear, normalize, srgb),
                        display, "wrong bytes");
    }
    free(bytes);
    free(linear);
    image_finish(&image);
}

// 32 x 16 texels: from black to white and, in some, beyond.
static bool write_values(struct analytic *a) {
    unsigned char bytes[64 + 32 * 16 * 4];
    uint32_t state = 3;
    int length = snprintf((char *)bytes, 64, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 32\n");
    // The first texel must not look like a compressed row, which begins with 2, 2.
    for (int i = 0; i < 32 * 16 * 4; i++) {
        state = state * 1664525u + 1013904223u;
        bytes[length++] =
            (unsigned char)(i % 4 == 3 ? (i / 4 % 3 == 0 ? 129 : 128) : 3 + (state >> 24) % 250);
    }
    return analytic_write(a, "values.hdr", bytes, (size_t)length);
}

int main(int argc, char **argv) {
    struct analytic a;
    int code = argc > 2 ? analytic_open(&a, argc, argv) : 2;
    if (code)
        return code;
    if (write_values(&a))
        for (int k = 0; k < 4; k++)
            check(&a, argv[2], k & 1, k & 2);
    return analytic_close(&a);
}
