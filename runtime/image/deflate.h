// Deflate (RFC 1951) of one piece of a text, so that several pieces can be made at the same time and
// joined: the bytes depend on the cut alone. Private to runtime/image.
#ifndef GLINT_RUNTIME_IMAGE_DEFLATE_H
#define GLINT_RUNTIME_IMAGE_DEFLATE_H

#include "core/strbuf.h"

enum {
    DEFLATE_PIECE_MAX = 128 * 1024
};

// Appends text[begin, end), at most DEFLATE_PIECE_MAX bytes, to `out`. Matches reach back before `begin`.
// The last piece ends the stream; others end on a whole byte, so that the next can follow.
// Thread safety: pure. Without memory out->failed is set.
void deflate_piece(const uint8_t *text, size_t begin, size_t end, bool is_last, struct strbuf *out);

#endif
