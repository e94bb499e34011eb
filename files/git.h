// What git says of the current folder's repository: the one place that starts another program.
//
// Ownership: paths are in the given arena, which must be guarded. Errors: `why` says in words what git, or
// the system, answered. Thread safety: one thread at a time.
#ifndef GLINT_FILES_GIT_H
#define GLINT_FILES_GIT_H

#include "core/arena.h"
#include "core/str.h"

struct git_changes {
    str top; // of the repository, absolute
    struct {
        str *items;
        uint32_t count, capacity;
    } paths; // absolute; deleted files, both names of renamed ones, and files that git does not track yet too
    str why; // why it failed
};

// From now on the repository is untrusted: git starts no program that its settings or attributes name (a
// monitor, a hook, a filter, a diff program of its own, another transport), writes nothing, and gets only so
// much time and memory. What git cannot compare without them counts as changed: submodules, and files that
// only a filter of the repository would show to be the same.
void git_distrust(unsigned seconds, uint64_t memory_bytes);
// All that differs between the commit that `revision` names and the files as they are now. HEAD of a
// repository without a commit is empty. false: changes->why.
bool git_changed_since(struct git_changes *changes, struct arena *arena, str revision);

#endif
