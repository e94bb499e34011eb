// The entries of a folder, read one by one.
//
// Ownership: closedir closes. Errors: errno; lack of memory is reported as core/heap.h does, not as an
// unreadable folder. Thread safety: a folder belongs to one thread.
#ifndef GLINT_FILES_FOLDER_H
#define GLINT_FILES_FOLDER_H

#include <dirent.h>

// NULL: errno says why.
DIR *folder_open(const char *path);
// The same through the door (door.h): its path is canonical.
DIR *folder_behind(const char *canonical);
// NULL: there are no more, or, if errno is not 0, they could not be read.
struct dirent *folder_next(DIR *folder);

#endif
