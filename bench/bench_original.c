// The picture of the original's method, beside glint's: how it looks, how long it takes, where it fails.
//
//     bench_original [--assets DIR] [--size WxH] [--fetch storage|texels] [--frames N] [--device NAME|N]
//                    [-o OUT.png|.pfm|.hdr] SCENE
//
// For information: pixels that the device cut short, and pixels that differ from glint's.
#include "bench/kit.h"
#include "bench/original/original.h"
#include "core/number.h"
#include "files/output.h"
#include "grammar/ir.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct options {
    const char *scene, *assets, *device, *output;
    uint32_t width, height, frames; // sizes 0: the scene's
    enum original_fetch fetch;
};

static int usage(void) {
    fputs("usage: bench_original [--assets DIR] [--size WxH] [--fetch storage|texels] [--frames N]\n"
          "                      [--device NAME|N] [-o OUT.png|.pfm|.hdr] SCENE\n",
          stderr);
    return 2;
}

static bool read_count(str text, uint32_t *out) {
    int64_t value;
    if (number_parse_integer(text, &value) != NUMBER_OK || value < 1 || value > 16384)
        return false;
    *out = (uint32_t)value;
    return true;
}

static bool read_option(struct options *o, int letter, const char *text) {
    const char *x = strchr(text, 'x');
    switch (letter) {
    case 'a':
        o->assets = text;
        return true;
    case 'd':
        o->device = text;
        return true;
    case 'o':
        o->output = text;
        return true;
    case 's':
        return x && read_count((str){text, (size_t)(x - text)}, &o->width) &&
               read_count(str_from(x + 1), &o->height);
    case 'f':
        o->fetch = strcmp(text, "texels") == 0 ? ORIGINAL_TEXELS : ORIGINAL_STORAGE;
        return o->fetch == ORIGINAL_TEXELS || strcmp(text, "storage") == 0;
    case 'n':
        return read_count(str_from(text), &o->frames);
    default:
        return false;
    }
}

static bool read_options(int argc, char **argv, struct options *o) {
    static const struct option table[] = {
        {"assets", 1, NULL, 'a'}, {"device", 1, NULL, 'd'}, {"output", 1, NULL, 'o'}, {"size", 1, NULL, 's'},
        {"fetch", 1, NULL, 'f'},  {"frames", 1, NULL, 'n'}, {NULL, 0, NULL, 0}};
    *o = (struct options){.assets = getenv("GLINT_ASSETS"), .frames = 1};
    for (int letter; (letter = getopt_long(argc, argv, "o:", table, NULL)) != -1;)
        if (!read_option(o, letter, optarg ? optarg : ""))
            return false;
    o->scene = argv[optind];
    return o->scene && !argv[optind + 1];
}

static bool write_picture(const char *path, const struct image *image, struct image_display display) {
    enum image_format format;
    if (!image_format_of_path(str_from(path), IMAGE_WRITTEN, &format)) {
        fprintf(stderr, "%s: the output must end in %s\n", path, IMAGE_WRITTEN_ENDINGS);
        return false;
    }
    struct strbuf file;
    strbuf_init(&file);
    image_encode(image, format, display, &file);
    const int error = file.failed ? 0 : output_whole(path, file.data, file.len);
    const bool done = !file.failed && error == 0;
    if (!done)
        fprintf(stderr, "%s: %s\n", path, error ? strerror(error) : "not enough memory");
    strbuf_finish(&file);
    return done;
}

static bool take_frames(const struct options *o, struct original *original, struct image *image,
                        struct bench_series *series, uint32_t *cut) {
    for (uint32_t i = 0; i < o->frames; i++) {
        double device;
        const struct bench_clocks start = bench_clocks_now();
        if (!original_render(original, image->rgb, &device, cut))
            return false;
        bench_add(series, start, device);
    }
    return true;
}

static bool show(const struct options *o, struct gpu *gpu, const struct bench_scene *scene,
                 struct bench_glint *glint, struct image *image) {
    static struct bench_series series;
    char error[GPU_ERROR_BYTES];
    uint32_t cut;
    if (!bench_glint_frame(glint, gpu, NULL))
        return false;
    struct original *original = original_create(glint->renderer, o->fetch, error);
    if (!original) {
        fprintf(stderr, "%s: %s\n", o->scene, error);
        return false;
    }
    const struct image_display display = image_display_of(scene->session.image);
    bool done = take_frames(o, original, image, &series, &cut);
    if (done) {
        bench_print_machine(gpu);
        printf("%u x %u pixels, %u triangles in %u boxes, %s\n", image->width, image->height,
               original_triangle_count(original), original_box_count(original),
               o->fetch == ORIGINAL_TEXELS ? "texel buffers" : "storage buffers");
        printf("median frame %.1f of %u, from %.1f to %.1f; %.1f of the processors\n",
               1e3 * bench_median(series.wall, series.count), series.count,
               1e3 * bench_least(series.wall, series.count), 1e3 * bench_most(series.wall, series.count),
               1e3 * bench_median(series.processor, series.count));
        printf("%u pixels cut short by the device; %u differ from glint's by more than 1/255, %u by more "
               "than 16/255\n",
               cut, bench_differing(image, &glint->image, display, 1),
               bench_differing(image, &glint->image, display, 16));
        done = !o->output || write_picture(o->output, image, display);
    } else {
        bench_device_failed(gpu);
    }
    original_destroy(original);
    return done;
}

int main(int argc, char **argv) {
    struct options o;
    if (!read_options(argc, argv, &o))
        return usage();
    struct bench_scene scene = {0};
    struct bench_glint glint = {0};
    struct image image = {0};
    struct gpu *gpu = bench_gpu(o.device);
    bool done = gpu && bench_scene_open(&scene, o.scene, o.assets);
    if (done) {
        struct render_settings settings = scene.settings;
        settings.width = o.width ? o.width : settings.width;
        settings.height = o.height ? o.height : settings.height;
        settings.samples = 1;
        done = bench_glint_open(&glint, gpu, &scene, &settings, false) &&
               image_init(&image, settings.width, settings.height) && show(&o, gpu, &scene, &glint, &image);
    }
    bench_glint_close(&glint);
    image_finish(&image);
    bench_scene_close(&scene);
    gpu_destroy(gpu);
    return done ? 0 : 1;
}
