// Scenes moved by a million units and by a billion, as an author would move them: each coordinate is read
// again from its decimal text. At most 0.05 % and 0.5 % of the pixels change by more than 1/255; in single
// precision where that is what `auto` takes.
//
// Usage: test_far WIDTH HEIGHT SCENE...
#include "picture_kit.h"
#include "scene_map.h"

#include "core/number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct change {
    const char *name;
    vec3 move;
    double allowed; // share of the pixels
    unsigned precision;
};

// Digits behind the point of a number's shortest text.
static int decimals_of(const char *text) {
    const char *point = strchr(text, '.');
    const char *power = strchr(text, 'e');
    long shift = power ? strtol(power + 1, NULL, 10) : 0;
    long digits = point ? (long)strcspn(point + 1, "e") : 0;
    return digits > shift ? (int)(digits - shift) : 0;
}

static double moved(double value, double by) {
    char text[NUMBER_FORMAT_MAX];
    number_format(value, text);
    const int decimals = decimals_of(text);
    char sum[64];
    snprintf(sum, sizeof sum, "%.*Lf", decimals < 18 ? decimals : 18, (long double)value + (long double)by);
    return strtod(sum, NULL);
}

static void move_point(vec3 *p, const void *context) {
    const struct change *c = context;
    *p = (vec3){moved(p->x, c->move.x), moved(p->y, c->move.y), moved(p->z, c->move.z)};
}

static void change_scene(struct ir_scene *scene, void *context) {
    const struct change *c = context;
    scene_map_apply(scene, &(struct scene_map){.point = move_point, .context = c});
    if (c->precision != IR_PRECISION_AUTO)
        scene->trace.precision = c->precision;
}

static const struct change changes[] = {
    {"moved by a million", {1e6, -1e6, 1e6}, 0.0005, IR_PRECISION_AUTO},
    {"moved by a billion", {-1e9, 1e9, 1e9}, 0.005, IR_PRECISION_AUTO},
    {"moved by a million, single", {1e6, -1e6, 1e6}, 0.0005, IR_PRECISION_SINGLE},
    {"moved by a billion, single", {-1e9, 1e9, 1e9}, 0.005, IR_PRECISION_SINGLE},
};

static double share_of_others(const struct image *a, const struct image *b) {
    uint32_t others = 0;
    for (size_t i = 0; i < (size_t)a->width * a->height; i++) {
        double most = 0;
        for (size_t c = 3 * i; c < 3 * i + 3; c++)
            most =
                fmax(most, fabs(fmin(fmax((double)a->rgb[c], 0), 1) - fmin(fmax((double)b->rgb[c], 0), 1)));
        others += most > 1.0 / 255;
    }
    return others / ((double)a->width * a->height);
}

static bool check_scene(struct picture_kit *kit, const char *path, struct picture_options options) {
    struct image first, second;
    bool needs_double = false;
    options.was_double = &needs_double;
    if (!picture_take(kit, path, &options, &first))
        return false;
    bool good = picture_variety(&first) > 10;
    options.was_double = NULL;
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        struct change change = changes[i];
        if (needs_double && change.precision == IR_PRECISION_SINGLE)
            continue;
        options.edit = change_scene;
        options.context = &change;
        bool taken = picture_take(kit, path, &options, &second);
        double share = taken ? share_of_others(&first, &second) : 1;
        bool same = share <= change.allowed;
        printf("%s %s %s: %.4f %% of the pixels\n", same ? "ok  " : "FAIL", path, change.name, 100 * share);
        image_finish(&second);
        good = good && same;
    }
    image_finish(&first);
    return good;
}

int main(int argc, char **argv) {
    struct picture_kit kit;
    if (argc < 4)
        return 2;
    const struct picture_options options = {.width = (int32_t)strtol(argv[1], NULL, 10),
                                            .height = (int32_t)strtol(argv[2], NULL, 10),
                                            .samples = 1};
    if (!picture_kit_open(&kit))
        return 77;
    int failed = 0;
    for (int i = 3; i < argc; i++)
        failed += !check_scene(&kit, argv[i], options);
    uint32_t messages = picture_kit_close(&kit);
    return failed || messages;
}
