#include "picture/read/picture_read.h"

#include "picture/read/jpeg_check.h"
#include "picture/read/read_hdr.h"
#include "picture/read/stb_decode.h"

#include <stdlib.h>
#include <string.h>

enum {
    PNG_SIGNATURE = 8,
    PNG_FRAME = 12, // length, type and checksum of a chunk
    PNG_COLOR_ALPHA = 4,
    BUDGET_SLACK = 48 << 20,
};

void picture_finish(struct picture *picture) {
    if (!picture)
        return;
    if (picture->depth == PICTURE_FLOAT)
        free(picture->pixels);
    else
        stb_free(picture->pixels);
    *picture = (struct picture){0};
}

static uint32_t big_endian(const unsigned char *p, int bytes) {
    uint32_t value = 0;
    for (int i = 0; i < bytes; i++)
        value = value << 8 | p[i];
    return value;
}

static const char *name_ignored(bool alpha, bool profile) {
    return alpha && profile ? "alpha and colour profile are"
           : alpha          ? "alpha is"
           : profile        ? "colour profile is"
                            : NULL;
}

// ---- PNG (ISO/IEC 15948): all chunks are there, and the first tells the size

static const char *png_header(str bytes, struct picture_header *out) {
    const unsigned char *data = (const unsigned char *)bytes.ptr;
    bool alpha = false;
    bool profile = false;
    for (size_t at = PNG_SIGNATURE;;) {
        if (bytes.len - at < PNG_FRAME)
            return at == PNG_SIGNATURE ? "the file ends before the first chunk"
                                       : "the file ends before its end chunk";
        uint32_t length = big_endian(data + at, 4);
        const char *type = bytes.ptr + at + 4;
        if (length > bytes.len - at - PNG_FRAME)
            return "the file ends within a chunk";
        if (at == PNG_SIGNATURE) {
            if (length != 13 || memcmp(type, "IHDR", 4) != 0)
                return "the first chunk is not a header";
            out->width = big_endian(data + at + 8, 4);
            out->height = big_endian(data + at + 12, 4);
            out->is_16_bit = data[at + 16] == 16;
            alpha = data[at + 17] & PNG_COLOR_ALPHA;
        }
        alpha |= memcmp(type, "tRNS", 4) == 0;
        profile |=
            memcmp(type, "gAMA", 4) == 0 || memcmp(type, "cHRM", 4) == 0 || memcmp(type, "iCCP", 4) == 0;
        if (memcmp(type, "IEND", 4) == 0)
            break;
        at += PNG_FRAME + length;
    }
    out->ignored = name_ignored(alpha, profile);
    return out->width == 0 || out->height == 0 || out->width > INT32_MAX || out->height > INT32_MAX
               ? "its width or height is 0 or beyond the format's range"
               : NULL;
}

// The CRC-32 of each chunk (annex D); the decoder does not look at it.
static const char *png_check(str bytes) {
    uint32_t table[256];
    for (uint32_t i = 0; i < 256; i++) {
        table[i] = i;
        for (int bit = 0; bit < 8; bit++)
            table[i] = table[i] & 1 ? UINT32_C(0xEDB88320) ^ table[i] >> 1 : table[i] >> 1;
    }
    const unsigned char *data = (const unsigned char *)bytes.ptr;
    for (size_t at = PNG_SIGNATURE;;) {
        uint32_t length = big_endian(data + at, 4);
        const unsigned char *end = data + at + 8 + length;
        uint32_t crc = UINT32_MAX;
        for (const unsigned char *p = data + at + 4; p < end; p++)
            crc = table[(crc ^ *p) & 0xFF] ^ crc >> 8;
        if (~crc != big_endian(end, 4))
            return "a chunk's checksum is wrong: the file is damaged";
        if (memcmp(data + at + 4, "IEND", 4) == 0)
            return NULL;
        at += PNG_FRAME + length;
    }
}

// ---- all kinds

const char *picture_read_header(str bytes, struct picture_header *out) {
    *out = (struct picture_header){0};
    if (str_starts_with(bytes, STR("\x89PNG\r\n\x1A\n"))) {
        out->kind = PICTURE_KIND_PNG;
        return png_header(bytes, out);
    }
    if (str_starts_with(bytes, STR("\xFF\xD8\xFF"))) {
        out->kind = PICTURE_KIND_JPEG;
        return jpeg_read_header(bytes, out);
    }
    if (str_starts_with(bytes, STR("#?"))) {
        out->kind = PICTURE_KIND_HDR;
        return hdr_read_header(bytes, out);
    }
    return NULL;
}

static const char *decode_hdr(str bytes, const struct picture_header *header, struct picture *out) {
    float *pixels = malloc((size_t)out->size_bytes);
    if (!pixels)
        return "there is not enough memory";
    const char *fault = hdr_read_pixels(bytes, header, pixels);
    if (fault)
        free(pixels);
    else
        out->pixels = pixels;
    return fault;
}

const char *picture_decode(str bytes, const struct picture_header *header, struct picture *out) {
    const char *fault = header->kind == PICTURE_KIND_PNG ? png_check(bytes) : NULL;
    if (fault)
        return fault;
    uint64_t pixels = (uint64_t)header->width * header->height;
    enum picture_depth depth = header->kind == PICTURE_KIND_HDR ? PICTURE_FLOAT
                               : header->is_16_bit              ? PICTURE_16
                                                                : PICTURE_8;
    unsigned channel_bytes = depth == PICTURE_FLOAT ? 4 : depth == PICTURE_16 ? 2 : 1;
    *out = (struct picture){.width = header->width,
                            .height = header->height,
                            .depth = depth,
                            .size_bytes = pixels * 4 * channel_bytes,
                            .ignored = header->ignored};
    if (depth == PICTURE_FLOAT)
        return decode_hdr(bytes, header, out);
    // Enough for the file's parts put together, what they inflate to, coefficients of a progressive JPEG,
    // the file's own channels and the result; what a lying file wants beyond that it does not get.
    struct stb_job job = {.bytes = bytes.ptr,
                          .count = bytes.len,
                          .is_16_bit = depth == PICTURE_16,
                          .budget_bytes =
                              (size_t)(pixels * 20 * channel_bytes + 4 * bytes.len + BUDGET_SLACK),
                          .width = header->width,
                          .height = header->height};
    out->pixels = stb_decode(&job, &fault);
    return fault;
}
