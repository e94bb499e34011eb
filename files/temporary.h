// Files and folders that exist only until a work is complete, known to one list, so that a program which must
// end at once leaves none behind.
//
// `temporary_remove_all` needs no memory from the system: it may be called where there is none left.
// Ownership: the entry and its path are the caller's and stay where they are until temporary_forget.
// Errors: what cannot be removed stays; see temporary_remove. Thread safety: all calls are safe on any
// thread.
#ifndef GLINT_FILES_TEMPORARY_H
#define GLINT_FILES_TEMPORARY_H

#include <stdbool.h>

struct temporary {
    const char *path;
    struct temporary *next;
};

void temporary_note(struct temporary *entry, const char *path);
// Makes a new file for writing and notes it, in one step for a thread that ends the process. -1: errno says
// why; nothing is noted. The file is `name` in the open folder (AT_FDCWD: `name` is a path); `path` is its
// whole path.
int temporary_create(struct temporary *entry, int folder, const char *name, const char *path);
// Does nothing for an entry that is not noted.
void temporary_forget(struct temporary *entry);
// Removes a file, or a folder with all that is in it; links are removed, not followed. false: errno says why
// something is left.
bool temporary_remove(const char *path);
// Call it before the process ends: afterwards, threads that note or create an entry wait forever.
void temporary_remove_all(void);

#endif
