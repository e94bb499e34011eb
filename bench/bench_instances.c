// Models that share a mesh, as copies of its triangles and as instances of one tree: what each costs.
//
//     bench_instances [--rounds N] [--size WxH] [--set PATH=VALUE]... [--assets DIR] [--device NAME|N]
//     [--save STEM] SCENE...
//
// Both are made in one process, whatever is cheaper, and take turns. Printed: seconds of flattening, of all
// threads; bytes of the scene on the device; nodes and items tested per ray; processor time of a frame, the
// least of the rounds; and how many pixels of the two pictures differ in a bit. --save writes both pictures,
// to STEM.copies.pfm and STEM.instances.pfm. Precision is the scene's setting; `auto` is single.
#include "bench/clocks.h"
#include "bench/kit.h"
#include "core/number.h"
#include "grammar/ir.h"
#include "load/session_precision.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROUNDS = 3,
    SETS_MOST = 16,
    WAYS = 2,
};

static const enum flat_sharing sharings[WAYS] = {FLAT_COPIES, FLAT_SHARED};
static const char *const names[WAYS] = {"copies", "instances"};

struct bench {
    struct gpu *gpu;
    const char *assets, *stem;
    str sets[SETS_MOST];
    uint32_t set_count, rounds;
    int32_t width, height;
};

struct way {
    struct flat_scene flat;
    struct bench_glint glint;
    struct bench_series times;
    struct render_rays rays;
    double flatten_seconds;
};

static bool open_way(const struct bench *bench, struct bench_scene *scene, enum flat_sharing sharing,
                     struct way *way) {
    struct flat_input input = precision_input(&scene->session, &scene->view);
    input.is_double = scene->session.scene->trace.precision == IR_PRECISION_DOUBLE;
    input.sharing = sharing;
    const struct bench_clocks start = bench_clocks_now();
    if (!flatten(&input, &way->flat)) {
        fprintf(stderr, "%s: cannot be flattened\n", scene->path);
        return false;
    }
    way->flatten_seconds = bench_clocks_since(start).processor;
    struct render_settings settings = render_settings_of(&scene->session.resolved, &way->flat, input.limits);
    settings.width = (uint32_t)scene->session.image->width;
    settings.height = (uint32_t)scene->session.image->height;
    settings.samples = 1;
    way->glint.scene = scene;
    way->glint.renderer = renderer_create(bench->gpu, &way->flat, &settings);
    if (!way->glint.renderer || !image_init(&way->glint.image, settings.width, settings.height))
        return bench_device_failed(bench->gpu);
    return renderer_count(way->glint.renderer, &scene->view.camera, NULL, &way->rays) == RENDER_DONE ||
           bench_device_failed(bench->gpu);
}

static bool take_turns(const struct bench *bench, struct way *ways) {
    for (int i = 0; i < WAYS; i++)
        if (!bench_glint_frame(&ways[i].glint, bench->gpu, NULL))
            return false;
    for (uint32_t round = 0; round < bench->rounds; round++)
        for (int i = 0; i < WAYS; i++)
            if (!bench_glint_frame(&ways[i].glint, bench->gpu, &ways[i].times))
                return false;
    return true;
}

static void print_way(const struct way *way, const char *name, double against) {
    const struct render_rays *rays = &way->rays;
    const double count = (double)(rays->primary + rays->reflected + rays->refracted + rays->shadow);
    const double frame = bench_least(way->times.processor, way->times.count);
    printf("%-10s %10u %9.1f %9.2f %9.2f %9.2f %9.3f %7.2f\n", name, way->flat.triangle_count,
           (double)renderer_scene_bytes(way->glint.renderer) / (1 << 20), way->flatten_seconds,
           (double)rays->nodes / count, (double)rays->items / count, frame, frame / against);
}

static uint32_t differing(const struct image *a, const struct image *b) {
    uint32_t count = 0;
    for (size_t i = 0; i < (size_t)a->width * a->height; i++)
        count += memcmp(a->rgb + 3 * i, b->rgb + 3 * i, 3 * sizeof *a->rgb) != 0;
    return count;
}

static void print_ways(const struct bench_scene *scene, const struct way *ways) {
    const double against = bench_least(ways[0].times.processor, ways[0].times.count);
    printf("%s, %llu triangles shown, %ux%u\n", scene->path, (unsigned long long)ways[0].flat.shown_triangles,
           ways[0].glint.image.width, ways[0].glint.image.height);
    printf("%-10s %10s %9s %9s %9s %9s %9s %7s\n", "", "triangles", "MiB", "flatten s", "nodes/ray",
           "items/ray", "frame s", "times");
    for (int i = 0; i < WAYS; i++)
        print_way(&ways[i], names[i], against);
    printf("%u pixels differ\n\n", differing(&ways[0].glint.image, &ways[1].glint.image));
    fflush(stdout);
}

