// A scene as tracers show it that do not know what a ray is inside: each surface has air on its other side,
// wherever it is, and nothing is coloured inside. For tests, and for the page that shows what media are for
// (docs/language.md).
//
// Usage: alone SCENE OUT.pfm|OUT.png [FOLDER_WITH_MESHES]: by the reference, which obeys the file, at the
// scene's size. Ends with 1 where that fails, and with 2 for other arguments.
#include "core/strbuf.h"
#include "files/output.h"
#include "grammar/ir.h"
#include "reference/reference_internal.h"
#include "render/reference_shot.h"

#include <stdio.h>
#include <stdlib.h>

// The scene through its first camera.
static bool draw(struct session *session, struct image *image) {
    struct reference_shot shot;
    struct reference_statistics statistics;
    const struct reference_shot_options options = {.as_file = true, .no_cache = true};
    bool good = reference_shot_open(&shot, session, 0, options) == SHOT_OK &&
                image_init(image, shot.settings.width, shot.settings.height) &&
                reference_source_get(&shot.source);
    if (good) {
        shot.source.reference->media = false;
        good = reference_shot_take(&shot, image, NULL, NULL, &statistics) == SHOT_OK;
    }
    reference_shot_close(&shot);
    return good && session->sink.errors == 0;
}

static bool write(const struct session *session, const struct image *image, const char *path) {
    const struct image_display display = image_display_of(session->image);
    enum image_format format;
    struct strbuf bytes;
    if (!image_format_of_path(str_from(path), IMAGE_WRITTEN, &format))
        return false;
    strbuf_init(&bytes);
    image_encode(image, format, display, &bytes);
    const bool good = !bytes.failed && output_whole(path, bytes.data, bytes.len) == 0;
    strbuf_finish(&bytes);
    return good;
}

int main(int argc, char **argv) {
    if (argc != 3 && argc != 4)
        return 2;
    struct session session;
    struct image image = {0};
    struct asset_store *store = asset_store_create();
    str folder = str_from(argc == 4 ? argv[3] : "");
    const struct session_options options = {.path = str_from(argv[1]),
                                            .asset_paths = &folder,
                                            .asset_path_count = argc == 4,
                                            .limits = limits_default()};
    session_load(&session, &options, store);
    bool good = session.state == SESSION_LOADED && session.sink.errors == 0;
    good = good && draw(&session, &image) && write(&session, &image, argv[2]);
    if (!good)
        fprintf(stderr, "alone: '%s' cannot be drawn into '%s'\n", argv[1], argv[2]);
    image_finish(&image);
    session_finish(&session);
    asset_store_destroy(store);
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
