#include "assets/picture_read.h"

#include "assets/read_hdr.h"
#include "assets/stb_decode.h"

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
                return "the first chunk is no header";
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

// ---- JPEG (ISO/IEC 10918-1): markers up to the first scan, and the end marker behind it

static bool jpeg_has_end(const unsigned char *data, size_t size, size_t at) {
    while (at + 1 < size) {
        const unsigned char *mark = memchr(data + at, 0xFF, size - 1 - at);
        if (!mark)
            return false;
        if (mark[1] == 0xD9)
            return true;
        at = (size_t)(mark - data) + 1;
    }
    return false;
}

static const char *jpeg_frame(const unsigned char *segment, uint32_t length, unsigned marker,
                              struct picture_header *out) {
    if (marker > 0xC2)
        return "it is lossless, hierarchical or arithmetically coded; save it as baseline or progressive";
    if (length < 8)
        return "its frame header is too short";
    out->height = big_endian(segment + 3, 2);
    out->width = big_endian(segment + 5, 2);
    return out->width && out->height ? NULL : "its width or height is 0";
}

static const char *jpeg_header(str bytes, struct picture_header *out) {
    const unsigned char *data = (const unsigned char *)bytes.ptr;
    bool profile = false;
    size_t scan = 0;
    for (size_t at = 2; scan == 0;) {
        while (at + 1 < bytes.len && data[at] == 0xFF && data[at + 1] == 0xFF)
            at++; // fill bytes
        if (bytes.len - at < 4)
            return "the file ends before the picture";
        unsigned marker = data[at + 1];
        uint32_t length = big_endian(data + at + 2, 2);
        const unsigned char *segment = data + at + 2;
        if (data[at] != 0xFF || length < 2)
            return "a marker is expected where there is none";
        if (length > bytes.len - at - 2)
            return "the file ends within a segment";
        scan = marker == 0xDA ? at + 2 + length : 0;
        bool is_frame =
            marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        const char *fault = is_frame ? jpeg_frame(segment, length, marker, out) : NULL;
        if (fault)
            return fault;
        profile |= marker == 0xE2 && length >= 14 && memcmp(segment + 2, "ICC_PROFILE", 12) == 0;
        at += 2 + (size_t)length;
    }
    out->ignored = name_ignored(false, profile);
    if (out->width == 0)
        return "it has no frame header";
    return jpeg_has_end(data, bytes.len, scan) ? NULL : "the file ends within the picture";
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
        return jpeg_header(bytes, out);
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
