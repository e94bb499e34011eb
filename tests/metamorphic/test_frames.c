// How a frame is made does not show in it: portions, slices, a frame cancelled before, and the part of the
// picture that is asked for.
//
// Usage: test_frames SCENE [storage] [saved], a scene in which paths branch and none is deeper than 20 levels
// by weight. With `storage` the device traces as GPUs do: samples at once, which must not show either. With
// `saved` only what saves paths is tested.
#include "shaders/features.h"
#include "shaders/frame.h"
#include "tests/pictures/picture_kit.h"

#include <stdio.h>
#include <string.h>

struct frames {
    struct picture_kit kit;
    const char *path;
    int failed;
};

static void expect(struct frames *f, bool good, const char *what) {
    printf("%s %s\n", good ? "ok  " : "FAIL", what);
    f->failed += !good;
}

// A scene on the device, with settings that a test may change and then apply.
struct stage {
    struct session session;
    struct shot shot;
};

static bool open_stage(struct frames *f, struct stage *stage, int32_t width, int32_t height,
                       int32_t samples) {
    const struct session_options options = {.path = str_from(f->path),
                                            .limits = limits_default(),
                                            .width = width,
                                            .height = height,
                                            .samples = samples};
    session_load(&stage->session, &options, f->kit.store);
    bool good = stage->session.state == SESSION_LOADED && stage->session.sink.errors == 0 &&
                shot_open(&stage->shot, &stage->session, f->kit.gpu, 0) == SHOT_OK;
    expect(f, good, "the scene is on the device");
    return good;
}

static void close_stage(struct stage *stage) {
    shot_close(&stage->shot);
    session_finish(&stage->session);
}

static bool apply(struct stage *stage) {
    return renderer_change(stage->shot.renderer, &stage->shot.flat, &stage->shot.settings);
}

static bool take(struct stage *stage, struct image *image, struct render_statistics *statistics) {
    *image = (struct image){0};
    return image_init(image, stage->shot.settings.width, stage->shot.settings.height) &&
           shot_take(&stage->shot, image, NULL, statistics) == SHOT_OK && stage->session.sink.errors == 0;
}

// ---- cancelling

struct countdown {
    int left, calls;
    double last;
    bool ordered; // fractions rise, within 0..1
};

static bool count_down(void *context, double fraction) {
    struct countdown *c = context;
    c->ordered = c->ordered && fraction >= c->last && fraction >= 0 && fraction <= 1;
    c->last = fraction;
    c->calls++;
    return c->left-- > 0;
}

static void test_cancel(struct frames *f) {
    struct stage stage;
    struct image whole, image;
    struct render_statistics statistics;
    if (!open_stage(f, &stage, 64, 48, 3))
        return;
    stage.shot.settings.slice_iterations = 40; // many dispatches, so that many places can be cancelled
    stage.shot.settings.dispatch_paths = 900;  // the same places each time
    bool good = apply(&stage) && take(&stage, &whole, &statistics) && picture_variety(&whole) > 1000;
    expect(f, good && statistics.slices > 10, "a frame of many slices");
    struct countdown all = {.left = 1 << 30, .ordered = true};
    const struct render_progress watch = {count_down, &all};
    good = image_init(&image, 64, 48) && shot_take(&stage.shot, &image, &watch, &statistics) == SHOT_OK;
    expect(f, good && all.ordered && all.last == 1, "progress rises from 0 to 1");
    expect(f, picture_differences(&whole, &image, "watched") == 0, "watching does not change it");
    for (int left = 0; good && left < all.calls; left += 1 + left / 2) {
        struct countdown c = {.left = left, .ordered = true};
        const struct render_progress progress = {count_down, &c};
        enum shot_status status = shot_take(&stage.shot, &image, &progress, &statistics);
        good = status == SHOT_CANCELLED && c.calls == left + 1 && stage.session.sink.errors == 0 &&
               shot_take(&stage.shot, &image, NULL, &statistics) == SHOT_OK &&
               picture_differences(&whole, &image, "after a cancelled frame") == 0;
    }
    expect(f, good, "cancelled anywhere, the renderer makes the same picture again");
    image_finish(&whole);
    image_finish(&image);
    close_stage(&stage);
}

// ---- portions and slices

