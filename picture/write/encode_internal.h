// One writer per format: for image_encode, and for maps and thumbnails elsewhere.
#ifndef GLINT_PICTURE_WRITE_ENCODE_INTERNAL_H
#define GLINT_PICTURE_WRITE_ENCODE_INTERNAL_H

#include "core/strbuf.h"

#include <stdint.h>

struct image;
struct image_texts;

// `rgb`: three per pixel, row 0 on top. `texts`: lines for the file's head; NULL: none. encode_png_deep: six
// bytes per pixel, the higher one of each value first. `quality`: 1 to 100.
void encode_png(uint32_t width, uint32_t height, const uint8_t *rgb, const struct image_texts *texts,
                struct strbuf *out);
void encode_png_deep(uint32_t width, uint32_t height, const uint8_t *rgb, const struct image_texts *texts,
                     struct strbuf *out);
void encode_jpeg(uint32_t width, uint32_t height, const uint8_t *rgb, const struct image_texts *texts,
                 unsigned quality, struct strbuf *out);
void encode_webp(uint32_t width, uint32_t height, const uint8_t *rgb, unsigned quality, struct strbuf *out);
void encode_exr(const struct image *image, const struct image_texts *texts, struct strbuf *out);
void encode_pfm(uint32_t width, uint32_t height, const float *rgb, struct strbuf *out);
void encode_hdr(uint32_t width, uint32_t height, const float *rgb, const struct image_texts *texts,
                struct strbuf *out);

// ---- some rows at a time (rows.h): the head of a file, and its rows, from the top of those given; for PFM
// the last row first

void encode_pfm_head(uint32_t width, uint32_t height, struct strbuf *out);
void encode_pfm_rows(uint32_t width, uint32_t rows, const float *rgb, struct strbuf *out);
void encode_hdr_head(uint32_t width, uint32_t height, const struct image_texts *texts, struct strbuf *out);
void encode_hdr_rows(uint32_t width, uint32_t rows, const float *rgb, struct strbuf *out);

#endif
