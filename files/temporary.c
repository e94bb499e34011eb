#define _GNU_SOURCE // syscall, DT_DIR; getdents64 needs no memory, opendir does

#include "files/temporary.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#ifndef __EMSCRIPTEN__
#include <sys/syscall.h>
#endif
#include <unistd.h>

enum {
    LIST_BYTES = 4096,
    DEPTH_MAX = 64, // as deep as folders of scenes are followed
};

// The list belongs to the process, as the files do.
static struct temporary *noted;
static atomic_flag locked = ATOMIC_FLAG_INIT;

// Held for a few steps, or until the program ends; no memory is asked for meanwhile.
static void lock(void) {
    while (atomic_flag_test_and_set(&locked))
        ;
}

static void unlock(void) {
    atomic_flag_clear(&locked);
}

// The lock is held.
static void note(struct temporary *entry, const char *path) {
    *entry = (struct temporary){path, noted};
    noted = entry;
}

void temporary_note(struct temporary *entry, const char *path) {
    lock();
    note(entry, path);
    unlock();
}

int temporary_create(struct temporary *entry, int folder, const char *name, const char *path) {
    lock();
    int fd;
    do
        fd = openat(folder, name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    while (fd < 0 && errno == EINTR);
    const int error = errno;
    if (fd >= 0)
        note(entry, path);
    unlock();
    errno = error;
    return fd;
}

void temporary_forget(struct temporary *entry) {
    lock();
    for (struct temporary **at = &noted; *at; at = &(*at)->next)
        if (*at == entry) {
            *at = entry->next;
            break;
        }
    unlock();
}

// The system's layout (getdents64(2)).
struct listed {
    uint64_t inode;
    int64_t offset;
    unsigned short length;
    unsigned char type;
    char name[];
};

static bool remove_at(int folder, const char *name, int depth);

#ifdef __EMSCRIPTEN__
// That system has no such call, and no lack of memory to work around.
static long read_list(int folder, void *list, size_t bytes) {
    return getdents(folder, list, bytes);
}
#else
static long read_list(int folder, void *list, size_t bytes) {
    return syscall(SYS_getdents64, folder, list, bytes);
}
#endif

// Removes the entries that one reading of the list shows. true: something was removed.
static bool empty(int folder, int depth) {
    _Alignas(struct listed) char list[LIST_BYTES];
    bool removed = false;
    long bytes = read_list(folder, list, sizeof list);
    for (long at = 0; at < bytes;) {
        const struct listed *entry = (const struct listed *)(list + at);
        at += entry->length;
        if (strcmp(entry->name, ".") != 0 && strcmp(entry->name, "..") != 0)
            removed |= remove_at(folder, entry->name, depth + 1);
    }
    return removed;
}

// Removing entries shifts the rest of the folder's list: it is opened and read again until nothing more can
// be removed.
static bool remove_at(int folder, const char *name, int depth) {
    if (unlinkat(folder, name, 0) == 0)
        return true;
    bool more = (errno == EISDIR || errno == EPERM) && depth <= DEPTH_MAX;
    if (more && unlinkat(folder, name, AT_REMOVEDIR) == 0) // an empty one need not be opened
        return true;
    while (more) {
        int inside = openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        if (inside < 0 && errno == EINTR)
            continue;
        if (inside < 0)
            return false;
        more = empty(inside, depth);
        close(inside);
    }
    return unlinkat(folder, name, AT_REMOVEDIR) == 0;
}

bool temporary_remove(const char *path) {
    return remove_at(AT_FDCWD, path, 0) || errno == ENOENT;
}

void temporary_remove_all(void) {
    lock();
    for (const struct temporary *entry = noted; entry; entry = entry->next)
        temporary_remove(entry->path);
    noted = NULL; // and the lock stays held, so no other thread makes one until the process ends
}
