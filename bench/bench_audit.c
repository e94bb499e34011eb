// The audit of a picture: what it says of pictures whose every pixel is known, and what it costs.
//
//     bench_audit [--random N] [--seed S] [--size WxH] [--rounds N] [--assets DIR] [--device NAME|N]
//     [SCENE]...
//
// First N scenes of `test_choices --count N --seed S` (default 442 of seed 1), each traced in single
// precision at WxH pixels (default 256x192): how many of those with more than 0.1 % of their pixels off are
// told of, how many of the others raise a false alarm, how many of these have no pixel off at all, and of how
// many what is said of the share is not true. Then each SCENE at 1024x1024 pixels: frames and
// audits in turn, and the audit's time as a part of the frame's.
#include "bench/kit.h"
#include "core/number.h"
#include "files/files.h"
#include "grammar/ir.h"
#include "load/session_precision.h"
#include "reference/reference.h"
#include "render/audit.h"
#include "shaders/features.h"
#include "tests/sweep/sweep.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SCENES = 442,
    WIDTH = 256,
    HEIGHT = 192,
    SIDE = 1024, // of the pictures whose audits are timed
    ROUNDS = 5,
    ROUNDS_MOST = 100,
};

struct bench {
    struct gpu *gpu;
    int64_t random, seed, rounds;
    uint32_t width, height;
    const char *assets; // a further folder for the files of scenes; NULL: none
};

// ---- random scenes

// A scene as a session, and its picture by the device.
struct taken {
    struct asset_store *store;
    struct session session;
    struct arena arena; // of the overlays
    struct file_overlay overlays[SWEEP_MESHES + 1];
    struct view view;
    struct image image;
};

static void add_overlay(struct taken *t, uint32_t at, const char *name, const struct strbuf *text) {
    t->overlays[at] =
        (struct file_overlay){path_join(&t->arena, STR("/"), str_from(name)), strbuf_view(text)};
}

static bool load(struct taken *t, const struct bench *bench, const struct sweep_scene *made) {
    static const str single = {"trace.precision=single", sizeof "trace.precision=single" - 1};
    arena_init(&t->arena, SIZE_MAX);
    add_overlay(t, 0, made->name, &made->text);
    for (uint32_t i = 0; i < made->mesh_count; i++)
        add_overlay(t, i + 1, made->meshes[i].name, &made->meshes[i].text);
    const struct session_options options = {.path = t->overlays[0].path,
                                            .overlays = t->overlays,
                                            .overlay_count = made->mesh_count + 1,
                                            .sets = &single,
                                            .set_count = 1,
                                            .limits = limits_default(),
                                            .width = (int32_t)bench->width,
                                            .height = (int32_t)bench->height,
                                            .samples = 1};
    t->store = asset_store_create();
    return t->store && session_load(&t->session, &options, t->store) == SESSION_LOADED &&
           !t->session.sink.errors && session_view(&t->session, 0, &t->view) &&
           image_init(&t->image, bench->width, bench->height);
}

// By the general kernel: compiling one for each scene would take longer than all else.
static bool draw(struct taken *t, const struct bench *bench) {
    struct flat_input input = precision_input(&t->session, &t->view);
    struct flat_scene flat;
    if (!flatten(&input, &flat))
        return false;
    struct render_settings settings =
        render_settings_of(&t->session.resolved, &flat, &t->session.options.limits);
    settings.width = bench->width;
    settings.height = bench->height;
    settings.samples = 1;
    settings.features |= FEATURE_GENERAL;
    struct render_statistics statistics;
    struct renderer *renderer = renderer_create(bench->gpu, &flat, &settings);
    const bool good = renderer && renderer_render(renderer, &t->view.camera, t->image.rgb, NULL,
                                                  &statistics) == RENDER_DONE;
    renderer_destroy(renderer);
    flat_finish(&flat);
    return good;
}

static void close_taken(struct taken *t) {
    image_finish(&t->image);
    session_finish(&t->session);
    asset_store_destroy(t->store);
    arena_finish(&t->arena);
}

// The share of the pixels that are off, all of them traced again; negative: no memory.
static double true_share(struct taken *t) {
    const struct reference_input input = {.scene = &t->session.resolved, .view = &t->view};
    const struct reference_settings settings =
        reference_settings_of(t->session.scene, t->session.image, &t->session.options.limits, true);
    const size_t pixels = (size_t)t->image.width * t->image.height;
    const struct image_display display = image_display_of(t->session.image);
    struct reference *reference = reference_create(&input);
    double *exact = malloc(3 * pixels * sizeof *exact);
    double share = -1;
    if (reference && exact && reference_render(reference, &settings, exact, NULL, NULL) == REFERENCE_DONE) {
        size_t off = 0;
        for (size_t i = 0; i < pixels; i++)
            off += audit_is_off(t->image.rgb + 3 * i, exact + 3 * i, display);
        share = (double)off / (double)pixels;
    }
    free(exact);
    reference_destroy(reference);
    return share;
}

