// The means to find and read the files of a scene (sources, limits, the sink), and the list of those found.
//
// Ownership: the caller's. Thread safety: one thread loads.
#ifndef GLINT_ASSETS_FILE_ASSET_INPUT_H
#define GLINT_ASSETS_FILE_ASSET_INPUT_H

#include "core/limits.h"
#include "diag/diag.h"
#include "files/files.h"
#include "grammar/ir_origin.h"

struct ir_scene;
struct timeline;

// A file that was found under a name, one for each place that names it: what `deps` and `pack` list.
struct asset_use {
    const char *what; // "mesh", "material file", "image"
    str named;        // as it is written there
    str path;         // to open
    str canonical;    // absolute, links resolved
    uint64_t size_bytes;
    span at;      // where the scene names it, or the mesh that names it
    str named_in; // the mesh that names it, to open; empty: the scene
    uint32_t named_line;
};
struct asset_uses {
    struct asset_use *items;
    uint32_t count, capacity;
};

struct assets_input {
    const struct ir_scene *scene;
    const struct ir_origin *origin;
    struct source_set *sources;
    struct files *files;
    const struct limits *limits;
    struct diag_sink *sink;
    struct arena *arena;       // for data that belongs to this scene; guarded by the caller
    struct asset_uses *uses;   // the uses of the assets being loaded; set by assets_load
    bool pixels_later;         // kept pixels may still be decoding when assets_load returns
    struct timeline *timeline; // may be NULL
};

#endif
