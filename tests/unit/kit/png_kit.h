// PNG files made by hand, which compress nothing.
//
// Ownership: the caller's buffer. Thread safety: pure.
#ifndef GLINT_TESTS_UNIT_PNG_KIT_H
#define GLINT_TESTS_UNIT_PNG_KIT_H

#include "core/strbuf.h"

// Appends length, type, data and checksum.
void png_put_chunk(struct strbuf *out, const char *type, const void *data, size_t size);
// Appends the signature and the first chunk.
void png_put_header(struct strbuf *out, uint32_t width, uint32_t height, char depth, char color,
                    char interlace);
// Their checksum (annex D of ISO/IEC 15948).
uint32_t png_checksum(const void *bytes, size_t size);
// Appends rows with their filter bytes, at most 65535 bytes, as a zlib stream of one stored block.
void png_put_stream(struct strbuf *out, const void *rows, size_t size);
// Appends rows with their filter bytes, at most 65535 bytes, as one stored block, and the end.
void png_put_rows(struct strbuf *out, const void *rows, size_t size);

#endif
