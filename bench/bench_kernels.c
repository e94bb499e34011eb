// What the device's driver says of the kernels that it compiles for scenes: registers, private memory, size
// of the code.
//
//     bench_kernels [--assets DIR] [--device NAME|N] SCENE...
//
// For each scene the tracing kernel in single and in double precision, and what makes a picture of its
// samples. Drivers name their figures themselves (VK_KHR_pipeline_executable_properties).
#include "bench/kit.h"
#include "tracer/render/render_private.h"

#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static void print_figure(void *context, const char *name, double value) {
    (void)context;
    printf("    %-32s %12.0f\n", name, value);
}

static bool print_program(struct gpu *gpu, const struct gpu_program *program, const char *what) {
    printf("  %s\n", what);
    if (gpu_program_tell(gpu, program, print_figure, NULL))
        return true;
    fprintf(stderr, "%s: the driver says nothing about its kernels\n", gpu_info(gpu)->name);
    return false;
}

static bool print_kernels(struct gpu *gpu, const struct bench_scene *scene, bool is_double) {
    struct bench_glint glint;
    bool done = bench_glint_open(&glint, gpu, scene, &scene->settings, is_double);
    if (done) {
        printf("%s, %s precision, features %#" PRIx64 "\n", scene->path, is_double ? "double" : "single",
               glint.renderer->features);
        done = print_program(gpu, glint.renderer->program, "trace") &&
               (!glint.renderer->resolve || print_program(gpu, glint.renderer->resolve, "resolve"));
    }
    bench_glint_close(&glint);
    return done;
}

static bool print_scene(struct gpu *gpu, const char *path, const char *assets) {
    struct bench_scene scene = {0};
    const bool done = bench_scene_open(&scene, path, assets) && print_kernels(gpu, &scene, false) &&
                      (!gpu_info(gpu)->has_double || print_kernels(gpu, &scene, true));
    bench_scene_close(&scene);
    return done;
}

int main(int argc, char **argv) {
    static const struct option table[] = {
        {"assets", 1, NULL, 'a'}, {"device", 1, NULL, 'd'}, {NULL, 0, NULL, 0}};
    const char *assets = getenv("GLINT_ASSETS");
    struct gpu_options options = {.device = getenv("GLINT_DEVICE"), .tells = true};
    bool fits = true;
    for (int letter; (letter = getopt_long(argc, argv, "", table, NULL)) != -1;) {
        assets = letter == 'a' ? optarg : assets;
        options.device = letter == 'd' ? optarg : options.device;
        fits = fits && letter != '?';
    }
    if (!fits || optind == argc) {
        fputs("usage: bench_kernels [--assets DIR] [--device NAME|N] SCENE...\n", stderr);
        return 2;
    }
    char error[GPU_ERROR_BYTES];
    struct gpu *gpu = NULL;
    if (gpu_create(&options, &gpu, error) != GPU_OK) {
        fprintf(stderr, "%s\n", error);
        return 1;
    }
    printf("%s\n", gpu_info(gpu)->name);
    bool done = true;
    for (int i = optind; i < argc && done; i++)
        done = print_scene(gpu, argv[i], assets);
    gpu_destroy(gpu);
    return done ? 0 : 1;
}