// A path's state grows with max_depth; by weight no path gets that deep.
static void test_portions(struct frames *f) {
    struct stage stage;
    struct image one = {0}, many = {0}, deep = {0}, counted = {0};
    struct render_statistics of_one = {0}, of_many = {0}, of_deep = {0};
    struct render_rays rays = {0};
    if (!open_stage(f, &stage, 96, 72, 2))
        return;
    stage.shot.settings.min_weight = 0.01;
    stage.shot.settings.max_depth = 20;
    bool good = apply(&stage) && take(&stage, &one, &of_one);
    stage.shot.settings.portion_tiles = 45; // a GPU has room for all of this picture at once
    good = apply(&stage) && take(&stage, &many, &of_many) && good;
    stage.shot.settings.max_depth = 64;
    good = apply(&stage) && take(&stage, &deep, &of_deep) && good;
    good = good && renderer_count(stage.shot.renderer, &stage.shot.view.camera, NULL, &rays) == RENDER_DONE;
    expect(f, good && rays.deepest < 20 && rays.primary == (uint64_t)96 * 72 * 2, "no path needs more depth");
    expect(f, of_one.portions == 1 && of_many.portions > 1 && of_deep.portions > 1,
           "one portion, and several");
    expect(f, good && picture_differences(&one, &many, "portions") == 0, "portions do not show");
    expect(f, good && picture_differences(&one, &deep, "deep") == 0, "room for deeper paths does not show");
    good = take(&stage, &counted, &of_deep) && picture_differences(&one, &counted, "after counting") == 0;
    expect(f, good, "counting rays does not show");
    image_finish(&one);
    image_finish(&many);
    image_finish(&deep);
    image_finish(&counted);
    close_stage(&stage);
}

static void test_slices(struct frames *f) {
    static const uint32_t sizes[] = {0, 1, 50, 300};
    struct stage stage;
    struct image whole, image;
    struct render_statistics statistics;
    if (!open_stage(f, &stage, 96, 72, 1))
        return;
    bool good = take(&stage, &whole, &statistics);
    const uint32_t least = statistics.slices;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        stage.shot.settings.slice_iterations = sizes[i];
        good = apply(&stage) && take(&stage, &image, &statistics) && statistics.slices > least && good &&
               picture_differences(&whole, &image, "slices") == 0;
        image_finish(&image);
    }
    expect(f, good, "slices do not show");
    // A slice of 0 ends at each node of a tree, others in the middle of one.
    stage.shot.settings.features |= FEATURE_LONG_RAYS;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        stage.shot.settings.slice_iterations = sizes[i];
        good = apply(&stage) && take(&stage, &image, &statistics) && statistics.slices > least && good &&
               picture_differences(&whole, &image, "long rays") == 0;
        image_finish(&image);
    }
    expect(f, good, "slices inside of rays do not show");
    image_finish(&whole);
    close_stage(&stage);
}

// Where texels are fetched a path begins in a kernel without the second search, and goes on in another one
// from a ray that is open. A picture that is made once has all in one.
static void test_open_rays(struct frames *f) {
    struct stage stage;
    struct image parted = {0}, whole = {0};
    struct render_statistics of_parted = {0}, of_whole = {0};
    if (!open_stage(f, &stage, 320, 240, 1))
        return;
    bool good = take(&stage, &whole, &of_whole);
    expect(f, of_whole.slices == 0, "a picture that is made once does with one kernel");
    good = take(&stage, &parted, &of_parted) && good;
    expect(f, good && picture_differences(&parted, &whole, "parted") == 0,
           "where a ray is searched for a second time does not show");
    expect(f, gpu_fetches_texels(f->kit.gpu) ? of_parted.slices == 1 : of_parted.slices == 0,
           "paths with an open ray go on in a kernel of their own where code costs time");
    image_finish(&parted);
    image_finish(&whole);
    close_stage(&stage);
}

