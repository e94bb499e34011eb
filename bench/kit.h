// What the benches share: a scene ready to be rendered, series of times, pictures compared.
//
// Errors: the bench_ functions that may fail print one line, or the scene's diagnostics, to standard error
// and give false. Ownership: *_close and *_finish take what was never opened, if zeroed. Thread safety: the
// gpu's thread.
#ifndef GLINT_BENCH_KIT_H
#define GLINT_BENCH_KIT_H

#include "bench/clocks.h"
#include "load/session.h"
#include "picture/write/image.h"
#include "tracer/render/render.h"

struct bench_scene {
    const char *path;
    struct asset_store *store;
    struct session session;
    struct view view;                    // through the first camera
    struct flat_scene flat, flat_double; // single and double precision
    struct render_settings settings;     // as the scene says
};

// `assets`: a further folder for the scene's files; may be NULL.
bool bench_scene_open(struct bench_scene *scene, const char *path, const char *assets);
// Loads scene->path into its store, which is there, and looks through the first camera; nothing is flattened.
bool bench_session_open(struct bench_scene *scene, const struct session_options *options);
void bench_scene_close(struct bench_scene *scene);
bool bench_is_folder(const char *path);
// NULL: the environment's GLINT_DEVICE, else the preferred one.
struct gpu *bench_gpu(const char *device);
// One line about the device and the processors of this machine.
void bench_print_machine(const struct gpu *gpu);
// Says what failed last on the device; always false.
bool bench_device_failed(const struct gpu *gpu);

// Seconds of the frames of one contestant; further ones than fit are left out.
struct bench_series {
    uint32_t count;
    double wall[BENCH_SAMPLES_MOST];
    double device[BENCH_SAMPLES_MOST];    // on the device's own clock
    double processor[BENCH_SAMPLES_MOST]; // of all threads of this process: a CPU device works in them
};

// Adds the frame that began there and ends now; `device`: its seconds on the device's own clock.
void bench_add(struct bench_series *series, struct bench_clocks start, double device);

// A renderer of glint, and its last picture.
struct bench_glint {
    struct renderer *renderer;
    const struct bench_scene *scene;
    struct image image;
};

bool bench_glint_open(struct bench_glint *glint, struct gpu *gpu, const struct bench_scene *scene,
                      const struct render_settings *settings, bool is_double);
void bench_glint_close(struct bench_glint *glint);
// One frame; `series` may be NULL.
bool bench_glint_frame(struct bench_glint *glint, struct gpu *gpu, struct bench_series *series);
// Frames that nobody counts, until compilers, caches and clocks have settled.
bool bench_glint_warm(struct bench_glint *glint, struct gpu *gpu);

// Pixels with a channel that differs by more than `steps` of 255, as displayed. UINT32_MAX: no memory.
uint32_t bench_differing(const struct image *a, const struct image *b, struct image_display display,
                         int steps);

#endif
