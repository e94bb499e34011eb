// In place of encode_jpeg.c where glint is built without a writer of JPEG: nobody asks for it there.
#include "picture/write/encode_internal.h"

void encode_jpeg(uint32_t width, uint32_t height, const uint8_t *rgb, const struct image_texts *texts,
                 unsigned quality, struct strbuf *out) {
    (void)width;
    (void)height;
    (void)rgb;
    (void)texts;
    (void)quality;
    out->failed = true;
}
