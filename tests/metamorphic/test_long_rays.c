// Rays that visit more nodes and bodies than a slice has iterations. From inside of nested spheres every box
// has to be opened: none may be left out, and the picture is known.
//
// Usage: test_long_rays FOLDER, where the scene is written.
#include "tests/pictures/picture_kit.h"

#include <math.h>
#include <stdio.h>

enum {
    SPHERES = 7500,
    SIDE = 8,
    REFLECTED_DEPTH = 2,
};

static int failed;

static void expect(bool good, const char *what) {
    printf("%s %s\n", good ? "ok  " : "FAIL", what);
    failed += !good;
}

// The camera and a light in the middle of the spheres; the innermost is the last written, and has a colour of
// its own. All it shows is its own light, and after a mirror's bounce the same again.
static bool write_scene(const char *path, bool is_double) {
    FILE *file = fopen(path, "w");
    if (!file)
        return false;
    fprintf(file,
            "glint: 1\nimage: {width: %d, height: %d, tone: clip, transfer: none}\n"
            "trace: {max_depth: %d, min_weight: 0, depth_limit: black, precision: %s}\n"
            "camera: {position: [0, 0, 0], look_at: [0, 0, -1]}\nbackground: {color: [0, 0, 1]}\n"
            "lights:\n  - {position: [0, 0, 0], intensity: 1}\nmaterials:\n"
            "  outer: {albedo: [1, 0, 0, 0], diffuse_color: [1, 0, 0]}\n"
            "  inner: {albedo: [0.5, 0, 0.5, 0], diffuse_color: [0, 1, 0]}\nspheres:\n",
            SIDE, SIDE, REFLECTED_DEPTH, is_double ? "double" : "single");
    for (int i = SPHERES; i > 0; i--)
        fprintf(file, "  - {center: [0, 0, 0], radius: %d, material: %s}\n", i, i > 1 ? "outer" : "inner");
    return fclose(file) == 0;
}

static bool is_right(const struct image *image) {
    double wanted = 0;
    for (int depth = 0; depth <= REFLECTED_DEPTH; depth++)
        wanted += ldexp(0.5, -depth);
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        const float *rgb = image->rgb + 3 * i;
        if (rgb[0] != 0 || rgb[2] != 0 || !(fabs((double)rgb[1] - wanted) < 1e-5))
            return false;
    }
    return true;
}

static void test_precision(struct picture_kit *kit, const char *path, bool is_double) {
    struct session session;
    struct shot shot = {0};
    struct image image = {0};
    struct render_statistics statistics;
    struct render_rays rays = {0};
    const struct session_options options = {.path = str_from(path), .limits = limits_default()};
    if (!write_scene(path, is_double)) {
        expect(false, "the scene is written");
        return;
    }
    session_load(&session, &options, kit->store);
    bool good = session.state == SESSION_LOADED && shot_open(&shot, &session, kit->gpu, 0) == SHOT_OK &&
                image_init(&image, SIDE, SIDE) && shot_take(&shot, &image, NULL, &statistics) == SHOT_OK;
    printf("%s precision\n", is_double ? "double" : "single");
    expect(good && session.sink.errors == 0, "no ray is given up");
    expect(good && statistics.slices > 0 && is_right(&image), "the picture is that of the innermost sphere");
    good = good && renderer_count(shot.renderer, &shot.view.camera, NULL, &rays) == RENDER_DONE;
    const uint64_t sent = (uint64_t)SIDE * SIDE * (1 + REFLECTED_DEPTH);
    expect(good && rays.primary + rays.reflected == sent && rays.shadow == sent, "each ray counts once");
    expect(good && rays.items == 2 * sent * SPHERES, "each sphere is tested once by each ray");
    image_finish(&image);
    shot_close(&shot);
    session_finish(&session);
}

int main(int argc, char **argv) {
    struct picture_kit kit;
    char path[4096];
    if (argc < 2)
        return 2;
    if (!picture_kit_open(&kit))
        return 77;
    snprintf(path, sizeof path, "%s/nested.glint.yaml", argv[1]);
    test_precision(&kit, path, false);
    if (gpu_info(kit.gpu)->has_double)
        test_precision(&kit, path, true);
    expect(picture_kit_close(&kit) == 0, "the validation layer is silent");
    return failed != 0;
}
