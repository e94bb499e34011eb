// OpenEXR files, read by OpenEXRCore (docs/decisions/image-files.md): one part of scan lines, with R, G and B
// (or Y) as half or float, uncompressed or compressed by RLE, ZIP or PIZ.
//
// Where glint is built without the library, both functions say so. Errors, ownership: picture_read.h.
// Thread safety: calls are independent of each other.
#ifndef GLINT_PICTURE_READ_READ_EXR_H
#define GLINT_PICTURE_READ_READ_EXR_H

#include "picture/read/picture_read.h"
#include "picture/read/picture_rows.h"

// Reads the header, and the place of each chunk of rows. Fills width, height, decoder_bytes and ignored.
// NULL, or what is wrong.
const char *picture_exr_header(str bytes, struct picture_header *out);
// Three floats per pixel, finite and not negative. NULL, or what is wrong. `ignored` then mentions negative
// values, which become 0.
const char *picture_exr_rows(str bytes, struct picture_header *header, struct picture_rows rows);

#endif
