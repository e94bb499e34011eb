#define _GNU_SOURCE // syscall, O_PATH

#include "files/door.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdint.h>
#include <string.h>
#include <sys/stat.h>
#ifdef __linux__
#include <sys/syscall.h>
#endif
#include <unistd.h>

#ifdef O_LARGEFILE
#define DOOR_FLAGS (O_CLOEXEC | O_NOCTTY | O_NONBLOCK | O_LARGEFILE)
#else
#define DOOR_FLAGS (O_CLOEXEC | O_NOCTTY | O_NONBLOCK)
#endif
#ifdef O_PATH
#define FOLDER_FLAGS (O_PATH | O_DIRECTORY | O_CLOEXEC) // a folder can be passed through without being listed
#else
#define FOLDER_FLAGS (O_RDONLY | O_DIRECTORY | O_CLOEXEC)
#endif

#ifdef __EMSCRIPTEN__

// Node opens by path only, and blocks on pipes.
int door_open(const char *canonical, int flags) {
    struct stat info;
    if (lstat(canonical, &info) != 0)
        return -1;
    if (!S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode)) {
        errno = S_ISLNK(info.st_mode) ? ELOOP : ENXIO;
        return -1;
    }
    return open(canonical, flags | O_CLOEXEC);
}

int door_folder(const char *canonical) {
    return open(canonical, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

#else

static int open_again(int folder, const char *name, int flags) {
    int fd;
    do
        fd = openat(folder, name, flags | O_NOFOLLOW);
    while (fd < 0 && errno == EINTR);
    return fd;
}

// Opens one part of the path after another, each in the folder opened before.
static int walk(const char *canonical, int flags) {
    int folder = open_again(AT_FDCWD, "/", FOLDER_FLAGS);
    const char *part = canonical + strspn(canonical, "/");
    while (folder >= 0) {
        char name[NAME_MAX + 1];
        const size_t length = strcspn(part, "/");
        const char *next = part + length + strspn(part + length, "/");
        int fd = -1;
        errno = ENAMETOOLONG;
        if (length < sizeof name) {
            memcpy(name, length ? part : ".", length ? length : 1);
            name[length ? length : 1] = '\0';
            fd = open_again(folder, name, *next ? FOLDER_FLAGS : flags);
        }
        const int error = errno;
        close(folder);
        errno = error;
        if (!*next)
            return fd;
        folder = fd;
        part = next;
    }
    return -1;
}

#ifdef __linux__
// For openat2(2), Linux 5.6, which older headers lack.
struct how {
    uint64_t flags, mode, resolve;
};
enum {
    NO_MAGIC_LINKS = 0x02,
    NO_LINKS = 0x04,
    CALL_OPENAT2 = 437, // on all processors but alpha
};

static int open_whole(const char *canonical, int flags) {
    const struct how how = {.flags = (uint64_t)flags, .resolve = NO_MAGIC_LINKS | NO_LINKS};
    long fd;
    do
        fd = syscall(CALL_OPENAT2, AT_FDCWD, canonical, &how, sizeof how);
    while (fd < 0 && errno == EINTR);
    return (int)fd;
}
#else
static int open_whole(const char *canonical, int flags) {
    (void)canonical, (void)flags;
    errno = ENOSYS;
    return -1;
}
#endif

// An old kernel does not know the call, and a container may forbid it.
static int open_canonical(const char *canonical, int flags) {
    const int fd = open_whole(canonical, flags);
    return fd < 0 && (errno == ENOSYS || errno == EPERM) ? walk(canonical, flags) : fd;
}

int door_open(const char *canonical, int flags) {
    return open_canonical(canonical, flags | DOOR_FLAGS);
}

int door_folder(const char *canonical) {
    return open_canonical(canonical, FOLDER_FLAGS);
}

#endif
