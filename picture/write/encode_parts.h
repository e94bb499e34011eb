// One writer per format: for image_encode, and for maps and thumbnails elsewhere.
#ifndef GLINT_PICTURE_WRITE_ENCODE_PARTS_H
#define GLINT_PICTURE_WRITE_ENCODE_PARTS_H

#include "core/strbuf.h"

#include <stdint.h>

// `rgb`: three per pixel, row 0 on top. `note`: a line of ASCII for who reads the file's head; NULL: none.
void encode_png(uint32_t width, uint32_t height, const uint8_t *rgb, const char *note, struct strbuf *out);
void encode_pfm(uint32_t width, uint32_t height, const float *rgb, struct strbuf *out);
void encode_hdr(uint32_t width, uint32_t height, const float *rgb, const char *note, struct strbuf *out);

#endif
