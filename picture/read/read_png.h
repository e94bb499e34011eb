// PNG files (ISO/IEC 15948): the chunks are walked here, the pixels decoded by libpng.
//
// Thread safety: calls are independent of each other.
#ifndef GLINT_PICTURE_READ_READ_PNG_H
#define GLINT_PICTURE_READ_READ_PNG_H

#include "picture/read/picture_read.h"
#include "picture/read/picture_rows.h"

// Walks all chunks. Fills width, height, is_16_bit, decoder_bytes and ignored. Returns NULL, or what is
// wrong.
const char *picture_png_header(str bytes, struct picture_header *out);
// RGB of 8 or 16 bits per channel, as the header says, for a file that picture_png_header found whole. Fills
// clear_pixels. NULL, or what is wrong. Rows of an interlaced file come several times, each time with more of
// their pixels.
const char *picture_png_rows(str bytes, struct picture_header *header, struct picture_rows rows);

#endif
