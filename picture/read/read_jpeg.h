// JPEG files (ISO/IEC 10918-1): the segments are walked here, the pixels decoded by libjpeg-turbo.
//
// Thread safety: calls are independent of each other.
#ifndef GLINT_PICTURE_READ_READ_JPEG_H
#define GLINT_PICTURE_READ_READ_JPEG_H

#include "picture/read/picture_read.h"
#include "picture/read/picture_rows.h"

// Walks the whole file to its end marker. Fills width, height, decoder_bytes and ignored. NULL, or what is
// wrong.
const char *picture_jpeg_header(str bytes, struct picture_header *out);
// RGB, for a file that picture_jpeg_header found whole. NULL, or what is wrong.
const char *picture_jpeg_rows(str bytes, const struct picture_header *header, struct picture_rows rows);

#endif
