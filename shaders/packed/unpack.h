// From packed bytes (packed.h) to the words of a module.
//
// In: the bytes, inflated. Out: words. Errors: false if the bytes do not hold a module of that many words.
// Ownership: all memory is the caller's. Thread safety: pure.
#ifndef GLINT_SHADERS_PACKED_UNPACK_H
#define GLINT_SHADERS_PACKED_UNPACK_H

#include "shaders/packed/packed.h"

#include <stddef.h>

// A part of packed bytes. Reading beyond its end gives zeros and sets `ended`.
struct packed_bytes {
    const unsigned char *bytes;
    size_t count, at;
    bool ended;
};

uint32_t packed_number(struct packed_bytes *part);
// The next `count` bytes as a part of their own.
struct packed_bytes packed_piece(struct packed_bytes *part, size_t count);
// Whether all of it was read, and nothing beyond its end.
bool packed_all_read(const struct packed_bytes *part);

struct packed_function {
    struct packed_bytes parts[PACKED_CODE_PARTS];
};

// A module that is being unpacked, which owns nothing.
struct unpacking {
    struct packed_bytes own[PACKED_PARTS];
    uint32_t *words;
    size_t count, at;        // how many words the module has, and how many are written
    uint32_t *local, *outer; // ids of the current function: room for `count` each
    size_t locals, outers;
    uint32_t newest; // the largest id so far
    bool broken;
};

// What is before the first function.
bool unpack_head(struct unpacking *to);
bool unpack_function(struct unpacking *to, const struct packed_function *function);

#endif