// Where paths end at what they hit first, they begin in such a kernel on GPUs too, and those that it saves go
// on right after it: more of them than that takes at once, each in slices of its own, and with fewer places
// than there are paths to save.
static void test_followed(struct frames *f) {
    static const uint32_t cases[][2] = {
        {SLICE_ITERATIONS, 0}, {SLICE_ITERATIONS, 50}, {0, 0}}; // slice, places
    // Other GPUs have that for pictures of more paths.
    const bool apart = gpu_info(f->kit.gpu)->kind == GPU_CPU;
    struct stage stage;
    struct image whole = {0}, image = {0};
    struct render_statistics statistics;
    if (!open_stage(f, &stage, 320, 240, 2))
        return;
    stage.shot.settings.features &= ~(FEATURE_REFLECTION | FEATURE_REFRACTION);
    bool good = apply(&stage) && take(&stage, &whole, &statistics) && statistics.slices == 0;
    expect(f, good && picture_variety(&whole) > 1000, "a picture without bounces, by one kernel");
    for (size_t i = 0; i < sizeof cases / sizeof *cases && good; i++) {
        stage.shot.settings.slice_iterations = cases[i][0];
        stage.shot.settings.places = cases[i][1];
        stage.shot.settings.portion_tiles = 400 + (uint32_t)i; // with which all is made anew
        for (int turn = 0; turn < 2 && good; turn++) {
            good = apply(&stage) && take(&stage, &image, &statistics) &&
                   (!apart || turn == 0 || statistics.slices > 0) &&
                   picture_differences(&whole, &image, "followed") == 0;
            image_finish(&image);
        }
    }
    expect(f, good, "what goes on right after a pass does not show");
    image_finish(&whole);
    close_stage(&stage);
}

// Dispatches of few paths at a time, whose numbers are no multiples of anything.
static void test_pieces(struct frames *f) {
    static const uint32_t sizes[] = {64, 1000, 1937};
    struct stage stage;
    struct image whole, image;
    struct render_statistics statistics;
    if (!open_stage(f, &stage, 96, 72, 2))
        return;
    stage.shot.settings.slice_iterations = 300;
    bool good = apply(&stage) && take(&stage, &whole, &statistics);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        stage.shot.settings.dispatch_paths = sizes[i];
        good = apply(&stage) && take(&stage, &image, &statistics) && good &&
               statistics.dispatches > 2 * 96 * 72 / sizes[i] &&
               picture_differences(&whole, &image, "pieces") == 0;
        image_finish(&image);
    }
    expect(f, good, "dispatches of few paths do not show");
    image_finish(&whole);
    close_stage(&stage);
}

// ---- samples at once

// More samples than are traced at once, and fewer places for saved paths than paths that are saved: those
// that find none begin once more.
static void test_at_once(struct frames *f) {
    static const uint32_t places[] = {1, 4, 75};
    const uint32_t samples = SAMPLES_AT_ONCE + 6;
    struct stage stage;
    struct image whole, image;
    struct render_statistics statistics;
    struct render_rays rays, again;
    if (!open_stage(f, &stage, 6, 4, 1))
        return;
    stage.shot.settings.samples = samples;
    bool good = apply(&stage) && take(&stage, &whole, &statistics) && statistics.samples == samples &&
                renderer_count(stage.shot.renderer, &stage.shot.view.camera, NULL, &rays) == RENDER_DONE;
    stage.shot.settings.slice_iterations = 40;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        stage.shot.settings.samples = i ? samples : 2; // one place: thousands of passes
        stage.shot.settings.places = places[i];
        good = apply(&stage) && take(&stage, &image, &statistics) && statistics.slices > 10 && good &&
               (i == 0 || picture_differences(&whole, &image, "places") == 0);
        image_finish(&image);
    }
    expect(f, good, "how many paths can be saved does not show");
    good = good && renderer_count(stage.shot.renderer, &stage.shot.view.camera, NULL, &again) == RENDER_DONE;
    expect(f,
           good && rays.reflected == again.reflected && rays.refracted == again.refracted &&
               rays.shadow == again.shadow && rays.cut_by_weight == again.cut_by_weight,
           "nor does it in the counts");
    image_finish(&whole);
    close_stage(&stage);
}

// ---- a part of the picture

// With sizes that are powers of two, half the field is the middle of the whole field without a rounding.
static void test_crop(struct frames *f) {
    enum {
        WIDTH = 512,
        HEIGHT = 256
    };
    struct stage large, small;
    struct image whole, middle, cut = {0};
    struct render_statistics statistics;
    if (!open_stage(f, &large, WIDTH, HEIGHT, 1))
        return;
    large.shot.settings.portion_tiles = 1024;
    bool good = apply(&large) && take(&large, &whole, &statistics);
    expect(f, good && statistics.portions > 1, "a picture of several portions");
    good = open_stage(f, &small, WIDTH / 2, HEIGHT / 2, 1) && good;
    small.shot.view.camera.tan_half_fov = large.shot.view.camera.tan_half_fov / 2;
    good = good && take(&small, &middle, &statistics) && image_init(&cut, WIDTH / 2, HEIGHT / 2);
    for (size_t y = 0; good && y < HEIGHT / 2; y++)
        memcpy(cut.rgb + y * (WIDTH / 2) * 3, whole.rgb + ((y + HEIGHT / 4) * WIDTH + WIDTH / 4) * 3,
               WIDTH / 2 * 3 * sizeof(float));
    expect(f, good && picture_variety(&cut) > 10000 && picture_differences(&cut, &middle, "middle") == 0,
           "a picture of the middle is the middle of the picture");
    image_finish(&whole);
    image_finish(&middle);
    image_finish(&cut);
    close_stage(&small);
    close_stage(&large);
}

