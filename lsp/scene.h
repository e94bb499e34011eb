// The scenes that the open documents belong to, each loaded as `glint check` loads it, with the editor's
// texts in place of the files.
//
// A document that another scene includes is checked as a part of that scene, not by itself, because it would
// lack what the others define. Candidates for scenes are open documents, and scene files beside the document
// or in the folders above it, up to the scene's root.
// A document counts as a scene by its name (`*.glint.*`) or by its text, so that other YAML and XML files are
// ignored; `.glintrc.yaml` is checked as settings.
// Ownership: scenes_finish frees all. Thread safety: one thread.
#ifndef GLINT_LSP_SCENE_H
#define GLINT_LSP_SCENE_H

#include "load/session.h"
#include "lsp/document.h"

struct lsp_scene {
    struct arena arena; // for what belongs to the scene but to no load of it
    str path;           // of the main file, canonical
    struct session session;
    bool loaded;         // the session must be finished
    bool is_fresh;       // it was loaded since scenes_refresh last reported changes
    bool is_stale;       // a text has changed since it was loaded
    bool is_wanted;      // an open document is its main file, or belongs to it
    bool lacks_lint;     // the rules about light did not run at the last load
    bool lacks_pixels;   // an image's pixels have not been decoded since it changed
    double lint_seconds; // that these rules took in their last run
    str *files;          // canonical, of the main file and its includes, from the last load that got that far
    uint32_t file_count;
    json_t *names;     // by element: its names when the text last had no syntax errors
    json_t *arguments; // by object, at the same time: its parameters' names, values and descriptions
};

struct scenes {
    struct asset_store *store;
    struct documents *documents;
    struct session_options settings; // of every session: limits, folders, policy
    struct lsp_scene **items;
    uint32_t count, capacity;
};

void scenes_init(struct scenes *scenes, struct documents *documents, const struct session_options *settings);
void scenes_finish(struct scenes *scenes);
// Marks the scenes that changed text may affect; all of them if `path` is empty.
void scenes_touch(struct scenes *scenes, str path);

// Whether SCENES_WHOLE would have something to add.
bool scenes_are_partial(const struct scenes *scenes);
bool lsp_scene_lacks(const struct lsp_scene *scene);
// The scene that the document at `path` belongs to, up to date, or NULL.
struct lsp_scene *scenes_of(struct scenes *scenes, str path);
// The scene with this main file; added if it is new. NULL: no memory.
struct lsp_scene *scenes_add(struct scenes *scenes, str path);
struct lsp_scene *scenes_find(struct scenes *scenes, str path);
void scenes_forget(struct scenes *scenes, struct lsp_scene *scene);
void lsp_scene_unload(struct lsp_scene *scene);
bool lsp_scene_has_file(const struct lsp_scene *scene, str path);
// Takes the list of files from a loaded session.
void lsp_scene_note_files(struct lsp_scene *scene, struct session *session);
void lsp_scene_forget_files(struct lsp_scene *scene);
// The text of the open documents, for session_options; the caller frees it. NULL: no memory.
struct file_overlay *scenes_overlays(const struct scenes *scenes);

// ---- scene_find.c: which scene a document belongs to

// Searches for scenes around the document that include it, once each time it is opened, and adds them.
void scenes_place(struct scenes *scenes, struct document *document);
bool scenes_is_settings(str path);
// Whether the document must be checked as a scene.
bool scenes_is_scene(struct document *document);

// ---- scene_refresh.c

enum scenes_effort {
    SCENES_QUICK, // without the rules about light, if they took long last time, and without the pixels of new
                  // or changed images
    SCENES_WHOLE,
};
// Decides which scenes the open documents belong to, and loads those that are stale or lack what `effort`
// asks for. Scenes that no open document needs are dropped. Returns whether anything has changed.
bool scenes_refresh(struct scenes *scenes, enum scenes_effort effort);

#endif
