// A file that is written and read at places, while the work that it belongs to goes on: its head is there as
// a whole or not at all, and what follows is put and taken in pieces, in any order.
//
// A piece that was not written whole, because the process was killed, is there in part: who needs to know
// seals its pieces. Errors: false; `error` has the errno of the first failure, and 0 for bytes that are not
// there. Ownership: spool_close frees; the file stays. Thread safety: one thread has a spool.
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
// A file that is there: error ENOENT if it is not. It must be a regular one.
bool spool_open(struct spool *spool, const char *path);
// The same for a file that is only read: any that has places.
bool spool_read(struct spool *spool, const char *path);
bool spool_put(struct spool *spool, uint64_t at, const void *bytes, size_t count);
bool spool_take(struct spool *spool, uint64_t at, void *bytes, size_t count);
// On the disk, and not in the system's memory alone.
bool spool_settle(struct spool *spool);
void spool_close(struct spool *spool);
// Removes the file and closes it.
void spool_remove(struct spool *spool);

#endif