// ---- faults

// A sample of too many rays is a fault at its pixel, and only there: all other pixels are the same.
static void test_segments(struct frames *f) {
    struct stage stage;
    struct image whole, image;
    struct render_statistics statistics;
    if (!open_stage(f, &stage, 96, 72, 1))
        return;
    bool good = take(&stage, &whole, &statistics) && statistics.faults[RENDER_SEGMENTS].pixels == 0;
    stage.shot.settings.path_segments = 12;
    good = good && apply(&stage) && image_init(&image, 96, 72) &&
           shot_take(&stage.shot, &image, NULL, &statistics) == SHOT_OK;
    const struct render_fault *fault = &statistics.faults[RENDER_SEGMENTS];
    const int64_t changed = good ? picture_differences(&whole, &image, "fewer rays") : -1;
    expect(f, good && fault->pixels > 0 && fault->pixels < 96 * 72 / 2, "some pixels need more than 12 rays");
    expect(f, changed > 0 && changed <= fault->pixels, "no other pixel changes");
    expect(f, good && fault->has_body && stage.session.sink.errors == 1, "one error tells it");
    image_finish(&whole);
    image_finish(&image);
    close_stage(&stage);
}

// ---- frames that end early

enum {
    LIMITED_WIDTH = 64,
    LIMITED_HEIGHT = 48,
    LIMITED_MIDDLE = 3 * (LIMITED_HEIGHT / 2 * LIMITED_WIDTH + LIMITED_WIDTH / 2) // of its floats
};

// Ends the frame after `samples`, or at call number `calls` between dispatches.
struct limiting {
    uint32_t samples, calls;
    bool has_picture; // the first one was shown
    float first[3];
};

static bool goes_on(void *context, uint32_t samples, const float *rgb) {
    struct limiting *l = context;
    if (samples == 1) {
        l->has_picture = true;
        memcpy(l->first, rgb + LIMITED_MIDDLE, sizeof l->first);
    }
    return samples < l->samples;
}

static bool runs_out(void *context) {
    struct limiting *l = context;
    return l->calls-- == 0;
}

// The picture is the one of as many samples, whether the limit comes between two or within one.
static void test_limits(struct frames *f, uint32_t portion_tiles) {
    struct stage stage;
    struct image of[4] = {{0}}, image = {0};
    struct render_statistics statistics;
    bool good = true;
    uint32_t within = 0;
    if (!open_stage(f, &stage, LIMITED_WIDTH, LIMITED_HEIGHT, 1))
        return;
    stage.shot.settings.dispatch_paths = 400;
    stage.shot.settings.portion_tiles = portion_tiles;
    for (uint32_t n = 1; n <= 4; n++) {
        stage.shot.settings.samples = n;
        good = apply(&stage) && take(&stage, &of[n - 1], &statistics) && statistics.samples == n && good;
    }
    good = image_init(&image, LIMITED_WIDTH, LIMITED_HEIGHT) && good;
    for (uint32_t k = 0; good && k < 20; k++) {
        struct limiting l = {.samples = k < 4 ? k + 1 : 9, .calls = k < 4 ? UINT32_MAX : k - 4};
        const struct render_limit limit = {.goes_on = goes_on, .is_over = runs_out, .context = &l};
        good = shot_take_until(&stage.shot, &image, NULL, &limit, &statistics) == SHOT_OK &&
               statistics.samples >= 1 && statistics.samples <= 4 &&
               (k >= 4 || statistics.samples == k + 1) &&
               picture_differences(&of[statistics.samples - 1], &image, "ended early") == 0 &&
               (!l.has_picture || memcmp(l.first, of[0].rgb + LIMITED_MIDDLE, sizeof l.first) == 0);
        within += k >= 4 && statistics.samples < 4;
    }
    expect(f, good && within > 3, "a frame that ends early is that of fewer samples");
    for (int i = 0; i < 4; i++)
        image_finish(&of[i]);
    image_finish(&image);
    close_stage(&stage);
}

