#include "tests/agree/damaged.h"

#include "tests/unit/kit/png_kit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SIDE = 4,
    ROW = 1 + 3 * SIDE, // a filter and RGB
};

// ---- PNG

// A picture of SIDE x SIDE as a zlib stream, its rows beginning with `filter`.
static void put_stream(struct strbuf *out, int rows, char filter) {
    unsigned char raw[SIDE * ROW];
    for (size_t i = 0; i < sizeof raw; i++)
        raw[i] = (unsigned char)(i % ROW == 0 ? filter : (char)(i * 37));
    png_put_stream(out, raw, (size_t)(rows * ROW));
}

static void put_png(struct strbuf *out, char depth, char color, const struct strbuf *stream) {
    png_put_header(out, SIDE, SIDE, depth, color, 0);
    png_put_chunk(out, "IDAT", stream->data, stream->len);
    png_put_chunk(out, "IEND", NULL, 0);
}

static void put_rows(struct strbuf *out, int rows, char filter, char depth, char color) {
    struct strbuf stream;
    strbuf_init(&stream);
    put_stream(&stream, rows, filter);
    put_png(out, depth, color, &stream);
    strbuf_finish(&stream);
}

static void png_whole(struct strbuf *out) {
    put_rows(out, SIDE, 0, 8, 2);
}
static void png_rows_missing(struct strbuf *out) {
    put_rows(out, SIDE / 2, 0, 8, 2);
}
static void png_filter(struct strbuf *out) {
    put_rows(out, SIDE, 5, 8, 2);
}
static void png_palette(struct strbuf *out) {
    put_rows(out, SIDE, 0, 8, 3);
}
static void png_depth(struct strbuf *out) {
    put_rows(out, SIDE, 0, 3, 2);
}
static void png_color(struct strbuf *out) {
    put_rows(out, SIDE, 0, 8, 5);
}

static void png_bad_checksum(struct strbuf *out) {
    png_whole(out);
    out->data[out->len - 12 - 1] ^= 1; // the last byte before the end chunk
}

static void png_cut(struct strbuf *out) {
    struct strbuf stream;
    strbuf_init(&stream);
    put_stream(&stream, SIDE, 0);
    stream.len /= 2;
    put_png(out, 8, 2, &stream);
    strbuf_finish(&stream);
}

static void png_zlib(struct strbuf *out) {
    struct strbuf stream;
    strbuf_init(&stream);
    put_stream(&stream, SIDE, 0);
    stream.data[0] = 0x7F;
    put_png(out, 8, 2, &stream);
    strbuf_finish(&stream);
}

static void png_much(struct strbuf *out) {
    struct strbuf stream;
    strbuf_init(&stream);
    put_stream(&stream, SIDE, 0);
    for (int i = 0; i < 1 << 17; i++)
        strbuf_char(&stream, (char)i);
    put_png(out, 8, 2, &stream);
    strbuf_finish(&stream);
}

static void png_twice(struct strbuf *out) {
    png_put_header(out, SIDE, SIDE, 8, 2, 0);
    struct strbuf second;
    strbuf_init(&second);
    png_put_header(&second, SIDE + 1, SIDE, 8, 2, 0);
    strbuf_add(out, second.data + 8, second.len - 8);
    strbuf_clear(&second);
    put_stream(&second, SIDE, 0);
    png_put_chunk(out, "IDAT", second.data, second.len);
    png_put_chunk(out, "IEND", NULL, 0);
    strbuf_finish(&second);
}

// ---- JPEG: a whole file, of which a field is changed

// The bytes after the length of the first segment with this marker.
static unsigned char *segment(struct strbuf *file, unsigned marker) {
    unsigned char *data = (unsigned char *)file->data;
    size_t at = 2;
    while (data[at + 1] != marker)
        at += 2 + ((size_t)data[at + 2] << 8 | data[at + 3]);
    return data + at + 4;
}

static void put_file(struct strbuf *out, const char *path) {
    char bytes[1024];
    FILE *file = fopen(path, "rb");
    if (!file)
        abort();
    strbuf_add(out, bytes, fread(bytes, 1, sizeof bytes, file));
    fclose(file);
}

static void jpeg_whole(struct strbuf *out) {
    put_file(out, "tests/data/image/gray.jpg");
}

enum marker {
    FRAME = 0xC0,
    HUFFMAN = 0xC4,
    SCAN = 0xDA,
    QUANTIZATION = 0xDB,
};

static void jpeg_sampling(struct strbuf *out) {
    jpeg_whole(out);
    segment(out, FRAME)[7] = 0x01;
}
static void jpeg_huffman(struct strbuf *out) {
    jpeg_whole(out);
    segment(out, HUFFMAN)[1] = 3; // codes of one bit
}
static void jpeg_no_huffman(struct strbuf *out) {
    jpeg_whole(out);
    segment(out, HUFFMAN)[0] = 3;
}
static void jpeg_no_quantization(struct strbuf *out) {
    jpeg_whole(out);
    segment(out, QUANTIZATION)[0] = 1;
}
static void jpeg_quantization(struct strbuf *out) {
    jpeg_whole(out);
    segment(out, QUANTIZATION)[0] = 9;
}
static void jpeg_component(struct strbuf *out) {
    jpeg_whole(out);
    segment(out, SCAN)[1] = 7;
}
static void jpeg_rows_missing(struct strbuf *out) {
    jpeg_whole(out);
    segment(out, FRAME)[1] = 4;
}
static void jpeg_depth(struct strbuf *out) {
    jpeg_whole(out);
    segment(out, FRAME)[0] = 12;
}

