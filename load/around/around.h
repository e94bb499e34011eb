// A mesh that is rendered by itself: the scene around it, which nobody wrote.
//
// The mesh stands on a floor that fills the picture, under one soft light from the left and some from
// everywhere, seen from the front, a little from the right and from above, as large as it can be with a
// margin. It is smooth if its file has normals, or if nearly everywhere its faces meet at small angles, as
// those of scans do and those of machine parts do not. A mesh in a format whose programs point z upwards is
// turned. It keeps the materials that its file gives it. Numbers are rounded, so that people can edit the
// scene.
//
// Input: a mesh that was loaded. Output: a scene whose rows are marked as written, for grammar/print/.
// Errors: false for a mesh that is a point, or too large for a scene around it. Ownership: lists in the
// arena, which must be guarded; names are the caller's. Units: those of the mesh. Thread safety: that of the
// arena.
#ifndef GLINT_LOAD_AROUND_AROUND_H
#define GLINT_LOAD_AROUND_AROUND_H

#include "assets/assets.h"

struct ir_scene;

struct around_input {
    str name; // of the mesh file, as the scene is to name it
    const struct mesh *mesh;
    int32_t width, height; // of the picture; 0: the default
    struct arena *arena;
};

bool around_mesh(const struct around_input *input, struct ir_scene *out);

// The scene around the mesh file at `path`. The mesh is read into the store, where loading the scene finds it
// again. false: the mesh cannot be read (loading the scene reports it), or no scene fits around it. `input`
// is the session's, without a scene; its arena must be guarded. *assets holds what was taken from the store:
// call assets_finish, also if memory runs out.
bool around_scene(struct asset_store *store, const struct assets_input *input, str path, int32_t width,
                  int32_t height, struct assets *assets, struct ir_scene *out);

// The same, as the text of a scene file beside the mesh at `path`; empty if there is none.
str around_text(struct asset_store *store, const struct assets_input *input, str path, int32_t width,
                int32_t height, struct assets *assets);

#endif
