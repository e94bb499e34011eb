// Every file that a loaded scene reads, and where it is named: for `glint deps` and `glint pack`.
//
// Ownership: the inventory is in the session's arena and lives as long as the session.
// Thread safety: the session's thread.
#ifndef GLINT_LOAD_INVENTORY_H
#define GLINT_LOAD_INVENTORY_H

#include "load/session.h"

enum inventory_role {
    INVENTORY_SCENE,     // the file on the command line
    INVENTORY_INCLUDE,   // a scene file that another includes
    INVENTORY_MESH,      // what a model names
    INVENTORY_MATERIALS, // what a mesh names
    INVENTORY_IMAGE,     // the background
    INVENTORY_FONT,      // what a text is written in
    INVENTORY_SETTINGS,  // .glintrc.yaml
    INVENTORY_ROLES,
};

// A file at a place that names it.
struct inventory_use {
    enum inventory_role role;
    str named;     // as it is written there; empty if it is not written
    str path;      // to open
    str canonical; // absolute, links resolved: equal for two uses of one file
    uint64_t size_bytes;
    span at;             // in a scene file or option; SPAN_NONE: it is not named by a scene
    str named_in;        // the mesh that names a material file; else empty
    uint32_t named_line; // in named_in
};

struct inventory {
    struct inventory_use *items; // the scene first, then includes, then the others in the order of loading
    uint32_t count, capacity;
};

// "scene", "include", "mesh", "materials", "image", "font", "settings".
const char *inventory_role_name(enum inventory_role role);
// false: no memory. A file that could not be found is not in it: the session's sink names it.
bool inventory_make(struct session *session, struct inventory *out);
// Whether an earlier use is of the same file.
bool inventory_is_repeat(const struct inventory *inventory, uint32_t use);

#endif
