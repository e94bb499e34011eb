#include "files/output.h"

#include "core/heap.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    TEMPORARY_NAMES = 10000,
    LINKS_MAX = 40, // as many links as Linux follows
};

// A system call that lacks memory is treated like a failed allocation.
static bool fail(struct output *output) {
    if (errno == ENOMEM)
        heap_exhausted(0);
    if (!output->error)
        output->error = errno ? errno : EIO;
    return false;
}

static int open_again(const char *path, int flags) {
    int fd;
    do
        fd = open(path, flags | O_CLOEXEC, 0666);
    while (fd < 0 && errno == EINTR);
    return fd;
}

int output_descriptor(int fd, const void *bytes, size_t count) {
    const char *at = bytes;
    while (count) {
        ssize_t done = write(fd, at, count);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return done < 0 && errno ? errno : EIO;
        at += done;
        count -= (size_t)done;
    }
    return 0;
}

// An interrupted close still closes the descriptor.
static bool close_once(int fd) {
    return close(fd) == 0 || errno == EINTR;
}

static void forget_temporary(struct output *output) {
    temporary_forget(&output->entry);
    free(output->temporary);
    output->temporary = NULL;
}

static void release(struct output *output) {
    forget_temporary(output);
    if (output->path && output->folder != AT_FDCWD)
        close(output->folder);
    free(output->path);
    output->path = NULL;
    output->fd = -1;
}

// Copies owner and permissions of the replaced file, as far as the system allows.
static void take_mode(int fd, const struct stat *old) {
    struct stat now;
    bool other = fstat(fd, &now) == 0 && (now.st_uid != old->st_uid || now.st_gid != old->st_gid);
    // Not every user may give files away, and not every file system has permissions.
    if (other && fchown(fd, old->st_uid, old->st_gid) != 0)
        errno = 0;
    if (fchmod(fd, old->st_mode & 0777) != 0)
        errno = 0;
}

// A path's name within the output's folder.
static const char *named(const struct output *output, const char *path) {
    const char *slash = output->folder == AT_FDCWD ? NULL : strrchr(path, '/');
    return slash ? slash + 1 : path;
}

// A new file beside the target. Its name does not grow with the target's, which may be as long as names
// get; the umask decides its permissions.
static int create_beside(struct output *output) {
    const char *slash = strrchr(output->path, '/');
    int folder = slash ? (int)(slash - output->path) + 1 : 0;
    size_t size = (size_t)folder + 64;
    output->temporary = heap_alloc(size);
    if (!output->temporary)
        return -1;
    for (unsigned attempt = 0; attempt < TEMPORARY_NAMES; attempt++) {
        snprintf(output->temporary, size, "%.*s.glint-%ld-%u.tmp", folder, output->path, (long)getpid(),
                 attempt);
        int fd = temporary_create(&output->entry, output->folder, named(output, output->temporary),
                                  output->temporary);
        if (fd >= 0)
            return fd;
        if (errno != EEXIST)
            break;
    }
    int error = errno;
    forget_temporary(output);
    errno = error;
    return -1;
}

static void open_temporary(struct output *output, const struct stat *old) {
    output->fd = create_beside(output);
    if (output->fd < 0)
        fail(output);
    else if (old)
        take_mode(output->fd, old);
}

// Where the last of a chain of links leads, even if nothing is there yet: a link is replaced at its
// target, so that the link stays. NULL: errno says why.
static char *follow_links(const char *path) {
    char *at = heap_text(path);
    char next[PATH_MAX];
    for (int links = 0; at && links < LINKS_MAX; links++) {
        ssize_t length = readlink(at, next, sizeof next - 1);
        if (length < 0)
            return at;
        next[length] = '\0';
        const char *slash = next[0] == '/' ? NULL : strrchr(at, '/');
        int folder = slash ? (int)(slash - at) + 1 : 0;
        size_t size = (size_t)folder + (size_t)length + 1;
        char *joined = heap_alloc(size);
        if (joined)
            snprintf(joined, size, "%.*s%s", folder, at, next);
        free(at);
        at = joined;
    }
    if (at)
        errno = ELOOP;
    free(at);
    return NULL;
}

