// A scene with all its files in one folder or ZIP archive, to be rendered elsewhere.
//
// The scene file is at the top under its own name, what it includes in includes/, meshes with their material
// files in meshes/, the background in images/; of two files with the same name the second goes to meshes-2/
// and so on. A mesh by itself is packed with the scene around it, which has the mesh's name and ends in
// .glint.yaml. Paths in scene files are rewritten in place: no other byte of any file is changed. Limits that
// were raised go into settings for --config (limits.yaml). Before it gets its name, the packed scene is
// loaded and compared: same meaning, same files. Thread safety: the session's thread.
#ifndef GLINT_EDIT_PACK_PACK_H
#define GLINT_EDIT_PACK_PACK_H

#include "load/inventory.h"
#include "load/session.h"

// A file of the package.
struct pack_file {
    str target;    // relative to the package, with '/'
    str path;      // where its bytes are; empty: they are `text`
    str canonical; // of the file it is made from
    str text;
};

struct pack_plan {
    const struct inventory *inventory; // of the scene
    struct pack_file *items;           // the scene first
    uint32_t count, capacity;
    str limits; // the target of the raised limits; empty: there are none
};

enum pack_status {
    PACK_OK,
    PACK_SCENE,  // the session's sink says why it cannot be packed
    PACK_OUTPUT, // pack_error.text says what could not be written
    PACK_STOPPED,
};

struct pack_error {
    char text[512];
};

// Where each file goes, and the rewritten scene files. `session` has been loaded without errors. The plan is
// in the session's arena and keeps the inventory. PACK_OK or PACK_SCENE.
enum pack_status pack_make_plan(struct session *session, const struct inventory *inventory,
                                struct pack_plan *plan);
// Writes the plan to `out`: a ZIP archive if it ends in .zip, else a new or empty folder. All or nothing;
// also nothing once `is_stopped` returns true. NULL: it never does.
typedef bool pack_is_stopped(void);
enum pack_status pack_write(struct session *session, const struct pack_plan *plan, const char *out,
                            pack_is_stopped *is_stopped, struct pack_error *error);

// Writes the files of `folder` that the plan names to a ZIP archive: stored in the plan's order, with one
// fixed time, so that equal scenes make equal archives. false: *error has the text.
bool pack_zip(const struct pack_plan *plan, const char *folder, const char *out, pack_is_stopped *is_stopped,
              struct pack_error *error);

#endif
