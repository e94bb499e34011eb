#include "files/spool.h"

#include "core/heap.h"
#include "files/output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool fail(struct spool *spool, int error) {
    if (error == ENOMEM)
        heap_exhausted(0);
    if (!spool->error)
        spool->error = error;
    return false;
}

static bool open_as(struct spool *spool, const char *path, int flags) {
    struct stat info;
    *spool = (struct spool){.fd = -1};
    do
        spool->fd = open(path, flags | O_CLOEXEC | O_NONBLOCK);
    while (spool->fd < 0 && errno == EINTR);
    if (spool->fd < 0 || fstat(spool->fd, &info) != 0)
        fail(spool, errno);
    else if (!S_ISREG(info.st_mode))
        fail(spool, EINVAL);
    else
        spool->path = heap_text(path);
    if (spool->path)
        return true;
    const int error = spool->error ? spool->error : ENOMEM;
    spool_close(spool);
    return fail(spool, error);
}

bool spool_open(struct spool *spool, const char *path) {
    return open_as(spool, path, O_RDWR | O_NOFOLLOW);
}

bool spool_read(struct spool *spool, const char *path) {
    return open_as(spool, path, O_RDONLY);
}

// Its name is derived from another's: nobody has checked whether it is a link.
bool spool_create(struct spool *spool, const char *path, const void *head, size_t count) {
    struct output output = {.error = ENOMEM};
    const char *slash = strrchr(path, '/');
    char *in = heap_text(slash ? path : ".");
    if (in && slash)
        in[slash > path ? slash - path : 1] = '\0';
    const int folder = in ? open(in, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    if (in && folder < 0)
        output.error = errno;
    free(in);
    if (folder >= 0 && output_open_over(&output, folder, path)) {
        output_write(&output, head, count);
        output_commit(&output);
    }
    if (!output.error)
        return spool_open(spool, path);
    *spool = (struct spool){.fd = -1};
    return fail(spool, output.error);
}

bool spool_put(struct spool *spool, uint64_t at, const void *bytes, size_t count) {
    const char *from = bytes;
    while (count && !spool->error) {
        const ssize_t done = pwrite(spool->fd, from, count, (off_t)at);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return fail(spool, done < 0 ? errno : EIO);
        from += done;
        at += (uint64_t)done;
        count -= (size_t)done;
    }
    return !spool->error;
}

bool spool_take(struct spool *spool, uint64_t at, void *bytes, size_t count) {
    char *to = bytes;
    while (count && !spool->error) {
        const ssize_t done = pread(spool->fd, to, count, (off_t)at);
        if (done < 0 && errno == EINTR)
            continue;
        if (done < 0)
            return fail(spool, errno);
        if (done == 0)
            return false;
        to += done;
        at += (uint64_t)done;
        count -= (size_t)done;
    }
    return !spool->error;
}

bool spool_settle(struct spool *spool) {
    int result;
    do
        result = spool->error ? 0 : fsync(spool->fd);
    while (result != 0 && errno == EINTR);
    return result == 0 || errno == EINVAL ? !spool->error : fail(spool, errno);
}

void spool_close(struct spool *spool) {
    if (spool->fd >= 0)
        close(spool->fd);
    free(spool->path);
    spool->path = NULL;
    spool->fd = -1;
}

void spool_remove(struct spool *spool) {
    if (spool->path)
        unlink(spool->path);
    spool_close(spool);
}
