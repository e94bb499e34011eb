#include "files/folder.h"

#include "core/heap.h"
#include "files/door.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

DIR *folder_open(const char *path) {
    DIR *folder = opendir(path);
    if (!folder && errno == ENOMEM)
        heap_exhausted(0);
    return folder;
}

DIR *folder_behind(const char *canonical) {
    const int fd = door_open(canonical, O_RDONLY | O_DIRECTORY);
    DIR *folder = fd < 0 ? NULL : fdopendir(fd);
    if (!folder && errno == ENOMEM)
        heap_exhausted(0);
    if (!folder && fd >= 0)
        close(fd);
    return folder;
}

struct dirent *folder_next(DIR *folder) {
    errno = 0;
    return readdir(folder);
}
