#include "files/folder.h"

#include "core/heap.h"

#include <errno.h>

DIR *folder_open(const char *path) {
    DIR *folder = opendir(path);
    if (!folder && errno == ENOMEM)
        heap_exhausted(0);
    return folder;
}

struct dirent *folder_next(DIR *folder) {
    errno = 0;
    return readdir(folder);
}
