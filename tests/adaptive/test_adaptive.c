// Pictures whose pixels end by their error: what they state of themselves, against the same picture with many
// more samples that it does not share; what they save; and that neither portions nor workgroups change them.
//
// Usage: test_adaptive errors|hold|unseen|cuts|cuts-storage SAMPLES SCENE...
//   errors: a line a scene, against SAMPLES samples   hold: the same in less time, without how many samples
//   all would need    unseen: of any scenes, only what a picture promises    cuts: portions, workgroups and
//   dispatches of other sizes, on a device that traces as GPUs do with -storage
#include "grammar/ir.h"
#include "load/session_precision.h"
#include "scene/view.h"
#include "tests/pictures/picture_kit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    WIDTH = 96,
    HEIGHT = 72,
    PIXELS = WIDTH * HEIGHT,
    SIDE = 8,
    TILES = PIXELS / (SIDE * SIDE),
    LEAST = 16,
    MOST = 256,
    UNIFORM = 9, // numbers of samples that all pixels have: 1, 2, 4 ... 256
};
static const double BOUND = 0.02;
// Of tiles, of all scenes and of each; least of samples that all pixels would need for those taken.
static const double INSIDE = 0.95, INSIDE_OF_SCENE = 0.9, SAVED = 2;
// What a picture states as its most is right for 95 of 100; few that are wrong are so by little.
static const double KEPT = 0.9, MUCH = 1.25;
// Displayed, 0..1: of the truth's own samples; and of the mean of a picture.
static const double ROUNDING = 1e-5, BIAS_MOST = 0.03 * BOUND;

struct study {
    struct picture_kit kit;
    struct session session;
    struct view view;
    struct flat_scene flat;
    struct image_display display;
    uint32_t truth_samples;
    bool cuts, is_quick, is_unseen;
    int failed;
    double samples, uniform; // of all scenes: taken, and those that all pixels would need
    uint32_t tiles, inside;  // of all scenes
    uint32_t pictures, kept; // that err no more than they state as their most
};

// Displayed, in 0..1.
typedef float (*picture)[3]; // PIXELS of them

static void show(const void *context, const float *linear, size_t pixels, float *shown) {
    const struct image_display *display = context;
    image_to_displayed(linear, pixels, *display, shown);
}

static struct render_settings settings_of(struct study *s) {
    struct render_settings settings =
        render_settings_of(&s->session.resolved, &s->flat, &s->session.options.limits);
    settings.width = WIDTH;
    settings.height = HEIGHT;
    settings.samples = MOST;
    settings.least_samples = LEAST;
    settings.show = show;
    settings.show_context = &s->display;
    return settings;
}

struct result {
    float shown[PIXELS][3];
    float error[PIXELS];
    uint32_t samples[PIXELS];
    double mean, most, samples_mean;
};

static bool draw(struct study *s, const struct render_settings *settings, struct result *out) {
    struct render_statistics statistics;
    const size_t pixels = (size_t)settings->width * settings->height; // at most PIXELS
    struct renderer *renderer = renderer_create(s->kit.gpu, &s->flat, settings);
    const bool good = renderer && renderer_render(renderer, &s->view.camera, &out->shown[0][0], NULL,
                                                  &statistics) == RENDER_DONE;
    if (good && settings->error > 0) {
        const struct render_estimate *estimate = renderer_estimate(renderer);
        memcpy(out->error, estimate->error, pixels * sizeof *out->error);
        memcpy(out->samples, estimate->samples, pixels * sizeof *out->samples);
        out->mean = estimate->mean;
        out->most = estimate->most;
    }
    out->samples_mean = good ? (double)statistics.all_samples / (double)pixels : 0;
    renderer_destroy(renderer);
    if (good)
        show(&s->display, &out->shown[0][0], pixels, &out->shown[0][0]);
    return good;
}

