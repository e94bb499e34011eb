#include "load/session_kept.h"

#include "assets/assets.h"
#include "core/heap.h"
#include "parser/parser.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

struct session_kept {
    _Atomic uint32_t holders;
    struct session_options options; // as they were given
    struct session text;
};

struct session_kept *session_keep(const struct session_options *options) {
    if (options->overlay_count || options->text_only || options->unnamed ||
        assets_is_mesh_path(options->path))
        return NULL;
    struct session_kept *kept = heap_zeroed(1, sizeof *kept);
    if (!kept)
        return NULL;
    kept->options = *options;
    kept->holders = 1;
    session_load_kept(&kept->text, options);
    if (kept->text.parser)
        return kept;
    session_kept_release(kept);
    return NULL;
}

bool session_kept_fits(const struct session_kept *kept, const struct session_options *options) {
    const struct session_options *own = &kept->options;
    return str_equal(own->path, options->path) && str_equal(own->found_in, options->found_in) &&
           str_equal(own->named_in, options->named_in) && own->names_scene == options->names_scene &&
           own->asset_paths == options->asset_paths && own->asset_path_count == options->asset_path_count &&
           own->named_asset_path_count == options->named_asset_path_count &&
           own->overlay_count == options->overlay_count && own->policy == options->policy &&
           own->judged == options->judged && own->text_only == options->text_only &&
           own->unnamed == options->unnamed &&
           memcmp(&own->limits, &options->limits, sizeof own->limits) == 0 &&
           files_are_same(&kept->text.files);
}

void session_kept_hold(struct session_kept *kept) {
    kept->holders++;
}

void session_kept_release(struct session_kept *kept) {
    if (!kept || --kept->holders > 0)
        return;
    parser_drop(kept->text.parser);
    session_finish(&kept->text);
    free(kept);
}

const struct session *session_kept_text(const struct session_kept *kept) {
    return &kept->text;
}
