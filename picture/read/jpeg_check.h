// JPEG files (ISO/IEC 10918-1) segment by segment: size, colour profile, and whether all that the decoder
// relies on is there.
//
// The decoder believes the file's tables: a Huffman table of too many codes, or one that a scan uses and the
// file lacks, makes it read and write beside its arrays. Such files are refused here.
// Thread safety: pure function.
#ifndef GLINT_PICTURE_READ_JPEG_CHECK_H
#define GLINT_PICTURE_READ_JPEG_CHECK_H

#include "picture/read/picture_read.h"

// Walks the whole file. Fills width, height and ignored. NULL, or what is wrong.
const char *jpeg_read_header(str bytes, struct picture_header *out);

#endif