// Root of the mean square over a tile, or all.
static double off_in_tile(picture a, picture b, uint32_t tile) {
    const uint32_t left = tile % (WIDTH / SIDE) * SIDE, top = tile / (WIDTH / SIDE) * SIDE;
    double sum = 0;
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t at = (top + i / SIDE) * WIDTH + left + i % SIDE;
        for (int k = 0; k < 3; k++)
            sum += pow((double)a[at][k] - (double)b[at][k], 2);
    }
    return sqrt(sum / (3 * SIDE * SIDE));
}

static double off(picture a, picture b) {
    double sum = 0;
    for (uint32_t tile = 0; tile < TILES; tile++)
        sum += pow(off_in_tile(a, b, tile), 2);
    return sqrt(sum / TILES);
}

static double bias(picture a, picture b) {
    double sum = 0;
    for (uint32_t i = 0; i < PIXELS; i++)
        for (int k = 0; k < 3; k++)
            sum += (double)a[i][k] - (double)b[i][k];
    return sum / (3 * PIXELS);
}

static double stated_of_tile(const struct result *r, uint32_t tile) {
    const uint32_t left = tile % (WIDTH / SIDE) * SIDE, top = tile / (WIDTH / SIDE) * SIDE;
    double sum = 0;
    for (uint32_t i = 0; i < SIDE * SIDE; i++)
        sum += pow((double)r->error[(top + i / SIDE) * WIDTH + left + i % SIDE], 2);
    return sqrt(sum / (SIDE * SIDE));
}

static void expect(struct study *s, bool good, const char *path, const char *what) {
    if (!good)
        printf("FAIL %s %s\n", path, what);
    s->failed += !good;
}

// The error where all pixels have so many samples.
static double off_with(struct study *s, uint32_t samples, picture truth) {
    static struct result uniform;
    struct render_settings settings = settings_of(s);
    settings.samples = samples;
    return draw(s, &settings, &uniform) ? off(uniform.shown, truth) : 0;
}

// How many samples all pixels would need for the error `is`, between powers of two; 0: more than the most
// tried.
static double uniform_samples(struct study *s, picture truth, double is) {
    double before = 0;
    for (uint32_t k = 0; k < UNIFORM; k++) {
        const double now = off_with(s, 1u << k, truth);
        if (now <= is)
            return k ? exp2(k - 1 + log(before / is) / log(before / now)) : 1;
        before = now;
    }
    return 0;
}

static uint32_t tiles_inside(const struct result *own, const struct result *truth) {
    uint32_t inside = 0;
    for (uint32_t tile = 0; tile < TILES; tile++)
        inside += off_in_tile((picture)own->shown, (picture)truth->shown, tile) <=
                  stated_of_tile(own, tile) + ROUNDING;
    return inside;
}

static void compare(struct study *s, const char *path) {
    static struct result truth, own;
    struct render_settings settings = settings_of(s);
    settings.samples = s->truth_samples;
    settings.first_sample = VIEW_OTHER_SAMPLES;
    bool good = draw(s, &settings, &truth);
    settings = settings_of(s);
    settings.error = BOUND;
    good = good && draw(s, &settings, &own);
    expect(s, good, path, "is drawn");
    if (!good)
        return;
    const uint32_t inside = tiles_inside(&own, &truth);
    const double is = off(own.shown, truth.shown), unfair = bias(own.shown, truth.shown);
    const double needed = s->is_quick ? 0 : uniform_samples(s, truth.shown, is);
    s->inside += inside;
    s->tiles += TILES;
    s->samples += own.samples_mean;
    // More than the most that was tried counts as that.
    s->uniform += needed > 0 ? needed : 1 << (UNIFORM - 1);
    printf("%-44s %6.1f samples, error %.5f, stated %.5f to %.5f, tiles inside %5.1f %%, bias %+.6f", path,
           own.samples_mean, is, own.mean, own.most, 100.0 * inside / TILES, unfair);
    if (!s->is_quick)
        printf(", all alike %s%.0f", needed > 0 ? "" : "> ", needed > 0 ? needed : 1 << (UNIFORM - 1));
    putchar('\n');
    fflush(stdout);
    s->pictures++;
    s->kept += is <= own.most;
    expect(s, is <= MUCH * own.most, path, "errs not much more than it states");
    expect(s, inside >= INSIDE_OF_SCENE * TILES, path, "has its tiles inside what they state");
    if (s->is_unseen)
        return;
    if (s->is_quick)
        expect(s, off_with(s, (uint32_t)(SAVED * own.samples_mean), truth.shown) > is, path,
               "takes far fewer samples");
    expect(s, fabs(unfair) <= BIAS_MOST, path, "is neither darker nor brighter");
}

