// The scenes that the open documents belong to, each loaded as `glint check` loads it, with the editor's
// texts in place of the files.
//
// A document that another scene includes is checked as a part of that scene, and not by itself: alone it
// would lack what the others define. Among scenes count open documents, and scene files beside the document
// or in the folders above it, up to the scene's root.
// Ownership: scenes_finish frees all. Thread safety: one thread.
#ifndef GLINT_LSP_SCENE_H
#define GLINT_LSP_SCENE_H

#include "app/session.h"
#include "lsp/document.h"

struct lsp_scene {
    struct arena arena; // for what belongs to the scene but to no load of it
    str path;           // of the main file, canonical
    struct session session;
    bool loaded;    // the session is to be finished
    bool is_fresh;  // it was loaded since scenes_refresh last said so
    bool is_stale;  // a text has changed since it was loaded
    bool is_wanted; // an open document is its main file, or belongs to it
    str *files;     // canonical, of the main file and its includes as of the last load that got so far
    uint32_t file_count;
};

struct scenes {
    struct asset_store *store;
    struct documents *documents;
    struct limits limits;
    struct lsp_scene **items;
    uint32_t count, capacity;
};

void scenes_init(struct scenes *scenes, struct documents *documents);
void scenes_finish(struct scenes *scenes);
// Marks all scenes: some text has changed.
void scenes_touch(struct scenes *scenes);
// Decides which scenes the open documents belong to, and loads those that are stale. Scenes that no open
// document needs any more are forgotten. Whether anything has changed.
bool scenes_refresh(struct scenes *scenes);
// The scene that the document at `path` belongs to, up to date, or NULL.
struct lsp_scene *scenes_of(struct scenes *scenes, str path);

#endif
