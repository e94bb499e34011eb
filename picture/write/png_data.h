// The data of a PNG: rows filtered (ISO/IEC 15948, clause 9) and deflated (RFC 1950, 1951) on all processors.
//
// Rows are filtered as libpng does by default: the chosen filter of the five is the one whose bytes, taken as
// signed, have the least sum of magnitudes. The filtered bytes are cut into pieces of a fixed size; each is
// deflated by itself, with the bytes before it as its dictionary, and ends on a byte boundary (Z_SYNC_FLUSH),
// so that all together form one stream: the method of pigz (M. Adler). So the bytes do not depend on the
// number of threads. Errors: false, no memory. Ownership: png_data_finish frees. Thread safety: plain data.
#ifndef GLINT_PICTURE_WRITE_PNG_DATA_H
#define GLINT_PICTURE_WRITE_PNG_DATA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    PNG_PIECE = 128 << 10,
    PNG_WINDOW = 32 << 10, // how far deflate looks back
};

// A part of the stream, which goes into a chunk of its own.
struct png_piece {
    uint8_t *bytes; // from malloc
    size_t count;
    size_t from, end;  // of the filtered bytes
    unsigned long sum; // their Adler-32
};

struct png_data {
    struct png_piece *pieces;
    size_t count;
};

// `rgb`: `pixel` bytes per pixel, 3 or 6, row 0 on top; width and height are at least 1.
bool png_data_make(uint32_t width, uint32_t height, uint32_t pixel, const uint8_t *rgb, struct png_data *out);
// Accepts what png_data_make left, whatever it returned.
void png_data_finish(struct png_data *data);

// The same for `size` filtered bytes, at least one, that follow `before` others: the last PNG_WINDOW bytes of
// the stream, or 0 at its beginning. Unless the stream ends with them, `size` is a multiple of PNG_PIECE.
bool png_data_deflate(const uint8_t *filtered, size_t before, size_t size, bool is_last,
                      struct png_data *out);

// ---- png_filter.c

// Rows of pixel * width bytes, each after the number of its filter. `above`: the row before them; NULL: they
// are the first. false: no memory.
bool png_filter_rows(uint32_t width, uint32_t height, uint32_t pixel, const uint8_t *rgb,
                     const uint8_t *above, uint8_t *filtered);

#endif
