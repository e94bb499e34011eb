// Radiance HDR images (Ward 1991, "Real Pixels"; the run lengths of Radiance's color.c): RGBE, rows from
// the top, columns from the left.
//
// Thread safety: pure functions.
#ifndef GLINT_PICTURE_READ_READ_HDR_H
#define GLINT_PICTURE_READ_READ_HDR_H

#include "picture/read/picture_read.h"
#include "picture/read/picture_rows.h"

// Fills width, height, data_at and ignored. Returns NULL, or what is wrong.
const char *hdr_read_header(str bytes, struct picture_header *out);
// RGBE: the bytes of the format itself, runs expanded. NULL, or what is wrong.
const char *hdr_read_rows(str bytes, const struct picture_header *header, struct picture_rows rows);

#endif
