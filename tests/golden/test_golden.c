// Small pictures of the scenes that ship against those kept beside this file: a tripwire that tells when a
// picture changed, not whether it is right.
//
// Usage: test_golden check|update FOLDER SCENE... A scene scenes/elements/x.glint.yaml has FOLDER/x.png.
// Two tolerances, since drivers for other processors round otherwise: few pixels may be off by much, and all
// of them together by little.
#include "tests/pictures/picture_kit.h"

#include "grammar/ir.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    WIDTH = 96,
    HEIGHT = 64,
    BYTES = WIDTH * HEIGHT * 3,
    SAMPLES = 4,
    MOST_OFF = 2, // of 255: a pixel further off in a channel is another pixel
    MOST_FILE_BYTES = 15000,
};
static const double MOST_OTHER_PIXELS = 0.005; // share
static const double MOST_MEAN_ERROR = 0.1;     // of 255

struct difference {
    double other_pixels, mean_error;
};

static struct difference compare(const uint8_t *a, const uint8_t *b) {
    int others = 0;
    double sum = 0;
    for (int i = 0; i < BYTES; i += 3) {
        int most = 0;
        for (int k = i; k < i + 3; k++) {
            int off = abs(a[k] - b[k]);
            sum += off;
            most = off > most ? off : most;
        }
        others += most > MOST_OFF;
    }
    return (struct difference){(double)others / (WIDTH * HEIGHT), sum / BYTES};
}

static bool is_same(struct difference d) {
    return d.other_pixels <= MOST_OTHER_PIXELS && d.mean_error <= MOST_MEAN_ERROR;
}

// Each tolerance must be able to fail: with a hundredth of the pixels, and with half of them a little
// brighter.
static bool proves_itself(const uint8_t *bytes) {
    static uint8_t other[BYTES];
    memcpy(other, bytes, BYTES);
    for (int i = 0; i < BYTES; i += 300)
        other[i] = (uint8_t)(other[i] < 128 ? other[i] + 3 : other[i] - 3);
    bool few = !is_same(compare(bytes, other)) && compare(bytes, other).mean_error < MOST_MEAN_ERROR;
    memcpy(other, bytes, BYTES);
    for (int i = 0; i < BYTES; i += 2)
        other[i] = (uint8_t)(other[i] < 128 ? other[i] + 1 : other[i] - 1);
    return few && !is_same(compare(bytes, other)) && compare(bytes, other).other_pixels == 0 &&
           is_same(compare(bytes, bytes));
}

static void take_display(struct ir_scene *scene, void *context) {
    struct image_display *display = context;
    *display = (struct image_display){scene->image.tone, scene->image.transfer};
}

static bool golden_path(const char *folder, const char *scene, char *out, size_t size) {
    const char *base = strrchr(scene, '/');
    base = base ? base + 1 : scene;
    const char *end = strstr(base, ".glint.yaml");
    return end && snprintf(out, size, "%s/%.*s.png", folder, (int)(end - base), base) < (int)size;
}

static bool read_png(const char *path, uint8_t bytes[BYTES]) {
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&png, path))
        return false;
    bool fits = png.width == WIDTH && png.height == HEIGHT && png.format == PNG_FORMAT_RGB;
    if (fits)
        return png_image_finish_read(&png, NULL, bytes, 0, NULL);
    png_image_free(&png);
    return false;
}

static bool write_golden(const char *path, const struct image *image, struct image_display display) {
    struct strbuf bytes;
    strbuf_init(&bytes);
    image_encode(image, IMAGE_PNG, display, &bytes);
    str text = strbuf_view(&bytes);
    FILE *file = bytes.failed || text.len > MOST_FILE_BYTES ? NULL : fopen(path, "wb");
    bool good = file && fwrite(text.ptr, 1, text.len, file) == text.len;
    if (file && fclose(file) != 0)
        good = false;
    if (!good)
        fprintf(stderr, "%s: %zu bytes were not written\n", path, text.len);
    strbuf_finish(&bytes);
    return good;
}

static bool check_golden(const char *path, const struct image *image, struct image_display display) {
    static uint8_t now[BYTES], then[BYTES];
    image_to_bytes(image, display, now);
    if (!read_png(path, then)) {
        fprintf(stderr, "%s: cannot be read; see CONTRIBUTING.md on how to renew it\n", path);
        return false;
    }
    struct difference d = compare(now, then);
    bool good = is_same(d) && proves_itself(now);
    printf("%s %s: %.3f %% other pixels, mean error %.4f of 255\n", good ? "ok  " : "FAIL", path,
           100 * d.other_pixels, d.mean_error);
    return good;
}

int main(int argc, char **argv) {
    struct picture_kit kit;
    bool update = argc > 1 && strcmp(argv[1], "update") == 0;
    int failed = 0;
    if (argc < 4 || (!update && strcmp(argv[1], "check") != 0)) {
        fprintf(stderr, "usage: test_golden check|update FOLDER SCENE...\n");
        return 2;
    }
    if (!picture_kit_open(&kit))
        return 77;
    for (int i = 3; i < argc; i++) {
        char path[1024];
        struct image image = {0};
        struct image_display display = {0};
        struct picture_options options = {
            .width = WIDTH, .height = HEIGHT, .samples = SAMPLES, .edit = take_display, .context = &display};
        bool good = golden_path(argv[2], argv[i], path, sizeof path) &&
                    picture_take(&kit, argv[i], &options, &image) &&
                    (update ? write_golden(path, &image, display) : check_golden(path, &image, display));
        if (!good)
            fprintf(stderr, "FAIL %s\n", argv[i]);
        failed += !good;
        image_finish(&image);
    }
    return picture_kit_close(&kit) || failed;
}