static bool save(const struct bench *bench, const struct way *ways) {
    for (int i = 0; i < WAYS && bench->stem; i++) {
        char path[1024];
        struct strbuf bytes;
        strbuf_init(&bytes);
        snprintf(path, sizeof path, "%s.%s.pfm", bench->stem, names[i]);
        image_encode(&ways[i].glint.image, IMAGE_PFM, (struct image_display){0}, &bytes);
        FILE *file = fopen(path, "wb");
        const bool done = file && fwrite(bytes.data, 1, bytes.len, file) == bytes.len;
        strbuf_finish(&bytes);
        if (!(file && fclose(file) == 0 && done)) {
            fprintf(stderr, "%s: cannot be written\n", path);
            return false;
        }
    }
    return true;
}

static bool open_scene(const struct bench *bench, const char *path, struct bench_scene *scene) {
    const str folder = str_from(bench->assets ? bench->assets : "");
    const struct session_options options = {.path = str_from(path),
                                            .asset_paths = &folder,
                                            .asset_path_count = bench->assets != NULL,
                                            .sets = bench->sets,
                                            .set_count = bench->set_count,
                                            .limits = limits_default(),
                                            .width = bench->width,
                                            .height = bench->height};
    *scene = (struct bench_scene){.path = path, .store = asset_store_create()};
    return scene->store && bench_session_open(scene, &options);
}

static bool measure(const struct bench *bench, const char *path) {
    static struct way ways[WAYS];
    struct bench_scene scene;
    bool done = open_scene(bench, path, &scene);
    memset(ways, 0, sizeof ways);
    for (int i = 0; i < WAYS && done; i++)
        done = open_way(bench, &scene, sharings[i], &ways[i]);
    done = done && take_turns(bench, ways);
    if (done)
        print_ways(&scene, ways);
    done = done && save(bench, ways);
    for (int i = 0; i < WAYS; i++) {
        bench_glint_close(&ways[i].glint);
        flat_finish(&ways[i].flat);
    }
    bench_scene_close(&scene);
    return done;
}

static bool read_option(struct bench *bench, int letter, const char **device) {
    int64_t number;
    if (letter == 'a')
        bench->assets = optarg;
    else if (letter == 'd')
        *device = optarg;
    else if (letter == 'o')
        bench->stem = optarg;
    else if (letter == 's' && bench->set_count < SETS_MOST)
        bench->sets[bench->set_count++] = str_from(optarg);
    else if (letter == 'z')
        return sscanf(optarg, "%dx%d", &bench->width, &bench->height) == 2;
    else if (letter == 'r' && number_parse_integer(str_from(optarg), &number) == NUMBER_OK && number > 0 &&
             number <= BENCH_SAMPLES_MOST)
        bench->rounds = (uint32_t)number;
    else
        return false;
    return true;
}

static bool read_options(int argc, char **argv, struct bench *bench, const char **device) {
    static const struct option table[] = {
        {"assets", 1, NULL, 'a'}, {"device", 1, NULL, 'd'}, {"rounds", 1, NULL, 'r'}, {"save", 1, NULL, 'o'},
        {"set", 1, NULL, 's'},    {"size", 1, NULL, 'z'},   {NULL, 0, NULL, 0}};
    *bench = (struct bench){.assets = getenv("GLINT_ASSETS"), .rounds = ROUNDS};
    for (int letter; (letter = getopt_long(argc, argv, "", table, NULL)) != -1;)
        if (!read_option(bench, letter, device))
            return false;
    return optind < argc;
}

int main(int argc, char **argv) {
    struct bench bench;
    const char *device = NULL;
    if (!read_options(argc, argv, &bench, &device)) {
        fputs("usage: bench_instances [--rounds N] [--size WxH] [--set PATH=VALUE]... [--assets DIR] "
              "[--device NAME|N] "
              "[--save STEM] SCENE...\n",
              stderr);
        return 2;
    }
    bench.gpu = bench_gpu(device);
    bool done = bench.gpu != NULL;
    for (int i = optind; i < argc && done; i++)
        done = measure(&bench, argv[i]);
    gpu_destroy(bench.gpu);
    return done ? 0 : 1;
}
