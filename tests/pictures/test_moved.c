// A scene whose coordinates are multiples of 2^-16, moved by 2^10 and 2^20 units, or scaled by 2^20 and
// 2^-20, with its camera and lights: the same picture, byte for byte, in
// both precisions.
//
// Usage: test_moved SCENE...
#include "picture_kit.h"
#include "scene_map.h"

#include <math.h>
#include <stdio.h>

struct change {
    const char *name;
    vec3 move;
    int scale_exponent;
    unsigned precision;
};

static void change_point(vec3 *p, const void *context) {
    const struct change *c = context;
    *p = (vec3){scalbn(p->x, c->scale_exponent) + c->move.x, scalbn(p->y, c->scale_exponent) + c->move.y,
                scalbn(p->z, c->scale_exponent) + c->move.z};
}

static void change_length(double *length, const void *context) {
    const struct change *c = context;
    *length = scalbn(*length, c->scale_exponent);
}

static void change_vector(vec3 *v, const void *context) {
    const struct change *c = context;
    *v = vec3_mul(*v, scalbn(1, c->scale_exponent));
}

// The scenes here give no checker to two bodies.
static void change_scene(struct ir_scene *scene, void *context) {
    const struct change *c = context;
    scene->trace.precision = c->precision;
    scene_map_apply(scene, &(struct scene_map){change_point, change_vector, change_length, c});
    for (uint32_t i = 0; i < scene->lights.count; i++) {
        struct ir_light *light = &scene->lights.items[i];
        if (light->falloff == IR_FALLOFF_INVERSE_SQUARE)
            light->intensity = scalbn(light->intensity, 2 * c->scale_exponent);
    }
}

static const struct change changes[] = {
    {"as it is", {0, 0, 0}, 0, 0},
    {"moved by 2^10", {0x1p10, 0, 0}, 0, 0},
    {"moved by 2^20", {0x1p20, -0x1p20, 0x1p20}, 0, 0},
    {"scaled by 2^20", {0, 0, 0}, 20, 0},
    {"scaled by 2^-20", {0, 0, 0}, -20, 0},
    {"scaled by 2^-10 and moved", {0x1p10, 0x1p10, -0x1p10}, -10, 0},
};

static bool check_scene(struct picture_kit *kit, const char *path, unsigned precision) {
    struct image first = {0};
    struct picture_options options = {.edit = change_scene};
    bool good = true;
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        struct image image;
        struct change change = changes[i];
        change.precision = precision;
        options.context = &change;
        bool same = picture_take(kit, path, &options, &image);
        if (i == 0) {
            first = image;
            same = same && picture_variety(&first) > 100;
        } else {
            same = same && picture_differences(&first, &image, change.name) == 0;
            image_finish(&image);
        }
        printf("%s %s %s, %s precision\n", same ? "ok  " : "FAIL", path, change.name,
               precision == IR_PRECISION_DOUBLE ? "double" : "single");
        good = good && same;
    }
    image_finish(&first);
    return good;
}

int main(int argc, char **argv) {
    struct picture_kit kit;
    if (!picture_kit_open(&kit))
        return 77;
    int failed = 0;
    const bool has_double = !kit.by_reference && gpu_info(kit.gpu)->has_double;
    for (int i = 1; i < argc; i++) {
        failed += !check_scene(&kit, argv[i], IR_PRECISION_SINGLE);
        if (has_double)
            failed += !check_scene(&kit, argv[i], IR_PRECISION_DOUBLE);
    }
    uint32_t messages = picture_kit_close(&kit);
    return failed || messages || argc < 2;
}
