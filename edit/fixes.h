// Making the changes that diagnostics propose (struct diag: fix_at, fix_text), in the scene and the files it
// includes.
//
// Rounds: check, make all changes that do not touch each other, check again, until no change is left or none
// helps. A file gets all of its changes or none: none if its text could then not be read to the end, or if a
// change did not remove its finding. Nothing is written here. Ownership: fixes_finish frees everything.
// Errors: `failed` is set when memory runs out. Thread safety: one call belongs to one thread; so does the
// store.
#ifndef GLINT_EDIT_FIXES_H
#define GLINT_EDIT_FIXES_H

#include "load/session.h"

enum fix_level {
    FIX_NONE,
    FIX_SAFE, // changes with only one possible meaning
    FIX_ALL,  // suggestions too
};

struct fixed_file {
    str path;      // as it is shown
    str canonical; // absolute, links resolved
    str before;
    str text; // equal to `before`: nothing must be written
    uint32_t changes;
    bool refused;
    bool is_new; // there was no such file
};

struct fixes {
    struct arena arena;
    struct {
        struct fixed_file *items;
        uint32_t count, capacity;
    } files;
    bool failed;
    str unreadable; // why the system could not read the scene, which has no fixes then; else empty
};

void fixes_make(struct fixes *fixes, const struct session_options *options, enum fix_level level,
                struct asset_store *store);
void fixes_finish(struct fixes *fixes);

#endif
