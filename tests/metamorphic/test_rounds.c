// The points that a pixel's samples take of lamps, lenses and rough surfaces are those of their numbers: a
// device that traces samples at once, which it does in several rounds where they are many, makes the picture
// of one that traces them one after the other.
//
// Usage: test_rounds SCENE...
#include "shaders/frame.h"
#include "tests/pictures/picture_kit.h"

#include <stdio.h>

enum {
    WIDTH = 40,
    HEIGHT = 30,
    FIRST = 3 // of a part of the samples
};

static bool draw(struct picture_kit *kit, const char *path, uint32_t first, struct image *image) {
    const struct session_options options = {.path = str_from(path),
                                            .limits = limits_default(),
                                            .width = WIDTH,
                                            .height = HEIGHT,
                                            .samples = SAMPLES_AT_ONCE + 6};
    struct session session;
    struct shot shot;
    struct render_statistics statistics;
    session_load(&session, &options, kit->store);
    bool good = session.state == SESSION_LOADED && session.sink.errors == 0;
    if (good && shot_open(&shot, &session, kit->gpu, 0) == SHOT_OK) {
        shot.settings.first_sample = first;
        shot.settings.samples -= first;
        good = renderer_change(shot.renderer, &shot.flat, &shot.settings) &&
               image_init(image, WIDTH, HEIGHT) && shot_take(&shot, image, NULL, &statistics) == SHOT_OK &&
               session.sink.errors == 0 && statistics.samples == SAMPLES_AT_ONCE + 6 - first;
        shot_close(&shot);
    } else {
        good = false;
    }
    session_finish(&session);
    return good;
}

static bool test_scene(struct picture_kit *in_turn, struct picture_kit *at_once, const char *path,
                       uint32_t first) {
    struct image expected = {0}, image = {0};
    bool good = draw(in_turn, path, first, &expected) && draw(at_once, path, first, &image) &&
                picture_variety(&expected) > 100;
    good = good && picture_differences(&expected, &image, path) == 0;
    printf("%s %s, samples from %u on\n", good ? "ok  " : "FAIL", path, (unsigned)first);
    image_finish(&expected);
    image_finish(&image);
    return good;
}

int main(int argc, char **argv) {
    struct picture_kit in_turn, at_once;
    int failed = 0;
    if (argc < 2)
        return 2;
    if (!picture_kit_open(&in_turn))
        return 77;
    if (!picture_kit_open_as_gpu(&at_once)) {
        picture_kit_close(&in_turn);
        return 77;
    }
    for (int i = 1; i < argc; i++) {
        failed += !test_scene(&in_turn, &at_once, argv[i], 0);
        failed += !test_scene(&in_turn, &at_once, argv[i], FIRST);
    }
    failed += picture_kit_close(&in_turn) + picture_kit_close(&at_once) != 0;
    return failed != 0;
}
