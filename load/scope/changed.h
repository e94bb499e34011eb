// Which scenes a change of files can have broken: those that read one of them.
//
// Ownership: in the arena given to changed_init, which must be guarded while files are added. Thread safety:
// once all are added it may be asked by many threads.
#ifndef GLINT_LOAD_SCOPE_CHANGED_H
#define GLINT_LOAD_SCOPE_CHANGED_H

#include "core/str_map.h"
#include "load/session.h"

struct changed_list {
    str *items;
    uint32_t count, capacity;
};

struct changed {
    struct arena *arena;
    struct files files;
    struct str_map paths;         // of files that are there, links resolved
    struct changed_list folders;  // links and submodules: all below them changed
    struct changed_list gone;     // absolute, of files that are not there any more
    struct changed_list named;    // existing files that operands name, as they name them
    struct changed_list searched; // the folders to look for scenes in, as a user would write them
    bool names_folders;           // operands name these; else it is the root
    str why;                      // where changed_find failed
    int operand;                  // index of the operand that `why` is about; -1: none
};

void changed_init(struct changed *changed, struct arena *arena);
// Adds a file that changed, was added, or is no longer there.
void changed_add(struct changed *changed, str path);
// Applies the operands of --changed. Folders are searched. Files count as changed, and so does all that git
// says differs from a revision, if one is named, or from HEAD if no file is named either. The first operand
// is a revision if no file has its name. If no folder is named, the repository is searched or, if git is not
// asked, everything below the root of a scene in the current folder. false: git cannot tell what changed
// (changed->why, changed->operand).
bool changed_find(struct changed *changed, char *const *operands, int count);
// Whether a file is one of them.
bool changed_holds(const struct changed *changed, str canonical);
// Whether the scene reads one of them. `session` is loaded as `glint deps` loads it (session_load, images
// without their pixels). A scene whose files cannot all be known counts: it, or what it names, cannot be
// read. So does one that names a file of the same name as one that is gone, because another may now be in its
// place.
bool changed_affects(const struct changed *changed, struct session *session);

#endif
