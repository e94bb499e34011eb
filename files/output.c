#include "files/output.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    TEMPORARY_NAMES = 10000,
    LINKS_MAX = 40, // as many as Linux follows
};

static bool fail(struct output *output) {
    if (!output->error)
        output->error = errno ? errno : EIO;
    return false;
}

static void release(struct output *output) {
    free(output->path);
    free(output->temporary);
    output->path = NULL;
    output->temporary = NULL;
    output->stream = NULL;
}

// Owner and permissions of the file that is replaced, as far as the system allows.
static void take_mode(int fd, const struct stat *old) {
    struct stat now;
    bool other = fstat(fd, &now) == 0 && (now.st_uid != old->st_uid || now.st_gid != old->st_gid);
    // Not every user may give files away, and not every file system has permissions.
    if (other && fchown(fd, old->st_uid, old->st_gid) != 0)
        errno = 0;
    if (fchmod(fd, old->st_mode & 0777) != 0)
        errno = 0;
}

// A new file beside the target. Its name does not grow with the target's, which may be as long as names
// get; the umask decides its permissions.
static int create_beside(struct output *output) {
    const char *slash = strrchr(output->path, '/');
    int folder = slash ? (int)(slash - output->path) + 1 : 0;
    size_t size = (size_t)folder + 64;
    output->temporary = malloc(size);
    if (!output->temporary)
        return -1;
    for (unsigned attempt = 0; attempt < TEMPORARY_NAMES; attempt++) {
        snprintf(output->temporary, size, "%.*s.glint-%ld-%u.tmp", folder, output->path, (long)getpid(),
                 attempt);
        int fd = open(output->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd >= 0)
            return fd;
        if (errno != EEXIST)
            break;
    }
    int error = errno;
    free(output->temporary);
    output->temporary = NULL;
    errno = error;
    return -1;
}

static void open_temporary(struct output *output, const struct stat *old) {
    int fd = create_beside(output);
    if (fd < 0) {
        fail(output);
        return;
    }
    if (old)
        take_mode(fd, old);
    output->stream = fdopen(fd, "wb");
    if (!output->stream) {
        fail(output);
        close(fd);
    }
}

// Where the last of a chain of links leads, even if nothing is there yet: a link is replaced at its
// target, so that the link stays. NULL: errno says why.
static char *follow_links(const char *path) {
    char *at = strdup(path);
    char next[PATH_MAX];
    for (int links = 0; at && links < LINKS_MAX; links++) {
        ssize_t length = readlink(at, next, sizeof next - 1);
        if (length < 0)
            return at;
        next[length] = '\0';
        const char *slash = next[0] == '/' ? NULL : strrchr(at, '/');
        int folder = slash ? (int)(slash - at) + 1 : 0;
        size_t size = (size_t)folder + (size_t)length + 1;
        char *joined = malloc(size);
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
        output->stream = fopen(output->path, "wb");
        if (!output->stream)
            fail(output);
    } else if (exists && access(output->path, W_OK) != 0) {
        fail(output); // renaming would replace a file that its owner protects
    } else {
        open_temporary(output, exists ? &info : NULL);
    }
}

bool output_open(struct output *output, const char *path) {
    *output = (struct output){0};
    errno = 0;
    if (strcmp(path, "-") == 0) {
        output->stream = stdout;
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

void output_write(struct output *output, const void *bytes, size_t count) {
    if (output->error || !output->stream || count == 0)
        return;
    errno = 0;
    if (fwrite(bytes, 1, count, output->stream) != count)
        fail(output);
}

bool output_commit(struct output *output) {
    if (!output->stream) {
        release(output);
        return !output->error;
    }
    errno = 0;
    if (fflush(output->stream) != 0)
        fail(output);
    if (output->stream == stdout) {
        release(output);
        return !output->error;
    }
    if (!output->error && output->temporary && fsync(fileno(output->stream)) != 0 && errno != EINVAL)
        fail(output);
    if (fclose(output->stream) != 0)
        fail(output);
    output->stream = NULL;
    if (!output->error && output->temporary && rename(output->temporary, output->path) != 0)
        fail(output);
    if (output->error && output->temporary)
        unlink(output->temporary);
    release(output);
    return !output->error;
}

void output_abandon(struct output *output) {
    if (output->stream && output->stream != stdout)
        fclose(output->stream);
    if (output->temporary)
        unlink(output->temporary);
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
    FILE *stream = fopen(path, "wbx");
    bool good = stream && (count == 0 || fwrite(bytes, 1, count, stream) == count);
    int error = good ? 0 : errno ? errno : EIO;
    if (stream && fclose(stream) != 0 && good)
        error = errno ? errno : EIO;
    return error;
}
