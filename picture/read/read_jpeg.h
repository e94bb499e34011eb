// JPEG files (ISO/IEC 10918-1): the segments are walked here, the pixels decoded by libjpeg-turbo.
//
// Thread safety: calls are independent of each other.
#ifndef GLINT_PICTURE_READ_READ_JPEG_H
#define GLINT_PICTURE_READ_READ_JPEG_H

#include "picture/read/picture_read.h"

// Walks the whole file to its end marker. Fills width, height and ignored. NULL, or what is wrong.
const char *picture_jpeg_header(str bytes, struct picture_header *out);
// RGBA, alpha 255, for a file that picture_jpeg_header found whole. NULL, or what is wrong.
const char *picture_jpeg_pixels(str bytes, const struct picture_header *header, uint8_t *pixels);

#endif
