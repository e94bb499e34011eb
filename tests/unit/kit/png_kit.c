#include "png_kit.h"

uint32_t png_checksum(const void *bytes, size_t n) {
    const unsigned char *p = bytes;
    uint32_t crc = UINT32_MAX;
    for (size_t i = 0; i < n; i++) {
        crc ^= p[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc & 1 ? UINT32_C(0xEDB88320) ^ crc >> 1 : crc >> 1;
    }
    return ~crc;
}

static void put32(struct strbuf *out, uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        strbuf_char(out, (char)(value >> shift & 0xFF));
}

void png_put_chunk(struct strbuf *out, const char *type, const void *data, size_t size) {
    put32(out, (uint32_t)size);
    size_t begin = out->len;
    strbuf_cstr(out, type);
    strbuf_add(out, data, size);
    put32(out, png_checksum(out->data + begin, out->len - begin));
}

void png_put_header(struct strbuf *out, uint32_t width, uint32_t height, char depth, char color,
                    char interlace) {
    struct strbuf header;
    strbuf_init(&header);
    put32(&header, width);
    put32(&header, height);
    strbuf_add(&header, (char[5]){depth, color, 0, 0, interlace}, 5);
    strbuf_add(out, "\x89PNG\r\n\x1A\n", 8);
    png_put_chunk(out, "IHDR", header.data, header.len);
    strbuf_finish(&header);
}

void png_put_stream(struct strbuf *out, const void *rows, size_t size) {
    strbuf_add(
        out, (unsigned char[7]){0x78, 0x01, 1, size & 0xFF, size >> 8, ~size & 0xFF, (~size >> 8) & 0xFF}, 7);
    strbuf_add(out, rows, size);
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < size; i++) {
        a = (a + ((const unsigned char *)rows)[i]) % 65521;
        b = (b + a) % 65521;
    }
    put32(out, b << 16 | a);
}

void png_put_rows(struct strbuf *out, const void *rows, size_t size) {
    struct strbuf data;
    strbuf_init(&data);
    png_put_stream(&data, rows, size);
    png_put_chunk(out, "IDAT", data.data, data.len);
    png_put_chunk(out, "IEND", NULL, 0);
    strbuf_finish(&data);
}
