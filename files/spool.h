// A file that is written and read at given offsets while the work that it belongs to goes on: its head exists
// as a whole or not at all, and the rest is written and read in pieces, in any order.
//
// If the process is killed while writing a piece, part of that piece remains: callers who need to know seal
// their pieces. Errors: false; `error` has the errno of the first failure, or 0 if the bytes do not exist.
// Ownership: spool_close frees; the file stays. Thread safety: one thread has a spool.
#ifndef GLINT_FILES_SPOOL_H
#define GLINT_FILES_SPOOL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct spool {
    int fd; // -1: closed
    char *path;
    int error;
};

// A new file that begins with `head`; an old one of this name is replaced.
bool spool_create(struct spool *spool, const char *path, const void *head, size_t count);
// Opens an existing file: error ENOENT if there is none. It must be a regular file.
bool spool_open(struct spool *spool, const char *path);
// The same for a file that is only read: any that is seekable.
bool spool_read(struct spool *spool, const char *path);
bool spool_put(struct spool *spool, uint64_t at, const void *bytes, size_t count);
bool spool_take(struct spool *spool, uint64_t at, void *bytes, size_t count);
// Waits until the file is on disk, not only in the system's memory.
bool spool_settle(struct spool *spool);
void spool_close(struct spool *spool);
// Removes the file and closes it.
void spool_remove(struct spool *spool);

#endif
