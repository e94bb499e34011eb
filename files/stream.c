#include "files/stream.h"

#include <errno.h>
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