struct tally {
    uint32_t told, alarms, maligned, below;
    uint64_t pixels; // traced again
    uint32_t most;   // of one picture
    double seconds;
};

enum {
    SAYS,    // --audit
    DECIDES, // --max-off 0.001
    WAYS
};
static const char *const way_names[WAYS] = {"--audit", "--max-off 0.001"};

struct tallies {
    uint32_t scenes, wrong, spotless;
    struct tally ways[WAYS];
};

static void count_way(struct tally *tally, const char *name, const char *way, double share,
                      const struct audit *audit) {
    const bool wrong = share > AUDIT_SHARE, told = audit->bound > AUDIT_SHARE;
    tally->told += wrong && told;
    tally->alarms += !wrong && told;
    tally->maligned += share == 0 && audit->off > 0;
    tally->below += audit->bound < share;
    tally->pixels += audit->pixels;
    tally->most = audit->pixels > tally->most ? audit->pixels : tally->most;
    tally->seconds += audit->seconds;
    if (told != wrong || audit->bound < share)
        printf("  %-28s %.3f %% off; %s: at most %.3f %%, %u of %u\n", name, 100 * share, way,
               100 * audit->bound, audit->off, audit->pixels);
}

static bool audit_scene(const struct bench *bench, const struct sweep_scene *made, struct tallies *tallies) {
    struct taken t = {0};
    bool good = load(&t, bench, made) && draw(&t, bench);
    const double share = good ? true_share(&t) : -1;
    good = share >= 0;
    for (int way = 0; way < WAYS && good; way++) {
        const struct audit_wish wish = {.share = AUDIT_SHARE, .decides = way == DECIDES};
        struct audit audit;
        good = audit_take(&t.session, &t.view, &t.image, &wish, NULL, &audit) == SHOT_OK;
        if (good)
            count_way(&tallies->ways[way], made->name, way_names[way], share, &audit);
    }
    tallies->scenes++;
    tallies->wrong += share > AUDIT_SHARE;
    tallies->spotless += share == 0;
    if (!good)
        fprintf(stderr, "%s: cannot be traced\n", made->name);
    close_taken(&t);
    return good;
}

static void print_tallies(const struct tallies *all) {
    printf("%u pictures: %u with more than 0.1 %% of their pixels off, %u without one\n", all->scenes,
           all->wrong, all->spotless);
    printf("%-16s %14s %13s %16s %13s %12s %9s %9s\n", "", "told of wrong", "false alarms", "of none off",
           "untrue", "pixels", "most", "ms");
    for (int way = 0; way < WAYS; way++) {
        const struct tally *t = &all->ways[way];
        printf("%-16s %6u %5.1f %% %13u %16u %13u %12.0f %9u %9.1f\n", way_names[way], t->told,
               all->wrong ? 100.0 * t->told / all->wrong : 100.0, t->alarms, t->maligned, t->below,
               (double)t->pixels / fmax(all->scenes, 1), t->most, 1e3 * t->seconds / fmax(all->scenes, 1));
    }
}

static bool audit_random(const struct bench *bench) {
    const struct sweep_input input = {.families = (UINT64_C(1) << SWEEP_FAMILIES) - 1};
    struct tallies tallies = {0};
    bool good = true;
    printf("\n%lld random scenes of seed %lld, in single precision, %u x %u\n", (long long)bench->random,
           (long long)bench->seed, bench->width, bench->height);
    for (uint32_t i = 0; i < bench->random && good; i++) {
        enum sweep_family family;
        uint32_t number;
        struct sweep_scene made;
        sweep_which(&input, i, &family, &number);
        sweep_scene_make(&made, (uint64_t)bench->seed, family, number);
        good = audit_scene(bench, &made, &tallies);
        sweep_scene_finish(&made);
        fflush(stdout);
    }
    print_tallies(&tallies);
    return good;
}

// ---- what it costs

static bool time_round(struct shot *shot, struct image *image, struct bench_series *frames,
                       struct bench_series *audits, struct audit *audit) {
    const struct audit_wish wish = {.reference = shot->reference, .share = AUDIT_SHARE};
    struct render_statistics statistics;
    struct bench_clocks start = bench_clocks_now();
    if (shot_take(shot, image, NULL, &statistics) != SHOT_OK)
        return false;
    bench_add(frames, start, statistics.device_seconds);
    start = bench_clocks_now();
    if (audit_take(shot->session, &shot->view, image, &wish, NULL, audit) != SHOT_OK)
        return false;
    bench_add(audits, start, 0);
    return true;
}

