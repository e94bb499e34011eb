// Portable float map: a scale of -1 says little endian; rows are from the bottom up.
#include "picture/write/encode_internal.h"

#include <string.h>

enum {
    CHUNK = 1024
}; // floats

void encode_pfm_head(uint32_t width, uint32_t height, struct strbuf *out) {
    strbuf_format(out, "PF\n%u %u\n-1.0\n", width, height);
}

void encode_pfm_rows(uint32_t width, uint32_t rows, const float *rgb, struct strbuf *out) {
    size_t row = (size_t)width * 3;
    for (uint32_t y = rows; y-- > 0;)
        for (size_t begin = 0; begin < row; begin += CHUNK) {
            size_t count = row - begin < CHUNK ? row - begin : CHUNK;
            uint8_t bytes[CHUNK * 4];
            for (size_t i = 0; i < count; i++) {
                uint32_t bits;
                memcpy(&bits, &rgb[y * row + begin + i], sizeof bits);
                for (int k = 0; k < 4; k++)
                    bytes[4 * i + (size_t)k] = (uint8_t)(bits >> (8 * k));
            }
            strbuf_add(out, bytes, 4 * count);
        }
}

void encode_pfm(uint32_t width, uint32_t height, const float *rgb, struct strbuf *out) {
    encode_pfm_head(width, height, out);
    encode_pfm_rows(width, height, rgb, out);
}
