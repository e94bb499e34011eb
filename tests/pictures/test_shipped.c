// Every scene that ships, small: its twins give the same picture, and the shader with everything on gives
// the same picture as the one that is specialised to the scene; byte for byte. Double precision shows what
// single shows, but for a few pixels at edges.
//
// Usage: test_shipped SCENE.yaml... (their twins end in .xml)
#include "picture_kit.h"

#include "grammar/ir.h"
#include "shaders/features.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool twin_path(const char *yaml, char *out, size_t size) {
    size_t n = strlen(yaml);
    if (n < 5 || n >= size || strcmp(yaml + n - 5, ".yaml") != 0)
        return false;
    snprintf(out, size, "%.*s.xml", (int)(n - 5), yaml);
    return true;
}

static bool same(struct picture_kit *kit, const struct image *first, const char *path,
                 const struct picture_options *options, const char *what) {
    struct image second;
    bool good = picture_take(kit, path, options, &second) && picture_differences(first, &second, what) == 0;
    image_finish(&second);
    return good;
}

static void make_double(struct ir_scene *scene, void *was_auto) {
    *(bool *)was_auto = scene->trace.precision == IR_PRECISION_AUTO;
    scene->trace.precision = IR_PRECISION_DOUBLE;
}

// At most 1 % of the pixels off by more than 1/255; `first` is in single precision where the scene says auto.
static bool double_agrees(struct picture_kit *kit, const struct image *first, const char *yaml,
                          struct picture_options options) {
    struct image second;
    bool was_auto = false;
    uint32_t others = 0;
    options.edit = make_double;
    options.context = &was_auto;
    if (!picture_take(kit, yaml, &options, &second))
        return false;
    const size_t count = (size_t)first->width * first->height;
    for (size_t i = 0; i < count; i++) {
        bool off = false;
        for (size_t c = 3 * i; c < 3 * i + 3; c++)
            off = off || fabsf(first->rgb[c] - second.rgb[c]) > 1.0F / 255;
        others += off;
    }
    image_finish(&second);
    if (was_auto && others > count / 100)
        fprintf(stderr, "%s: in double precision %u of %zu pixels differ\n", yaml, others, count);
    return !was_auto || others <= count / 100;
}

static bool check_scene(struct picture_kit *kit, const char *yaml) {
    char xml[1024];
    struct image first;
    struct picture_options small = {.width = 64, .height = 48, .samples = 1};
    struct picture_options general = small;
    general.more_features = FEATURE_GENERAL;
    bool good = twin_path(yaml, xml, sizeof xml) && picture_take(kit, yaml, &small, &first);
    if (!good) {
        fprintf(stderr, "%s: no picture\n", yaml);
        return false;
    }
    if (picture_variety(&first) < 10) {
        fprintf(stderr, "%s: the picture shows nothing\n", yaml);
        good = false;
    }
    good = same(kit, &first, xml, &small, xml) && good;
    good = same(kit, &first, yaml, &general, "with all features") && good;
    if (!kit->by_reference && gpu_info(kit->gpu)->has_double)
        good = double_agrees(kit, &first, yaml, small) && good;
    image_finish(&first);
    printf("%s %s\n", good ? "ok  " : "FAIL", yaml);
    return good;
}

int main(int argc, char **argv) {
    struct picture_kit kit;
    if (!picture_kit_open(&kit))
        return 77;
    int failed = 0;
    for (int i = 1; i < argc; i++)
        failed += !check_scene(&kit, argv[i]);
    uint32_t messages = picture_kit_close(&kit);
    if (messages)
        fprintf(stderr, "%u validation messages\n", messages);
    return failed || messages || argc < 2;
}
