// Which scenes a change of files can have broken: those that read one of them.
//
// Ownership: in the arena given to changed_init, which must be guarded while files are added. Thread safety:
// once all are added it may be asked by many threads.
#ifndef GLINT_APP_CHANGED_H
#define GLINT_APP_CHANGED_H

#include "app/session.h"
#include "core/str_map.h"

struct changed_list {
    str *items;
    uint32_t count, capacity;
};

struct changed {
    struct arena *arena;
    struct files files;
    struct str_map paths;        // of files that are there, links resolved
    struct changed_list folders; // links and submodules: all below them changed
    struct changed_list gone;    // absolute, of files that are not there any more
};

void changed_init(struct changed *changed, struct arena *arena);
// Adds a file that changed, was added, or is no longer there.
void changed_add(struct changed *changed, str path);
// Whether the scene reads one of them. `session` is loaded as `glint deps` loads it (session_load, images
// without their pixels). A scene whose files cannot all be known counts: it, or what it names, cannot be
// read. So does one that names a file of the same name as one that is gone, because another may now be in its
// place.
bool changed_affects(const struct changed *changed, struct session *session);

#endif
