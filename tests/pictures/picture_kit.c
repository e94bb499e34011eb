#include "picture_kit.h"

#include "diag/diag_text.h"
#include "grammar/ir.h"
#include "render/reference_shot.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool open_kit(struct picture_kit *kit, bool storage) {
    char error[GPU_ERROR_BYTES] = "";
    const char *device = getenv("GLINT_DEVICE");
    *kit = (struct picture_kit){.by_reference = device && strcmp(device, "reference") == 0};
    kit->store = asset_store_create();
    if (kit->by_reference)
        return kit->store != NULL;
    struct gpu_options options = {.device = device,
                                  .storage = storage,
                                  .validate = true,
                                  .validation_messages = &kit->validation_messages};
    enum gpu_status status = gpu_create(&options, &kit->gpu, error);
    if (status != GPU_OK) {
        fprintf(stderr, "skipped: %s\n", error);
        asset_store_destroy(kit->store);
        return false;
    }
    return kit->store != NULL;
}

bool picture_kit_open(struct picture_kit *kit) {
    return open_kit(kit, false);
}

bool picture_kit_open_as_gpu(struct picture_kit *kit) {
    return open_kit(kit, true);
}

uint32_t picture_kit_close(struct picture_kit *kit) {
    gpu_destroy(kit->gpu);
    asset_store_destroy(kit->store);
    return kit->validation_messages;
}

static void print_diagnostics(struct session *session) {
    struct strbuf text;
    strbuf_init(&text);
    diag_text(&text, &session->sink, &session->sources, (struct diag_text_options){.most = 5});
    fprintf(stderr, "%.*s", STR_ARG(strbuf_view(&text)));
    strbuf_finish(&text);
}

static bool apply_options(struct shot *shot, const struct picture_options *options) {
    if (!options->more_features && !options->has_slices)
        return true;
    shot->settings.features |= options->more_features;
    if (options->has_slices)
        shot->settings.slice_iterations = options->slice_iterations;
    renderer_destroy(shot->renderer);
    shot->renderer = renderer_create(shot->gpu, &shot->flat, &shot->settings);
    return shot->renderer != NULL;
}

static bool take(struct picture_kit *kit, struct session *session, const struct picture_options *options,
                 struct image *image) {
    struct shot shot;
    struct render_statistics statistics;
    enum shot_status status = shot_open(&shot, session, kit->gpu, 0);
    bool good = status == SHOT_OK && apply_options(&shot, options) &&
                image_init(image, shot.settings.width, shot.settings.height) &&
                shot_take(&shot, image, NULL, &statistics) == SHOT_OK && session->sink.errors == 0;
    if (!good)
        fprintf(stderr, "%.*s: %s\n", STR_ARG(session->options.path), gpu_error(kit->gpu));
    if (options->was_double)
        *options->was_double = shot.flat.is_double;
    shot_close(&shot);
    return good;
}

static bool take_by_reference(struct session *session, struct image *image) {
    struct reference_shot shot;
    struct reference_statistics statistics;
    struct reference_shot_options options = {.as_file = true, .no_cache = true};
    bool good = reference_shot_open(&shot, session, 0, options) == SHOT_OK &&
                image_init(image, shot.settings.width, shot.settings.height) &&
                reference_shot_take(&shot, image, NULL, NULL, &statistics) == SHOT_OK &&
                session->sink.errors == 0;
    reference_shot_close(&shot);
    return good;
}

// The assets hold copies of the scene's materials, in the same order.
static void edit_scene(struct session *session, const struct picture_options *options) {
    const struct ir_materials *materials = &session->scene->materials;
    options->edit(session->scene, options->context);
    if (materials->count)
        memcpy(session->assets.materials, materials->items, materials->count * sizeof *materials->items);
    scene_build(session->scene, &session->assets, &session->arena, &session->resolved);
}

bool picture_take(struct picture_kit *kit, const char *path, const struct picture_options *options,
                  struct image *image) {
    struct session session;
    str asset_path = str_from(options->asset_path);
    struct session_options scene = {.path = str_from(path),
                                    .asset_paths = &asset_path,
                                    .asset_path_count = options->asset_path ? 1 : 0,
                                    .limits = limits_default(),
                                    .width = options->width,
                                    .height = options->height,
                                    .samples = options->samples};
    *image = (struct image){0};
    session_load(&session, &scene, kit->store);
    bool good = session.state == SESSION_LOADED && session.sink.errors == 0;
    if (good && options->edit)
        edit_scene(&session, options);
    good = good &&
           (kit->by_reference ? take_by_reference(&session, image) : take(kit, &session, options, image));
    if (!good)
        print_diagnostics(&session);
    session_finish(&session);
    return good;
}

int64_t picture_differences(const struct image *a, const struct image *b, const char *what) {
    int64_t count = 0;
    if (a->width != b->width || a->height != b->height)
        return -1;
    for (size_t i = 0; i < (size_t)a->width * a->height; i++) {
        if (memcmp(a->rgb + 3 * i, b->rgb + 3 * i, 3 * sizeof(float)) == 0)
            continue;
        if (count++ == 0)
            fprintf(stderr, "%s: pixel %zu,%zu is %.9g %.9g %.9g, then %.9g %.9g %.9g\n", what, i % a->width,
                    i / a->width, (double)a->rgb[3 * i], (double)a->rgb[3 * i + 1], (double)a->rgb[3 * i + 2],
                    (double)b->rgb[3 * i], (double)b->rgb[3 * i + 1], (double)b->rgb[3 * i + 2]);
    }
    if (count)
        fprintf(stderr, "%s: %lld of %zu pixels differ\n", what, (long long)count,
                (size_t)a->width * a->height);
    return count;
}

uint64_t picture_variety(const struct image *image) {
    uint64_t count = 0;
    for (size_t i = 1; i < (size_t)image->width * image->height; i++)
        count += memcmp(image->rgb, image->rgb + 3 * i, 3 * sizeof(float)) != 0;
    return count;
}

const char *picture_seed_folder(void) {
    static char folder[1024];
    const char *assets = getenv("GLINT_ASSETS");
    struct stat info;
    snprintf(folder, sizeof folder, "%s/seed", assets ? assets : "../shared/assets");
    return stat(folder, &info) == 0 && S_ISDIR(info.st_mode) ? folder : NULL;
}
