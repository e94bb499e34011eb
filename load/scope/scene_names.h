// The scenes of a folder are the files whose names say so. A scene with another name would be left out and
// nobody would know, so those that begin as scenes do are found too.
//
// Ownership: in the given arena, which must be guarded. Thread safety: once found, many threads may note what
// their sessions read.
#ifndef GLINT_LOAD_SCOPE_SCENE_NAMES_H
#define GLINT_LOAD_SCOPE_SCENE_NAMES_H

#include "core/str_map.h"
#include "files/files_walk.h"
#include "load/session.h"

#include <stdatomic.h>

#define SCENE_NAMES_HELP "in a folder, the files named *.glint.yaml, *.glint.yml and *.glint.xml are scenes"

extern const char *const scene_name_endings[]; // NULL at the end
// Whether a file of this name is a scene wherever it is found.
bool scene_name_fits(str path);

struct scene_other {
    str path;
    str folder; // that was searched; empty: the user named it
};

struct scene_names {
    struct {
        str *items;
        uint32_t count, capacity;
    } paths; // of scenes, sorted by their bytes, folder by folder
    struct {
        struct scene_other *items;
        uint32_t count, capacity;
    } others;             // that begin as scenes do
    struct str_map known; // by path with links resolved: 1 + index in `others`
    _Atomic bool *read;   // by number in `others`: a scene reads it
    str unreadable;       // what FILE_UNREADABLE is about
};

// Adds what is in a folder and below it, as files_walk finds it.
enum file_status scene_names_find(struct scene_names *names, struct arena *arena, str folder);
// Adds a file that the user named, if it begins as a scene does.
void scene_names_add(struct scene_names *names, struct arena *arena, str path);
// What a scene reads is not a scene that was forgotten. Call scene_names_end once all folders were searched.
void scene_names_end(struct scene_names *names, struct arena *arena);
void scene_names_note(struct scene_names *names, const struct session *session);
// "there is no scene in": some of those that begin as scenes do, and what to do; for a help line.
str scene_names_advice(const struct scene_names *names, struct arena *arena);

#endif
