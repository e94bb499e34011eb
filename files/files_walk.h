// The scenes in a folder and in the folders below it.
//
// Ownership: paths go into the given arena, which must be guarded. Thread safety: pure except for the
// arena.
#ifndef GLINT_FILES_FILES_WALK_H
#define GLINT_FILES_FILES_WALK_H

#include "files/files.h"

struct files_found {
    struct arena *arena;
    const char *const *endings; // ".yaml", ...; NULL at the end; in capitals too
    struct {
        str *items;
        uint32_t count, capacity;
    } paths;        // sorted by their bytes, folder by folder
    uint32_t depth; // how many folders are open
    str unreadable; // the path that FILE_UNREADABLE is about
};

bool files_is_folder(str path);
// Whether there is a file, folder or link of this name, as far as the system tells.
bool files_exist(str path);
struct files_names {
    str *items;
    uint32_t count, capacity;
};
// The names in a folder, sorted by their bytes, except those that begin with a dot. false: errno says why it
// cannot be read.
bool files_list_folder(struct arena *arena, str folder, struct files_names *names);
// Adds the regular files below `folder` whose names have one of the endings. Names that begin with a dot are
// left out, and so are links to folders. FILE_UNREADABLE: errno says why `folder`, or something
// below it, could not be read; folders below it that this user may not open are left out.
enum file_status files_walk(struct files_found *found, str folder);

#endif
