// The scene that a glTF file is by itself, as text: what `glint render file.glb` loads, with the materials
// left in the file.
//
// Output: appended to `text`. Errors: false where the file cannot be read; loading it as a mesh reports why.
// Losses of lights are reported to the input's sink. Thread safety: one thread.
#ifndef GLINT_LOAD_IMPORT_SCENE_TEXT_H
#define GLINT_LOAD_IMPORT_SCENE_TEXT_H

#include "core/strbuf.h"
#include "load/import/import.h"

// What a scene is made from besides the file. The arena of `input` must be guarded.
struct import_source {
    const struct assets_input *input;
    struct asset_store *store;
    struct assets *assets; // takes what is used from the store: call assets_finish, also if memory runs out
    int32_t width, height; // of the picture; 0: the default
};
// The scene around an open file that lacks a camera or lights; NULL: it needs none, or has none.
const struct ir_scene *import_around(const struct import_source *source,
                                     const struct gltf_document *document);

bool import_scene_text(const struct import_source *source, str path, struct strbuf *text);

#endif
