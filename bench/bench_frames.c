// Steady frames of glint: against the original's method in the same run, and what they cost besides.
//
//     bench_frames [--assets DIR] [--rounds N] [--device NAME|N] [SCENE]...
//
// First the original's scene, whose meshes lie in DIR (else GLINT_ASSETS), at 512x384: one frame by the
// original's method, then several of glint, and so on in turn. Then glint alone, on that scene and on those
// named: sizes, the kernel made for the scene against those with everything compiled in and with counters,
// samples.
#include "bench/kit.h"
#include "bench/original/original.h"
#include "core/number.h"
#include "grammar/ir.h"
#include "shaders/features.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const ORIGINAL_SCENE = "tests/scenes/original.glint.yaml";

enum {
    WIDTH = 512,
    HEIGHT = 384,
    GLINT_FRAMES = 8, // of glint beside one of the original
    TURNS = 8,        // frames of each in a round of glint alone
    ROUNDS = 3,
    ROUNDS_MOST = 100,
    CONTESTANTS_MOST = 4,
};

struct bench {
    struct gpu *gpu;
    const char *assets;
    uint32_t rounds;
};

static void print_head(const char *scene) {
    printf("\n%s\n%-9s  %-33s %6s %9s %9s %9s %9s %9s %7s\n", scene, "pixels", "", "frames", "median",
           "least", "most", "device", "cpu", "times");
}

// `times`: the median against another one.
static void print_row(const struct render_settings *settings, const char *what,
                      const struct bench_series *series, double against) {
    char size[32];
    const double median = bench_median(series->wall, series->count);
    snprintf(size, sizeof size, "%ux%u", settings->width, settings->height);
    printf("%-9s  %-33s %6u %9.1f %9.1f %9.1f %9.1f %9.1f %7.2f\n", size, what, series->count, 1e3 * median,
           1e3 * bench_least(series->wall, series->count), 1e3 * bench_most(series->wall, series->count),
           1e3 * bench_median(series->device, series->count),
           1e3 * bench_median(series->processor, series->count), median / against);
    fflush(stdout);
}

// ---- against the original's method

struct duel {
    struct bench_glint glint;
    struct original *original;
    struct image image; // by the original's method
    uint32_t cut;
    struct bench_series times, original_times;
};

static bool glint_frames(const struct bench *bench, struct duel *duel) {
    for (int i = 0; i < GLINT_FRAMES; i++)
        if (!bench_glint_frame(&duel->glint, bench->gpu, &duel->times))
            return false;
    return true;
}

static bool fight(const struct bench *bench, struct duel *duel) {
    for (uint32_t round = 0; round < bench->rounds; round++) {
        if (!glint_frames(bench, duel))
            return false;
        double device;
        const struct bench_clocks start = bench_clocks_now();
        if (!original_render(duel->original, duel->image.rgb, &device, &duel->cut))
            return bench_device_failed(bench->gpu);
        bench_add(&duel->original_times, start, device);
    }
    return glint_frames(bench, duel);
}

static void print_duel(const struct bench_scene *scene, const struct duel *duel,
                       const struct render_settings *settings) {
    const struct image_display display = image_display_of(scene->session.image);
    const double glint = bench_median(duel->times.wall, duel->times.count);
    print_head(scene->path);
    print_row(settings, "the original's method", &duel->original_times, glint);
    print_row(settings, "glint", &duel->times, glint);
    const double processor = bench_median(duel->times.processor, duel->times.count);
    printf("glint is %.1f times faster; with %.1f times less processor time\n"
           "the original's method: %u triangles in %u boxes, %u pixels cut short by the device;\n"
           "%u pixels differ from glint's by more than 1/255, %u by more than 16/255\n",
           bench_median(duel->original_times.wall, duel->original_times.count) / glint,
           bench_median(duel->original_times.processor, duel->original_times.count) / processor,
           original_triangle_count(duel->original), original_box_count(duel->original), duel->cut,
           bench_differing(&duel->image, &duel->glint.image, display, 1),
           bench_differing(&duel->image, &duel->glint.image, display, 16));
}

static bool measure_duel(const struct bench *bench, const struct bench_scene *scene) {
    static struct duel duel;
    char error[GPU_ERROR_BYTES];
    struct render_settings settings = scene->settings;
    settings.width = WIDTH;
    settings.height = HEIGHT;
    settings.samples = 1;
    bool done = bench_glint_open(&duel.glint, bench->gpu, scene, &settings, false) &&
                bench_glint_warm(&duel.glint, bench->gpu);
    if (done) {
        duel.original = original_create(duel.glint.renderer, ORIGINAL_STORAGE, error);
        if (!duel.original)
            fprintf(stderr, "%s: %s\n", scene->path, error);
        done = duel.original && image_init(&duel.image, WIDTH, HEIGHT) && fight(bench, &duel);
    }
    if (done)
        print_duel(scene, &duel, &settings);
    original_destroy(duel.original);
    image_finish(&duel.image);
    bench_glint_close(&duel.glint);
    return done;
}

// ---- glint alone

struct contestant {
    const char *name;
    uint32_t width, height, samples;
    bool general;   // everything compiled in
    bool is_double; // in double precision
    bool counts;    // counts its rays
};