// Two samples are the mean of the first and of the one after it.
static void test_first_sample(struct frames *f) {
    struct stage stage;
    struct image first = {0}, second = {0}, both = {0};
    struct render_statistics statistics;
    double worst = 0;
    if (!open_stage(f, &stage, 96, 72, 1))
        return;
    bool good = take(&stage, &first, &statistics);
    stage.shot.settings.first_sample = 1;
    good = apply(&stage) && take(&stage, &second, &statistics) && good;
    stage.shot.settings.first_sample = 0;
    stage.shot.settings.samples = 2;
    good = apply(&stage) && take(&stage, &both, &statistics) && good;
    for (size_t i = 0; good && i < (size_t)96 * 72 * 3; i++)
        worst = fmax(worst, fabs(0.5 * ((double)first.rgb[i] + (double)second.rgb[i]) - (double)both.rgb[i]));
    expect(f, good && worst < 1e-6, "samples can be taken one after the other");
    expect(f, good && picture_differences(&first, &second, "") > 0, "and differ");
    image_finish(&first);
    image_finish(&second);
    image_finish(&both);
    close_stage(&stage);
}

// A part of a picture, by region and by sample, has the very floats of the whole.
static bool is_in_place(const struct image *part, const struct image *whole, uint32_t x, uint32_t y) {
    bool same = true;
    for (uint32_t row = 0; row < part->height; row++)
        same = same && memcmp(part->rgb + (size_t)row * part->width * 3,
                              whole->rgb + ((size_t)(y + row) * whole->width + x) * 3,
                              (size_t)part->width * 3 * sizeof *part->rgb) == 0;
    return same;
}

static void test_parts(struct frames *f) {
    static const uint32_t places[][4] = {{0, 0, 96, 72}, {0, 40, 96, 32}, {13, 5, 50, 41}, {95, 71, 1, 1}};
    struct stage stage;
    struct image whole = {0}, part = {0};
    struct render_statistics statistics;
    if (!open_stage(f, &stage, 96, 72, 2))
        return;
    struct render_settings *settings = &stage.shot.settings;
    bool good = take(&stage, &whole, &statistics);
    settings->whole_width = 96;
    settings->whole_height = 72;
    settings->whole_samples = 2;
    for (size_t i = 0; good && i < sizeof places / sizeof *places; i++) {
        settings->first_x = places[i][0];
        settings->first_y = places[i][1];
        settings->width = places[i][2];
        settings->height = places[i][3];
        good = apply(&stage) && take(&stage, &part, &statistics);
        expect(f, good && is_in_place(&part, &whole, places[i][0], places[i][1]),
               "a region has the floats of the whole");
        image_finish(&part);
    }
    settings->samples = 1;
    settings->first_x = settings->first_y = 0;
    settings->width = 96;
    settings->height = 72;
    struct image samples[2] = {{0}, {0}};
    for (uint32_t i = 0; i < 2; i++) {
        settings->first_sample = i;
        good = apply(&stage) && take(&stage, &samples[i], &statistics) && good;
    }
    for (size_t i = 0; good && i < (size_t)96 * 72 * 3; i++)
        samples[0].rgb[i] = (samples[0].rgb[i] + samples[1].rgb[i]) / 2;
    expect(f, good && is_in_place(&samples[0], &whole, 0, 0), "and samples make it in their order");
    for (int i = 0; i < 2; i++)
        image_finish(&samples[i]);
    image_finish(&whole);
    close_stage(&stage);
}

static void test_whole_frames(struct frames *f) {
    test_cancel(f);
    test_portions(f);
    test_crop(f);
    test_segments(f);
    test_limits(f, 0);
    test_limits(f, 20);
    test_first_sample(f);
    test_parts(f);
}

int main(int argc, char **argv) {
    struct frames f = {.path = argc > 1 ? argv[1] : NULL};
    if (argc < 2)
        return 2;
    bool storage = false, saved = false;
    for (int i = 2; i < argc; i++) {
        storage = storage || strcmp(argv[i], "storage") == 0;
        saved = saved || strcmp(argv[i], "saved") == 0;
    }
    if (!(storage ? picture_kit_open_as_gpu(&f.kit) : picture_kit_open(&f.kit)))
        return 77;
    test_slices(&f);
    test_open_rays(&f);
    test_followed(&f);
    test_pieces(&f);
    test_at_once(&f);
    if (!saved)
        test_whole_frames(&f);
    uint32_t messages = picture_kit_close(&f.kit);
    expect(&f, messages == 0, "the validation layer is silent");
    return f.failed != 0;
}