static void print_cost(const char *path, const struct bench_series *frames, const struct bench_series *audits,
                       const struct audit *audit) {
    const double frame = bench_median(frames->wall, frames->count);
    const double took = bench_median(audits->wall, audits->count);
    const double frame_cpu = bench_median(frames->processor, frames->count);
    const double took_cpu = bench_median(audits->processor, audits->count);
    printf("%-40s %9.1f %9.2f %7.2f %% %7.2f %% %7u %5u\n", path, 1e3 * frame, 1e3 * took, 100 * took / frame,
           100 * took_cpu / frame_cpu, audit->pixels, audit->off);
    fflush(stdout);
}

static bool time_scene(const struct bench *bench, const char *path) {
    const str folder = str_from(bench->assets ? bench->assets : "");
    const struct session_options options = {.path = str_from(path),
                                            .asset_paths = &folder,
                                            .asset_path_count = bench->assets != NULL,
                                            .limits = limits_default(),
                                            .width = SIDE,
                                            .height = SIDE};
    struct asset_store *store = asset_store_create();
    struct session session;
    struct shot shot = {0};
    struct image image = {0};
    struct audit audit;
    struct bench_series *series = calloc(2, sizeof *series);
    session_load(&session, &options, store);
    bool good =
        series && session.state == SESSION_LOADED && !session.sink.errors &&
        shot_open_for(&shot, &session, bench->gpu, 0, (struct shot_wish){.audits = true}) == SHOT_OK &&
        image_init(&image, SIDE, SIDE);
    // The first frame waits for its kernel.
    for (int64_t i = -1; i < bench->rounds && good; i++) {
        good = time_round(&shot, &image, &series[0], &series[1], &audit);
        if (i < 0)
            series[0].count = series[1].count = 0;
    }
    if (good)
        print_cost(path, &series[0], &series[1], &audit);
    else
        fprintf(stderr, "%s: cannot be rendered\n", path);
    free(series);
    image_finish(&image);
    shot_close(&shot);
    session_finish(&session);
    asset_store_destroy(store);
    return good;
}

// ---- the command line

static bool read_number(const char *text, int64_t least, int64_t most, int64_t *out) {
    return number_parse_integer(str_from(text), out) == NUMBER_OK && *out >= least && *out <= most;
}

static bool read_size(const char *text, struct bench *bench) {
    const size_t x = strcspn(text, "x");
    int64_t width, height;
    if (!text[x] || number_parse_integer((str){text, x}, &width) != NUMBER_OK ||
        !read_number(text + x + 1, 1, 4096, &height) || width < 1 || width > 4096)
        return false;
    bench->width = (uint32_t)width;
    bench->height = (uint32_t)height;
    return true;
}

static bool read_option(int option, struct bench *bench, const char **device) {
    switch (option) {
    case 'r':
        return read_number(optarg, 0, 1000000, &bench->random);
    case 's':
        return read_number(optarg, 0, INT64_MAX, &bench->seed);
    case 'x':
        return read_size(optarg, bench);
    case 'n':
        return read_number(optarg, 1, ROUNDS_MOST, &bench->rounds);
    case 'a':
        bench->assets = optarg;
        return true;
    case 'd':
        *device = optarg;
        return true;
    default:
        return false;
    }
}

int main(int argc, char **argv) {
    static const struct option longs[] = {
        {"random", required_argument, NULL, 'r'},
        {"seed", required_argument, NULL, 's'},
        {"size", required_argument, NULL, 'x'},
        {"rounds", required_argument, NULL, 'n'},
        {"device", required_argument, NULL, 'd'},
        {"assets", required_argument, NULL, 'a'},
        {NULL, 0, NULL, 0},
    };
    struct bench bench = {.assets = getenv("GLINT_ASSETS"),
                          .random = SCENES,
                          .seed = 1,
                          .rounds = ROUNDS,
                          .width = WIDTH,
                          .height = HEIGHT};
    const char *device = NULL;
    for (int option; (option = getopt_long(argc, argv, "", longs, NULL)) != -1;)
        if (!read_option(option, &bench, &device)) {
            fprintf(stderr, "usage: bench_audit [--random N] [--seed S] [--size WxH] [--rounds N] "
                            "[--assets DIR] [--device NAME|N] [SCENE]...\n");
            return 2;
        }
    bench.gpu = bench_gpu(device);
    if (!bench.gpu)
        return 1;
    bench_print_machine(bench.gpu);
    bool good = bench.random == 0 || audit_random(&bench);
    if (optind < argc)
        printf("\n%-40s %9s %9s %9s %9s %7s %5s\n", "1024x1024", "frame", "audit", "wall", "cpu", "pixels",
               "off");
    for (int i = optind; i < argc && good; i++)
        good = time_scene(&bench, argv[i]);
    gpu_destroy(bench.gpu);
    return good ? 0 : 1;
}
