// What makes no difference: frames repeated, trees of other shapes, workgroups of other sizes, models that
// share a mesh. The picture has the same bytes, in single and in double precision.
//
// Usage: test_same REPEATS [storage] SCENE... With `storage` the device traces as GPUs do; only instances are
// then compared with copies.
#include "load/session_precision.h"
#include "tests/pictures/picture_kit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    WIDTH = 96,
    HEIGHT = 72,
};

// Of instances, for one of copies, where there are at least so many instances and no triangles are copied for
// each: among a few, boxes of the meshes count.
#define NODES_MOST     1.25
#define INSTANCES_MANY 8

struct bench {
    bool as_gpu;
    uint64_t nodes; // that the rays of the same scene opened in copies, with leaves of one
    struct picture_kit kit;
    struct session session;
    struct view view;
    int failed;
};

struct variant {
    const char *name;
    enum bvh_method method;
    uint32_t workgroup;
    enum flat_sharing sharing;
};

static const struct variant variants[] = {
    {"once more", BVH_SAH, 0, FLAT_COPIES},
    {"leaves of two", BVH_SAH_PAIRS, 0, FLAT_COPIES},
    {"leaves of one", BVH_SAH_SINGLES, 0, FLAT_COPIES},
    {"a tree of halves", BVH_MEDIAN, 0, FLAT_COPIES},
    {"workgroups of 8", BVH_SAH, 8, FLAT_COPIES},
    {"workgroups of 32", BVH_SAH, 32, FLAT_COPIES},
    {"workgroups of 128", BVH_SAH, 128, FLAT_COPIES},
    {"instances", BVH_SAH, 0, FLAT_SHARED},
    {"instances, leaves of one", BVH_SAH_SINGLES, 0, FLAT_SHARED},
};

static void expect(struct bench *b, bool good, const char *path, bool is_double, const char *what) {
    printf("%s %s %s %s\n", good ? "ok  " : "FAIL", path, is_double ? "double" : "single", what);
    b->failed += !good;
}

static bool copies_triangles(const struct flat_scene *flat) {
    for (uint32_t i = 0; i < flat->use_count; i++)
        if (flat->uses[i].copied)
            return true;
    return false;
}

// Rays of instances go through the boxes of two trees, but leaves of the upper one are not opened.
static void check_nodes(struct bench *b, const struct variant *variant, const struct flat_scene *flat,
                        uint64_t nodes) {
    if (variant->sharing == FLAT_COPIES)
        b->nodes = nodes;
    else if (flat->instance_count >= INSTANCES_MANY && !copies_triangles(flat))
        expect(b, nodes > 0 && (double)nodes < NODES_MOST * (double)b->nodes, variant->name, flat->is_double,
               "opens few more nodes than copies");
}

static bool shares_mesh(const struct scene *scene) {
    for (uint32_t i = 0; i < scene->body_count; i++)
        for (uint32_t k = 0; k < i; k++)
            if (scene->bodies[i].mesh && scene->bodies[k].mesh == scene->bodies[i].mesh)
                return true;
    return false;
}

// Renders `count` times, and compares with `first`, which a count of 1 may fill.
static bool render(struct bench *b, const struct variant *variant, bool is_double, int count,
                   struct image *first) {
    struct flat_scene flat;
    struct render_statistics statistics;
    struct image image;
    struct flat_input input = precision_input(&b->session, &b->view);
    input.is_double = is_double;
    input.method = variant->method;
    input.sharing = variant->sharing;
    if (!flatten(&input, &flat))
        return false;
    if ((flat.instance_count != 0) != (variant->sharing == FLAT_SHARED && shares_mesh(&b->session.resolved)))
        expect(b, false, variant->name, is_double, "has instances where models share a mesh");
    struct render_settings settings = render_settings_of(&b->session.resolved, &flat, input.limits);
    settings.width = WIDTH;
    settings.height = HEIGHT;
    settings.samples = 1;
    settings.workgroup = variant->workgroup;
    settings.counts = variant->method == BVH_SAH_SINGLES;
    struct renderer *renderer = renderer_create(b->kit.gpu, &flat, &settings);
    bool good = renderer && image_init(&image, WIDTH, HEIGHT);
    for (int i = 0; good && i < count; i++) {
        good = renderer_render(renderer, &b->view.camera, image.rgb, NULL, &statistics) == RENDER_DONE;
        if (good && first->rgb)
            good = picture_differences(first, &image, variant->name) == 0;
    }
    if (good && settings.counts && !b->as_gpu)
        check_nodes(b, variant, &flat, statistics.rays.nodes);
    if (good && !first->rgb)
        *first = image;
    else if (renderer)
        image_finish(&image);
    renderer_destroy(renderer);
    flat_finish(&flat);
    return good;
}

static void check_scene(struct bench *b, const char *path, int repeats) {
    const struct session_options options = {
        .path = str_from(path), .limits = limits_default(), .width = WIDTH, .height = HEIGHT};
    session_load(&b->session, &options, b->kit.store);
    bool loaded = b->session.state == SESSION_LOADED && b->session.sink.errors == 0 &&
                  session_view(&b->session, 0, &b->view);
    if (!loaded)
        expect(b, false, path, false, "is loaded");
    const bool has_double = gpu_info(b->kit.gpu)->has_double;
    for (int is_double = 0; loaded && is_double <= (int)has_double; is_double++) {
        struct image first = {0};
        bool good = render(b, &variants[0], is_double, 1, &first);
        expect(b, good && picture_variety(&first) > 100, path, is_double, "shows something");
        for (size_t i = 0; good && i < sizeof variants / sizeof *variants; i++) {
            if (b->as_gpu && variants[i].sharing == FLAT_COPIES)
                continue;
            bool same = render(b, &variants[i], is_double, i == 0 ? repeats : 1, &first);
            expect(b, same, path, is_double, variants[i].name);
        }
        image_finish(&first);
    }
    session_finish(&b->session);
}

int main(int argc, char **argv) {
    struct bench b = {0};
    if (argc < 3)
        return 2;
    b.as_gpu = strcmp(argv[2], "storage") == 0;
    if (!(b.as_gpu ? picture_kit_open_as_gpu(&b.kit) : picture_kit_open(&b.kit)) || b.kit.by_reference)
        return 77;
    for (int i = 2 + b.as_gpu; i < argc; i++)
        check_scene(&b, argv[i], (int)strtol(argv[1], NULL, 10));
    uint32_t messages = picture_kit_close(&b.kit);
    return b.failed || messages;
}
