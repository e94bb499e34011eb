#include "files/stream.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    BLOCK_BYTES = 65536
};

int stream_read(int fd, size_t cap_bytes, struct strbuf *text) {
    char block[BLOCK_BYTES];
    ssize_t count;
    text->cap_bytes = cap_bytes + 1;
    do {
        count = read(fd, block, sizeof block);
        if (count > 0)
            strbuf_add(text, block, (size_t)count);
    } while ((count > 0 && !text->failed) || (count < 0 && errno == EINTR));
    return count < 0 ? errno : 0;
}

int stream_read_file(const char *path, size_t most_bytes, struct strbuf *bytes) {
    char block[BLOCK_BYTES];
    struct stat info;
    const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); // does not wait if it is a pipe
    ssize_t count;
    if (fd < 0)
        return errno;
    const int wrong = fstat(fd, &info) != 0   ? errno
                      : S_ISREG(info.st_mode) ? 0
                      : S_ISDIR(info.st_mode) ? EISDIR
                                              : EINVAL;
    if (wrong) {
        close(fd);
        return wrong;
    }
    do {
        const size_t left = most_bytes - bytes->len;
        count = read(fd, block, left < sizeof block ? left : sizeof block);
        if (count > 0)
            strbuf_add(bytes, block, (size_t)count);
    } while ((count > 0 && !bytes->failed) || (count < 0 && errno == EINTR));
    const int error = count < 0 ? errno : 0;
    close(fd);
    return error;
}
