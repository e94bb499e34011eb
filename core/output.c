#include "core/output.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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

// The permissions of the file that is replaced, else what the umask leaves of 0666.
static void take_mode(int fd, const struct stat *old) {
    mode_t mask = umask(0);
    umask(mask);
    mode_t mode = old ? old->st_mode & 0777 : 0666 & ~mask;
    if (fchmod(fd, mode) != 0)
        errno = 0; // a file system without permissions keeps its own
}

static bool open_temporary(struct output *output, const struct stat *old) {
    size_t size = strlen(output->path) + 16;
    output->temporary = malloc(size);
    if (!output->temporary)
        return fail(output);
    snprintf(output->temporary, size, "%s.XXXXXX", output->path);
    int fd = mkstemp(output->temporary);
    if (fd < 0) {
        free(output->temporary);
        output->temporary = NULL;
        return fail(output);
    }
    take_mode(fd, old);
    output->stream = fdopen(fd, "wb");
    return output->stream ? true : fail(output);
}

bool output_open(struct output *output, const char *path) {
    *output = (struct output){0};
    errno = 0;
    if (strcmp(path, "-") == 0) {
        output->stream = stdout;
        return true;
    }
    // A link is replaced at its target, so that the link stays.
    char *target = realpath(path, NULL);
    output->path = target ? target : strdup(path);
    if (!output->path)
        return fail(output);
    struct stat info;
    bool exists = stat(output->path, &info) == 0;
    if (exists && S_ISDIR(info.st_mode)) {
        errno = EISDIR;
        fail(output);
    } else if (exists && !S_ISREG(info.st_mode)) {
        output->stream = fopen(output->path, "wb");
        if (!output->stream)
            fail(output);
    } else {
        errno = 0;
        open_temporary(output, exists ? &info : NULL);
    }
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
    if (!output->stream)
        return !output->error;
    errno = 0;
    if (fflush(output->stream) != 0)
        fail(output);
    if (output->stream == stdout) {
        output->stream = NULL;
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
