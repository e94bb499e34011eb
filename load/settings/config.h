// The settings of a folder: `.glintrc.yaml`, the nearest one at or above a scene's folder.
//
//     asset_paths: [textures]          # folders below this file's own, searched too
//     severity: {W401: error, N6xx: off}
//     ignore: [N401, "drafts/**"]      # codes and paths
//     only: [W4xx]
//     fail_on: warning
//     max_messages: 20
//     limits: {mesh-bytes: 1000000}
//
// An empty file only marks its folder as the root. A file that lies beside the scenes may only lower limits:
// whoever wrote the scenes may have written it. One that the runner names may raise them. Mistakes are
// reported at their place, and the rest is used. Ownership: everything is in the given arena, which must be
// guarded. Thread safety: one call belongs to one thread.
#ifndef GLINT_LOAD_SETTINGS_CONFIG_H
#define GLINT_LOAD_SETTINGS_CONFIG_H

#include "core/limits.h"
#include "diag/diag_policy.h"
#include "diag/source.h"
#include "files/files.h"

struct config {
    str path; // empty: there is none
    struct {
        str *items;
        uint32_t count, capacity;
    } asset_paths; // absolute
    struct diag_policy policy;
    struct limits limits; // those that are set
};

struct config_input {
    struct files *files;
    struct source_set *sources;
    struct diag_sink *sink;
    struct arena *arena;
    const struct limits
        *runner; // the limits that whoever runs glint has set; NULL: the file is the runner's own
};

// Takes the settings from a source that is in the set; `path` is absolute, for the folders in it.
void config_read(const struct config_input *input, uint32_t source, str path, struct config *config);
// Reads the settings at `path`, absolute or not; diagnostics call the file `shown`.
void config_read_file(const struct config_input *input, str path, str shown, struct config *config);
// Finds and reads the configuration of a scene; a zeroed config if there is none.
void config_load(const struct config_input *input, str scene_path, struct config *config);

#endif
