// Random scenes, drawn until their pixels' errors end them, against many more samples: how many pictures err
// by more than what they state as their most.
//
// Usage: test_random [--seed S] [--first N] [--count N] [--truth SAMPLES] [--size WxH] [--error E]
//   [--samples MOST] [--max-broken N] [--family NAME]
// A line a scene, which are number FIRST and the COUNT - 1 that follow of those that the seed makes
// (measure/sweep): the root of the mean square that the picture is off, what it states of it, and its
// samples. A long run is cut into several by --first. The exit status is 1 if more than --max-broken pictures
// err by more than they state as their most.
#include "core/number.h"
#include "files/files.h"
#include "grammar/ir.h"
#include "load/session_precision.h"
#include "scene/view.h"
#include "tests/pictures/picture_kit.h"
#include "tests/sweep/sweep.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Those whose pictures have edges, highlights, mirrors, soft shadows and what else takes samples.
static const enum sweep_family families[] = {
    SWEEP_STILL,  SWEEP_MIRROR_BALLS, SWEEP_MANY_LIGHTS, SWEEP_HIGHLIGHTS, SWEEP_LENS,   SWEEP_TOUCHING,
    SWEEP_ROUGH,  SWEEP_LAMPS,        SWEEP_OCCLUDED,    SWEEP_BALL_CHAIN, SWEEP_IMAGES, SWEEP_GEM,
    SWEEP_SPARKS, SWEEP_SMOOTH,       SWEEP_BALL_FIELD,  SWEEP_MIX,
};
enum {
    FAMILIES = sizeof families / sizeof *families
};

struct run {
    int64_t seed, first, count, truth, width, height, samples, max_broken;
    double error;
    const char *family; // the only one; NULL: all take turns
    struct picture_kit kit;
    uint32_t broken, failed;
    double samples_mean; // of all pictures
};

// A scene as a session, and as it is drawn.
struct taken {
    struct sweep_scene made;
    struct session session;
    struct arena arena; // of the overlays
    struct file_overlay overlays[SWEEP_MESHES + 1];
    struct view view;
    struct flat_scene flat;
    struct image_display display;
    float *shown[2]; // own, truth
    double mean, most, samples;
};

static void add_overlay(struct taken *t, uint32_t at, const char *name, const struct strbuf *text) {
    t->overlays[at] =
        (struct file_overlay){path_join(&t->arena, STR("/"), str_from(name)), strbuf_view(text)};
}

static bool load(struct taken *t, const struct run *run) {
    add_overlay(t, 0, t->made.name, &t->made.text);
    for (uint32_t i = 0; i < t->made.mesh_count; i++)
        add_overlay(t, i + 1, t->made.meshes[i].name, &t->made.meshes[i].text);
    const struct session_options options = {.path = t->overlays[0].path,
                                            .overlays = t->overlays,
                                            .overlay_count = t->made.mesh_count + 1,
                                            .limits = limits_default(),
                                            .width = (int32_t)run->width,
                                            .height = (int32_t)run->height};
    return session_load(&t->session, &options, run->kit.store) == SESSION_LOADED && !t->session.sink.errors &&
           session_view(&t->session, 0, &t->view);
}

static void show(const void *context, const float *linear, size_t pixels, float *shown) {
    const struct image_display *display = context;
    image_to_displayed(linear, pixels, *display, shown);
}

static bool draw(struct taken *t, const struct run *run, bool is_truth) {
    struct render_settings settings =
        render_settings_of(&t->session.resolved, &t->flat, &t->session.options.limits);
    const size_t pixels = (size_t)run->width * (size_t)run->height;
    settings.width = (uint32_t)run->width;
    settings.height = (uint32_t)run->height;
    settings.samples = (uint32_t)(is_truth ? run->truth : run->samples);
    settings.first_sample = is_truth ? VIEW_OTHER_SAMPLES : 0;
    settings.error = is_truth ? 0 : run->error;
    settings.least_samples = 16;
    settings.show = show;
    settings.show_context = &t->display;
    struct render_statistics statistics;
    struct renderer *renderer = renderer_create(run->kit.gpu, &t->flat, &settings);
    const bool good = renderer && renderer_render(renderer, &t->view.camera, t->shown[is_truth], NULL,
                                                  &statistics) == RENDER_DONE;
    if (good && !is_truth) {
        t->mean = renderer_estimate(renderer)->mean;
        t->most = renderer_estimate(renderer)->most;
        t->samples = (double)statistics.all_samples / (double)pixels;
    }
    renderer_destroy(renderer);
    if (good)
        show(&t->display, t->shown[is_truth], pixels, t->shown[is_truth]);
    return good;
}