// ---- Radiance HDR

static void put_hdr(struct strbuf *out, const char *size, const void *pixels, size_t count) {
    strbuf_format(out, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n%s\n", size);
    strbuf_add(out, pixels, count);
}

static void hdr_whole(struct strbuf *out) {
    put_hdr(out, "-Y 1 +X 8", "\2\2\0\x08\x88\x80\x88\x40\x88\0\x88\x81", 12);
}
static void hdr_run(struct strbuf *out) {
    put_hdr(out, "-Y 1 +X 8", "\2\2\0\x08\x89\x80\x88\x40\x88\0\x88\x81", 12);
}
static void hdr_values(struct strbuf *out) {
    put_hdr(out, "-Y 1 +X 8", "\2\2\0\x08\x09\1\2\3\4\5\6\7\x08\x09\x88\x40\x88\0\x88\x81", 20);
}
static void hdr_old_run(struct strbuf *out) {
    put_hdr(out, "-Y 1 +X 5", "\x80\x40\x20\x81\1\1\1\5", 8);
}
static void hdr_first_run(struct strbuf *out) {
    put_hdr(out, "-Y 1 +X 5", "\1\1\1\4\x80\x40\x20\x81", 8);
}
static void hdr_width(struct strbuf *out) {
    put_hdr(out, "-Y 1 +X 8", "\2\2\0\x09\x89\x80\x89\x40\x89\0\x89\x81", 12);
}
static void hdr_cut(struct strbuf *out) {
    put_hdr(out, "-Y 2 +X 8", "\2\2\0\x08\x88\x80\x88\x40\x88\0\x88\x81", 12);
}

// ---- OpenEXR

static void exr_whole(struct strbuf *out) {
    put_file(out, "tests/fuzz/seeds/image/zip.exr");
}
static void exr_half(struct strbuf *out) {
    put_file(out, "tests/fuzz/seeds/image/half.exr");
}
static void exr_head_cut(struct strbuf *out) {
    exr_whole(out);
    out->len = 100;
}
static void exr_cut(struct strbuf *out) {
    exr_whole(out);
    out->len -= 20;
}
static void exr_stream(struct strbuf *out) {
    exr_whole(out);
    memset(out->data + out->len - 40, 0x55, 40);
}
static void exr_no_colors(struct strbuf *out) {
    exr_whole(out);
    char *name = out->data; // "R", and not that of "pixelAspectRatio"
    while (memcmp(name, "R", 2) != 0)
        name++;
    *name = 'Q';
}

#define PIXELS "its pixels are damaged"
const struct damaged damaged_images[] = {
    {"PNG", NULL, png_whole},
    {"PNG, too little data", PIXELS, png_rows_missing},
    {"PNG, data that end early", PIXELS, png_cut},
    {"PNG, far too much data", "more data than a picture of its size needs", png_much},
    {"PNG, an unknown filter", PIXELS, png_filter},
    {"PNG, a bad zlib header", PIXELS, png_zlib},
    {"PNG, no palette", "its header or its palette is damaged", png_palette},
    {"PNG, 3 bits", "its header or its palette is damaged", png_depth},
    {"PNG, an unknown colour type", "its header or its palette is damaged", png_color},
    {"PNG, a wrong checksum", "a chunk's checksum is wrong", png_bad_checksum},
    {"PNG, two headers", "its header or its palette is damaged", png_twice},
    {"JPEG", NULL, jpeg_whole},
    {"JPEG, a sampling factor of 0", "its frame header is damaged", jpeg_sampling},
    {"JPEG, a bad Huffman table", "a Huffman table is damaged", jpeg_huffman},
    {"JPEG, no Huffman table", "a scan uses a table that the file does not have", jpeg_no_huffman},
    {"JPEG, no quantization table", "a scan uses a table that the file does not have", jpeg_no_quantization},
    {"JPEG, a bad quantization table", "a quantization table is damaged", jpeg_quantization},
    {"JPEG, a scan of no component", "a scan header is damaged", jpeg_component},
    {"JPEG, too little data", "the data of a scan end too early", jpeg_rows_missing},
    {"JPEG, 12 bits", "it does not have 8 bits per channel", jpeg_depth},
    {"HDR", NULL, hdr_whole},
    {"HDR, a run beyond its row", PIXELS, hdr_run},
    {"HDR, values beyond their row", PIXELS, hdr_values},
    {"HDR, an old run beyond its row", PIXELS, hdr_old_run},
    {"HDR, an old run of nothing", PIXELS, hdr_first_run},
    {"HDR, another width", PIXELS, hdr_width},
    {"HDR, rows missing", PIXELS, hdr_cut},
    {"OpenEXR", NULL, exr_whole},
    {"OpenEXR, halves by PIZ", NULL, exr_half},
    {"OpenEXR, a header that ends early", "its header is damaged, or the file ends within it", exr_head_cut},
    {"OpenEXR, too little data", PIXELS, exr_cut},
    {"OpenEXR, a damaged stream", PIXELS, exr_stream},
    {"OpenEXR, no red", "it has no channels R, G and B", exr_no_colors},
};
const int damaged_count = sizeof damaged_images / sizeof *damaged_images;
