// A folder of files that may disappear at any time: what a program keeps to be faster next time.
//
// Entries are written to a temporary name and renamed. If the folder holds more than `cap_bytes`, those that
// were used longest ago are removed. Every failure is silent: lacking a cache is not an error. Ownership: the
// caller owns the path. Thread safety: calls on one store may run at the same time, in other processes too.
#ifndef GLINT_FILES_FOLDER_STORE_H
#define GLINT_FILES_FOLDER_STORE_H

#include "core/str.h"

struct folder_store {
    const char *path;   // NULL or empty: there is no store; it need not exist yet
    uint64_t cap_bytes; // limit on the total size of all entries
};

struct folder_store_part {
    const void *bytes;
    size_t count;
};

// Reads an entry into memory from malloc, which the caller frees; NULL if there is none or it is larger
// than `most_bytes`. The entry counts as used.
void *folder_store_read(const struct folder_store *store, const char *name, size_t most_bytes, size_t *count);
// Writes the parts, one after the other, then removes old entries above the cap. false: it was not kept.
bool folder_store_write(const struct folder_store *store, const char *name,
                        const struct folder_store_part *parts, int part_count);

// What an entry belongs to, written before it with its length and a checksum, so that an entry that is
// damaged, truncated, of another version or of something else counts as missing. An entry is read on the
// machine that wrote it.
struct folder_seal {
    char magic[8];
    uint64_t version;
    uint64_t key[2];
};
// As folder_store_read and folder_store_write, for the data after the seal.
void *folder_store_open(const struct folder_store *store, const char *name, const struct folder_seal *seal,
                        size_t most_bytes, size_t *count);
bool folder_store_seal(const struct folder_store *store, const char *name, const struct folder_seal *seal,
                       const struct folder_store_part *parts, int part_count);

// "$XDG_CACHE_HOME/glint/NAME", or ~/.cache/glint/NAME, from malloc; NULL if neither is known (XDG Base
// Directory Specification 0.8: a relative XDG_CACHE_HOME is ignored).
char *folder_store_path(const char *name);

#endif
