// Image files in memory: what they are, and their pixels.
//
// The size is known and checked before anything is decoded, and decoding has a budget of bytes: no small
// file becomes a large allocation that its header did not announce.
// Thread safety: calls are independent of each other.
#ifndef GLINT_PICTURE_READ_PICTURE_READ_H
#define GLINT_PICTURE_READ_PICTURE_READ_H

#include "core/str.h"
#include "picture/read/picture.h"

enum picture_kind {
    PICTURE_KIND_NONE,
    PICTURE_KIND_PNG,
    PICTURE_KIND_JPEG,
    PICTURE_KIND_HDR,
};

struct picture_header {
    enum picture_kind kind;
    uint32_t width, height;
    bool is_16_bit;      // PNG
    size_t data_at;      // HDR: where the pixels begin
    const char *ignored; // as in struct picture
};

// Reads only the header. NULL if it is whole, else what is wrong with it; kind is NONE for files that are not
// an image of a supported kind.
const char *picture_read_header(str bytes, struct picture_header *out);
// Decodes; returns NULL, or what is wrong. On success picture_finish frees the pixels.
const char *picture_decode(str bytes, const struct picture_header *header, struct picture *out);

#endif