// What one frame is cut into changes no byte.
static void compare_cuts(struct study *s, const char *path) {
    static struct result whole, cut;
    struct render_settings settings = settings_of(s);
    settings.error = BOUND;
    settings.samples = 64;
    // Small, but of tiles in lines and columns that portions and dispatches cut.
    settings.width = 5 * SIDE;
    settings.height = 4 * SIDE + SIDE / 2;
    bool good = draw(s, &settings, &whole);
    for (uint32_t i = 0; good && i < 3; i++) {
        struct render_settings other = settings;
        other.workgroup = i == 0 ? 8 : 0;
        other.portion_tiles = i == 1 ? 5 : 0;
        other.dispatch_paths = i == 2 ? 256 : 0;
        good = draw(s, &other, &cut);
        expect(s, good && memcmp(&whole, &cut, sizeof whole) == 0, path,
               i == 0   ? "is the same in other workgroups"
               : i == 1 ? "is the same in portions"
                        : "is the same in dispatches");
    }
    expect(s, good, path, "is drawn");
}

static void study_scene(struct study *s, const char *path) {
    const struct session_options options = {
        .path = str_from(path), .limits = limits_default(), .width = WIDTH, .height = HEIGHT};
    session_load(&s->session, &options, s->kit.store);
    const bool loaded = s->session.state == SESSION_LOADED && s->session.sink.errors == 0 &&
                        session_view(&s->session, 0, &s->view);
    expect(s, loaded, path, "is loaded");
    if (loaded) {
        struct flat_input input = precision_input(&s->session, &s->view);
        s->display = image_display_of(s->session.image);
        const bool flat = flatten(&input, &s->flat);
        expect(s, flat, path, "is flattened");
        if (flat)
            (s->cuts ? compare_cuts : compare)(s, path);
        flat_finish(&s->flat);
    }
    session_finish(&s->session);
}

int main(int argc, char **argv) {
    struct study s = {0};
    if (argc < 4)
        return 2;
    const bool as_gpu = strcmp(argv[1], "cuts-storage") == 0;
    s.is_unseen = strcmp(argv[1], "unseen") == 0;
    s.is_quick = s.is_unseen || strcmp(argv[1], "hold") == 0;
    s.cuts = as_gpu || strcmp(argv[1], "cuts") == 0;
    s.truth_samples = (uint32_t)strtoul(argv[2], NULL, 10);
    if (!(as_gpu ? picture_kit_open_as_gpu(&s.kit) : picture_kit_open(&s.kit)) || s.kit.by_reference)
        return 77;
    for (int i = 3; i < argc; i++)
        study_scene(&s, argv[i]);
    if (!s.cuts) {
        printf("tiles inside %.2f %%, pictures %u of %u", 100.0 * s.inside / s.tiles, (unsigned)s.kept,
               (unsigned)s.pictures);
        if (!s.is_quick)
            printf(", samples saved %.2f times", s.uniform / s.samples);
        putchar('\n');
        expect(&s, s.inside >= INSIDE * s.tiles, "all", "have their tiles inside what they state");
        expect(&s, s.kept >= KEPT * s.pictures, "all", "err no more than they state");
    }
    const uint32_t messages = picture_kit_close(&s.kit);
    return s.failed || messages;
}
