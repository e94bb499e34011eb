// Making the changes that diagnostics propose (struct diag: fix_at, fix_text), in the scene and the files it
// includes.
//
// Rounds: check, make all changes that do not touch one another, check again, until none is left or none
// helps. A file gets all of its changes or none: none where its text could not be read to its end afterwards,
// or where a change did not take its finding away. Nothing is written here. Ownership: fixes_finish frees
// everything. Errors: `failed` tells that memory ended. Thread safety: one call belongs to one thread; the
// store too.
#ifndef GLINT_APP_FIXES_H
#define GLINT_APP_FIXES_H

#include "app/session.h"

enum fix_level {
    FIX_NONE,
    FIX_SAFE, // what can only be meant so
    FIX_ALL,  // suggestions too
};

struct fixed_file {
    str path;      // as it is shown
    str canonical; // absolute, links resolved
    str before;
    str text; // equal to `before`: nothing is to be written
    uint32_t changes;
    bool refused;
};

struct fixes {
    struct arena arena;
    struct {
        struct fixed_file *items;
        uint32_t count, capacity;
    } files;
    bool failed;
};

void fixes_make(struct fixes *fixes, const struct session_options *options, enum fix_level level,
                struct asset_store *store);
void fixes_finish(struct fixes *fixes);

#endif