// Root of the mean square; *worst is that of the pixel that is most off.
static double off(const struct taken *t, size_t pixels, double *worst) {
    double sum = 0;
    *worst = 0;
    for (size_t i = 0; i < pixels; i++) {
        double square = 0;
        for (size_t k = 3 * i; k < 3 * i + 3; k++)
            square += pow((double)t->shown[0][k] - (double)t->shown[1][k], 2);
        sum += square;
        *worst = fmax(*worst, sqrt(square / 3));
    }
    return sqrt(sum / (3 * (double)pixels));
}

static bool take(struct taken *t, struct run *run) {
    const size_t pixels = (size_t)run->width * (size_t)run->height;
    bool good = load(t, run);
    struct flat_input input = {0};
    if (good)
        input = precision_input(&t->session, &t->view);
    good = good && flatten(&input, &t->flat);
    if (!good)
        return false;
    t->display = image_display_of(t->session.image);
    for (int i = 0; i < 2; i++)
        t->shown[i] = malloc(3 * pixels * sizeof(float));
    good = t->shown[0] && t->shown[1] && draw(t, run, false) && draw(t, run, true);
    if (good) {
        double worst;
        const double is = off(t, pixels, &worst);
        const bool kept = is <= t->most;
        run->broken += !kept;
        run->samples_mean += t->samples / (double)run->count;
        printf("%-28s %6.1f samples, off by %.5f, stated %.5f to %.5f, worst pixel %.3f%s\n", t->made.name,
               t->samples, is, t->mean, t->most, worst, kept ? "" : "  BROKEN");
        fflush(stdout);
    }
    return good;
}

static void take_scene(struct run *run, int64_t index) {
    struct taken t = {0};
    enum sweep_family family = families[index % FAMILIES];
    for (int i = 0; run->family && i < SWEEP_FAMILIES; i++)
        family = strcmp(run->family, sweep_families[i].name) == 0 ? (enum sweep_family)i : family;
    arena_init(&t.arena, SIZE_MAX);
    sweep_scene_make(&t.made, (uint64_t)run->seed, family,
                     (uint32_t)(run->family ? index : index / FAMILIES));
    if (!take(&t, run)) {
        printf("FAIL %s is not drawn\n", t.made.name);
        run->failed++;
    }
    free(t.shown[0]);
    free(t.shown[1]);
    flat_finish(&t.flat);
    session_finish(&t.session);
    sweep_scene_finish(&t.made);
    arena_finish(&t.arena);
}

static bool read_options(int argc, char **argv, struct run *run) {
    static const struct option longs[] = {
        {"seed", required_argument, NULL, 's'},    {"first", required_argument, NULL, 'f'},
        {"count", required_argument, NULL, 'c'},   {"truth", required_argument, NULL, 't'},
        {"size", required_argument, NULL, 'x'},    {"error", required_argument, NULL, 'e'},
        {"samples", required_argument, NULL, 'n'}, {"max-broken", required_argument, NULL, 'b'},
        {"family", required_argument, NULL, 'm'},  {NULL, 0, NULL, 0},
    };
    for (int option; (option = getopt_long(argc, argv, "", longs, NULL)) != -1;) {
        int64_t *const to = option == 's'   ? &run->seed
                            : option == 'f' ? &run->first
                            : option == 'c' ? &run->count
                            : option == 't' ? &run->truth
                            : option == 'n' ? &run->samples
                                            : &run->max_broken;
        if (option == '?')
            return false;
        if (option == 'm')
            run->family = optarg;
        else if (option == 'e')
            run->error = strtod(optarg, NULL);
        else if (option == 'x' && sscanf(optarg, "%ldx%ld", &run->width, &run->height) != 2)
            return false;
        else if (option != 'e' && option != 'm' && option != 'x' &&
                 number_parse_integer(str_from(optarg), to) != NUMBER_OK)
            return false;
    }
    return optind == argc && run->width > 0 && run->height > 0 && run->count > 0 && run->error > 0;
}

int main(int argc, char **argv) {
    struct run run = {
        .count = FAMILIES, .truth = 4096, .width = 48, .height = 36, .samples = 256, .error = 0.02};
    if (!read_options(argc, argv, &run))
        return 2;
    if (!picture_kit_open(&run.kit) || run.kit.by_reference)
        return 77;
    for (int64_t i = run.first; i < run.first + run.count; i++)
        take_scene(&run, i);
    printf("%lld of %lld pictures err by no more than they state as their most; %.1f samples\n",
           (long long)(run.count - run.broken - run.failed), (long long)run.count, run.samples_mean);
    const uint32_t messages = picture_kit_close(&run.kit);
    return run.failed || messages || run.broken > run.max_broken;
}
