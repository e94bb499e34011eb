// The refracted rays that wait in a path have as much room as the weights of a scene's materials let them
// need: a device that keeps them in a buffer, beside those of other pixels, makes the picture of one in which
// a path has room for one at each level.
//
// Usage: test_waiting SCENE, whose material `pane` reflects and refracts
#include "tests/pictures/picture_kit.h"
#include "tracer/render/render_private.h"

#include <stdio.h>

enum {
    LEVELS = 17, // max_depth of the scene is 16
};

struct weights {
    double reflection, refraction, least;
    uint32_t room; // for so many rays
};
// The first is on the line: half of half of a half is an eighth.
static const struct weights cases[] = {
    {0.5, 0.5, 0.125, 3},
    {0.5, 0.5, 0.03, 5},
    {0.5, 0.5, 0.1251, 2},
    {0.8, 0.2, 0.25, 6},
    {0.25, 0.75, 0.016, 2},
    {0.1, 0.8, 0.001, 3},
    {0.6, 0.6, 0.5, 7}, // both at a surface that refracts
                        // nothing: then rays gain weight
    {0.05, 0.9, 0.3, 1},
    {1, 0.3, 0.2, LEVELS},
    {0.3, 0.6, 0, LEVELS},
};

static bool draw(struct picture_kit *kit, const char *path, const struct weights *w, const char *precision,
                 uint32_t *room, struct image *image) {
    char albedo[80], least[40], digits[40];
    snprintf(albedo, sizeof albedo, "materials.pane.albedo=[0.1, 0.2, %g, %g]", w->reflection, w->refraction);
    snprintf(least, sizeof least, "trace.min_weight=%g", w->least);
    snprintf(digits, sizeof digits, "trace.precision=%s", precision);
    const str sets[] = {str_from(albedo), str_from(least), str_from(digits)};
    const struct session_options options = {
        .path = str_from(path), .limits = limits_default(), .sets = sets, .set_count = 3};
    struct session session;
    struct shot shot;
    struct render_statistics statistics;
    session_load(&session, &options, kit->store);
    bool good = session.state == SESSION_LOADED && session.sink.errors == 0;
    if (good && shot_open(&shot, &session, kit->gpu, 0) == SHOT_OK) {
        *room = shot.renderer->path_stack;
        good = image_init(image, (uint32_t)session.image->width, (uint32_t)session.image->height) &&
               shot_take(&shot, image, NULL, &statistics) == SHOT_OK && session.sink.errors == 0;
        shot_close(&shot);
    } else {
        good = false;
    }
    session_finish(&session);
    return good;
}

static bool test_case(struct picture_kit *in_buffer, struct picture_kit *in_private, const char *path,
                      const struct weights *w, const char *precision) {
    struct image expected = {0}, image = {0};
    uint32_t all = 0, room = 0;
    bool good = draw(in_private, path, w, precision, &all, &expected) &&
                draw(in_buffer, path, w, precision, &room, &image) && picture_variety(&expected) > 100;
    good = good && picture_differences(&expected, &image, path) == 0 && all == LEVELS && room == w->room;
    printf("%s reflection %g, refraction %g, least %g, %s: room for %u of %u\n", good ? "ok  " : "FAIL",
           w->reflection, w->refraction, w->least, precision, (unsigned)room, (unsigned)all);
    image_finish(&expected);
    image_finish(&image);
    return good;
}

int main(int argc, char **argv) {
    struct picture_kit in_buffer, in_private;
    int failed = 0;
    if (argc != 2)
        return 2;
    if (!picture_kit_open(&in_buffer))
        return 77;
    if (!picture_kit_open_as_gpu(&in_private)) {
        picture_kit_close(&in_buffer);
        return 77;
    }
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        failed += !test_case(&in_buffer, &in_private, argv[1], &cases[i], "single");
        if (i < 2)
            failed += !test_case(&in_buffer, &in_private, argv[1], &cases[i], "double");
    }
    failed += picture_kit_close(&in_buffer) + picture_kit_close(&in_private) != 0;
    return failed != 0;
}