// In turn, a frame each; rows of the table with the first contestant as the measure.
static bool measure_group(const struct bench *bench, const struct bench_scene *scene,
                          const struct contestant *contestants, int count) {
    static struct bench_series series[CONTESTANTS_MOST];
    struct bench_glint glints[CONTESTANTS_MOST] = {0};
    struct render_settings settings[CONTESTANTS_MOST];
    bool done = true;
    memset(series, 0, sizeof series);
    for (int i = 0; i < count && done; i++) {
        settings[i] = scene->settings;
        settings[i].width = contestants[i].width;
        settings[i].height = contestants[i].height;
        settings[i].samples = contestants[i].samples;
        settings[i].counts = contestants[i].counts;
        settings[i].features = scene->settings.features | (contestants[i].general ? FEATURE_GENERAL : 0);
        done = bench_glint_open(&glints[i], bench->gpu, scene, &settings[i], contestants[i].is_double) &&
               bench_glint_warm(&glints[i], bench->gpu);
    }
    for (uint32_t turn = 0; turn < bench->rounds * TURNS && done; turn++)
        for (int i = 0; i < count && done; i++)
            done = bench_glint_frame(&glints[i], bench->gpu, &series[i]);
    const double first = bench_median(series[0].wall, series[0].count);
    for (int i = 0; i < count && done; i++)
        print_row(&settings[i], contestants[i].name, &series[i], first);
    for (int i = 0; i < count; i++)
        bench_glint_close(&glints[i]);
    return done;
}

static bool measure_alone(const struct bench *bench, const struct bench_scene *scene) {
    static const struct contestant small[] = {
        {"glint, kernel made for the scene", WIDTH, HEIGHT, 1, false, false, false},
        {"glint, kernel for everything", WIDTH, HEIGHT, 1, true, false, false},
        {"glint, counting rays (--count-rays)", WIDTH, HEIGHT, 1, false, false, true},
    };
    static const struct contestant large[] = {
        {"glint, kernel made for the scene", 2 * WIDTH, 2 * HEIGHT, 1, false, false, false},
        {"glint, kernel for everything", 2 * WIDTH, 2 * HEIGHT, 1, true, false, false},
        {"glint, counting rays (--count-rays)", 2 * WIDTH, 2 * HEIGHT, 1, false, false, true},
        {"glint, double precision", 2 * WIDTH, 2 * HEIGHT, 1, false, true, false},
    };
    static const struct contestant samples[] = {
        {"glint, 1 sample", WIDTH, HEIGHT, 1, false, false, false},
        {"glint, 4 samples", WIDTH, HEIGHT, 4, false, false, false},
        {"glint, 16 samples", WIDTH, HEIGHT, 16, false, false, false},
    };
    const int has_double = gpu_info(bench->gpu)->has_double;
    print_head(scene->path);
    return measure_group(bench, scene, small, 3) && measure_group(bench, scene, large, 3 + has_double) &&
           measure_group(bench, scene, samples, 3);
}

// ---- scenes

static bool measure_original_scene(const struct bench *bench) {
    struct bench_scene scene = {0};
    if (!bench->assets || !bench_is_folder(bench->assets)) {
        printf("\nskipped: %s: %s%s\n", ORIGINAL_SCENE, bench->assets ? "no folder " : "",
               bench->assets ? bench->assets : "name the folder of its meshes with --assets or GLINT_ASSETS");
        return true;
    }
    const bool done = bench_scene_open(&scene, ORIGINAL_SCENE, bench->assets) &&
                      measure_duel(bench, &scene) && measure_alone(bench, &scene);
    bench_scene_close(&scene);
    return done;
}

static bool measure_scene(const struct bench *bench, const char *path) {
    struct bench_scene scene = {0};
    const bool done = bench_scene_open(&scene, path, NULL) && measure_alone(bench, &scene);
    bench_scene_close(&scene);
    return done;
}

static bool read_options(int argc, char **argv, struct bench *bench, const char **device) {
    static const struct option table[] = {
        {"assets", 1, NULL, 'a'}, {"device", 1, NULL, 'd'}, {"rounds", 1, NULL, 'r'}, {NULL, 0, NULL, 0}};
    *bench = (struct bench){.assets = getenv("GLINT_ASSETS"), .rounds = ROUNDS};
    for (int letter; (letter = getopt_long(argc, argv, "", table, NULL)) != -1;) {
        int64_t rounds = ROUNDS;
        if (letter == 'a')
            bench->assets = optarg;
        else if (letter == 'd')
            *device = optarg;
        else if (letter != 'r' || number_parse_integer(str_from(optarg), &rounds) != NUMBER_OK ||
                 rounds < 1 || rounds > ROUNDS_MOST)
            return false;
        bench->rounds = letter == 'r' ? (uint32_t)rounds : bench->rounds;
    }
    return true;
}

int main(int argc, char **argv) {
    struct bench bench;
    const char *device = NULL;
    if (!read_options(argc, argv, &bench, &device)) {
        fputs("usage: bench_frames [--assets DIR] [--rounds N] [--device NAME|N] [SCENE]...\n", stderr);
        return 2;
    }
    bench.gpu = bench_gpu(device);
    if (!bench.gpu)
        return 1;
    bench_print_machine(bench.gpu);
    bool done = measure_original_scene(&bench);
    for (int i = optind; i < argc && done; i++)
        done = measure_scene(&bench, argv[i]);
    gpu_destroy(bench.gpu);
    return done ? 0 : 1;
}