static void open_target(struct output *output) {
    struct stat info;
    bool exists = stat(output->path, &info) == 0;
    if (exists && S_ISDIR(info.st_mode)) {
        errno = EISDIR;
        fail(output);
    } else if (exists && !S_ISREG(info.st_mode)) {
        // Opening a pipe that nobody reads blocks; a signal ends that.
        output->fd = open(output->path, O_WRONLY | O_CLOEXEC);
        if (output->fd < 0)
            fail(output);
    } else if (exists && access(output->path, W_OK) != 0) {
        fail(output); // renaming would replace a file that its owner protects
    } else {
        open_temporary(output, exists ? &info : NULL);
    }
}

bool output_open(struct output *output, const char *path) {
    *output = (struct output){.fd = -1, .folder = AT_FDCWD};
    errno = 0;
    if (strcmp(path, "-") == 0) {
        output->fd = STDOUT_FILENO;
        return true;
    }
    if (path[0] == '\0')
        errno = ENOENT;
    else
        output->path = follow_links(path);
    if (output->path)
        open_target(output);
    else
        fail(output);
    if (output->error)
        output_abandon(output);
    return !output->error;
}

static bool begin_in(struct output *output, int folder, const char *path) {
    *output = (struct output){.fd = -1, .folder = folder, .path = heap_text(path)};
    if (output->path)
        return true;
    close(folder);
    errno = ENOMEM;
    return fail(output);
}

bool output_open_in(struct output *output, int folder, const char *path) {
    struct stat info;
    if (!begin_in(output, folder, path))
        return false;
    const char *name = named(output, output->path);
    errno = 0;
    const bool exists = fstatat(folder, name, &info, AT_SYMLINK_NOFOLLOW) == 0;
    if (exists && !S_ISREG(info.st_mode)) {
        errno = S_ISLNK(info.st_mode) ? ELOOP : S_ISDIR(info.st_mode) ? EISDIR : ENXIO;
        fail(output);
    } else if (exists && faccessat(folder, name, W_OK, 0) != 0) {
        fail(output);
    } else {
        open_temporary(output, exists ? &info : NULL);
    }
    if (output->error)
        output_abandon(output);
    return !output->error;
}

bool output_open_over(struct output *output, int folder, const char *path) {
    if (!begin_in(output, folder, path))
        return false;
    open_temporary(output, NULL);
    if (output->error)
        output_abandon(output);
    return !output->error;
}

void output_write(struct output *output, const void *bytes, size_t count) {
    if (output->error || output->fd < 0)
        return;
    output->error = output_descriptor(output->fd, bytes, count);
    if (output->error == ENOMEM)
        heap_exhausted(0);
}

uint64_t output_place(struct output *output) {
    off_t place = output->fd < 0 ? 0 : lseek(output->fd, 0, SEEK_CUR);
    if (place < 0)
        fail(output);
    return place < 0 ? 0 : (uint64_t)place;
}

void output_move(struct output *output, uint64_t place) {
    if (output->fd >= 0 && lseek(output->fd, (off_t)place, SEEK_SET) < 0)
        fail(output);
}

// Waits until the file is on disk, not only in the system's memory. Some file systems cannot do that.
static bool settle(int fd) {
    int result;
    do
        result = fsync(fd);
    while (result != 0 && errno == EINTR);
    return result == 0 || errno == EINVAL;
}

bool output_commit(struct output *output) {
    bool own = output->fd >= 0 && output->fd != STDOUT_FILENO;
    errno = 0;
    if (own && !output->error && output->temporary && !settle(output->fd))
        fail(output);
    if (own && !close_once(output->fd))
        fail(output);
    if (!output->error && output->temporary &&
        renameat(output->folder, named(output, output->temporary), output->folder,
                 named(output, output->path)) != 0)
        fail(output);
    if (output->error && output->temporary)
        unlinkat(output->folder, named(output, output->temporary), 0);
    release(output);
    return !output->error;
}

void output_abandon(struct output *output) {
    if (output->fd >= 0 && output->fd != STDOUT_FILENO)
        close(output->fd);
    if (output->temporary)
        unlinkat(output->folder, named(output, output->temporary), 0);
    release(output);
}

int output_whole(const char *path, const void *bytes, size_t count) {
    struct output output;
    if (!output_open(&output, path))
        return output.error;
    output_write(&output, bytes, count);
    output_commit(&output);
    return output.error;
}

int output_part(const char *path, const void *bytes, size_t count) {
    errno = 0;
    int fd = open_again(path, O_WRONLY | O_CREAT | O_EXCL);
    if (fd < 0)
        return errno ? errno : EIO;
    int error = output_descriptor(fd, bytes, count);
    if (!close_once(fd) && !error)
        error = errno ? errno : EIO;
    return error;
}
