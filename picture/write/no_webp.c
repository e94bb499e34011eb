// In place of encode_webp.c where glint is built without WebP: nobody asks for it there.
#include "picture/write/encode_internal.h"

void encode_webp(uint32_t width, uint32_t height, const uint8_t *rgb, unsigned quality, struct strbuf *out) {
    (void)width;
    (void)height;
    (void)rgb;
    (void)quality;
    out->failed = true;
}
