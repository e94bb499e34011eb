#include "bench/kit.h"

#include "core/clock.h"
#include "diag/diag_text.h"
#include "load/session_precision.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum {
    WARM_FRAMES = 3
};

static const double WARM_SECONDS = 0.1;

bool bench_is_folder(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

static bool report(struct session *session) {
    struct strbuf text;
    strbuf_init(&text);
    diag_text(&text, &session->sink, &session->sources, (struct diag_text_options){.most = 10});
    fwrite(text.data ? text.data : "", 1, text.len, stderr);
    strbuf_finish(&text);
    return false;
}

bool bench_session_open(struct bench_scene *scene, const struct session_options *options) {
    struct session *session = &scene->session;
    session_load(session, options, scene->store);
    if (session->state != SESSION_LOADED || session->sink.errors || !session_view(session, 0, &scene->view))
        return report(session);
    return true;
}

bool bench_scene_open(struct bench_scene *scene, const char *path, const char *assets) {
    str folder = str_from(assets ? assets : "");
    struct session_options options = {.path = str_from(path),
                                      .asset_paths = &folder,
                                      .asset_path_count = assets != NULL,
                                      .limits = limits_default()};
    *scene = (struct bench_scene){.path = path, .store = asset_store_create()};
    if (!scene->store) {
        fprintf(stderr, "%s: not enough memory\n", path);
        return false;
    }
    struct session *session = &scene->session;
    if (!bench_session_open(scene, &options))
        return false;
    struct flat_input input = precision_input(session, &scene->view);
    if (!flatten(&input, &scene->flat))
        return report(session);
    input.is_double = true;
    if (!flatten(&input, &scene->flat_double))
        return report(session);
    scene->settings = render_settings_of(&session->resolved, &scene->flat, &session->options.limits);
    return true;
}

void bench_scene_close(struct bench_scene *scene) {
    if (!scene->store)
        return;
    flat_finish(&scene->flat);
    flat_finish(&scene->flat_double);
    session_finish(&scene->session);
    asset_store_destroy(scene->store);
    *scene = (struct bench_scene){0};
}

struct gpu *bench_gpu(const char *device) {
    char error[GPU_ERROR_BYTES] = "";
    struct gpu *gpu = NULL;
    struct gpu_options options = {.device = device ? device : getenv("GLINT_DEVICE")};
    if (gpu_create(&options, &gpu, error) != GPU_OK)
        fprintf(stderr, "%s\n", error);
    return gpu;
}

void bench_print_machine(const struct gpu *gpu) {
    printf("%s, %ld processors; times in ms\n", gpu_info(gpu)->name, sysconf(_SC_NPROCESSORS_ONLN));
}

bool bench_device_failed(const struct gpu *gpu) {
    fprintf(stderr, "%s\n", *gpu_error(gpu) ? gpu_error(gpu) : "not enough memory");
    return false;
}

void bench_add(struct bench_series *series, struct bench_clocks start, double device) {
    const struct bench_clocks taken = bench_clocks_since(start);
    if (series->count == BENCH_SAMPLES_MOST)
        return;
    series->wall[series->count] = taken.wall;
    series->processor[series->count] = taken.processor;
    series->device[series->count++] = device;
}

bool bench_glint_open(struct bench_glint *glint, struct gpu *gpu, const struct bench_scene *scene,
                      const struct render_settings *settings, bool is_double) {
    *glint = (struct bench_glint){.scene = scene};
    glint->renderer = renderer_create(gpu, is_double ? &scene->flat_double : &scene->flat, settings);
    if (!glint->renderer || !image_init(&glint->image, settings->width, settings->height))
        return bench_device_failed(gpu);
    return true;
}

void bench_glint_close(struct bench_glint *glint) {
    renderer_destroy(glint->renderer);
    image_finish(&glint->image);
    *glint = (struct bench_glint){0};
}

bool bench_glint_frame(struct bench_glint *glint, struct gpu *gpu, struct bench_series *series) {
    struct render_statistics statistics;
    const struct bench_clocks start = bench_clocks_now();
    if (renderer_render(glint->renderer, &glint->scene->view.camera, glint->image.rgb, NULL, &statistics) !=
        RENDER_DONE)
        return bench_device_failed(gpu);
    if (series)
        bench_add(series, start, statistics.device_seconds);
    return true;
}

bool bench_glint_warm(struct bench_glint *glint, struct gpu *gpu) {
    const double start = clock_seconds();
    for (int i = 0; i < WARM_FRAMES || clock_seconds() - start < WARM_SECONDS; i++)
        if (!bench_glint_frame(glint, gpu, NULL))
            return false;
    return true;
}

uint32_t bench_differing(const struct image *a, const struct image *b, struct image_display display,
                         int steps) {
    const size_t pixels = (size_t)a->width * a->height;
    uint8_t *bytes = malloc(2 * 3 * pixels);
    uint32_t differing = 0;
    if (!bytes)
        return UINT32_MAX;
    image_to_bytes(a, display, bytes);
    image_to_bytes(b, display, bytes + 3 * pixels);
    for (size_t i = 0; i < pixels; i++) {
        int most = 0;
        for (size_t k = 3 * i; k < 3 * i + 3; k++) {
            const int gap = abs(bytes[k] - bytes[3 * pixels + k]);
            most = gap > most ? gap : most;
        }
        differing += most > steps;
    }
    free(bytes);
    return differing;
}
