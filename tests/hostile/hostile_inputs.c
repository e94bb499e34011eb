#include "hostile_inputs.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool put(const char *name, const void *bytes, size_t count) {
    FILE *file = fopen(name, "wb");
    bool good = file && fwrite(bytes, 1, count, file) == count;
    return (file ? fclose(file) == 0 : false) && good;
}

static bool put_text(const char *name, const char *text) {
    return put(name, text, strlen(text));
}

// `before`, then `count` times `unit`, then `after`.
static bool put_repeated(const char *name, const char *before, const char *unit, size_t count,
                         const char *after) {
    FILE *file = fopen(name, "wb");
    if (!file)
        return false;
    fputs(before, file);
    for (size_t i = 0; i < count; i++)
        fputs(unit, file);
    fputs(after, file);
    return fclose(file) == 0;
}

static bool alias_bomb(void) {
    FILE *file = fopen("bomb.yaml", "wb");
    if (!file)
        return false;
    fputs("glint: 1\nx-0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n", file);
    for (int i = 1; i < 10; i++) {
        fprintf(file, "x-%d: &a%d [", i, i);
        for (int k = 0; k < 10; k++)
            fprintf(file, "%s*a%d", k ? ", " : "", i - 1);
        fputs("]\n", file);
    }
    return fclose(file) == 0;
}

static bool mistakes(void) {
    FILE *file = fopen("mistakes.yaml", "wb");
    if (!file)
        return false;
    fputs("glint: 1\n", file);
    for (int i = 0; i < 100000; i++)
        fprintf(file, "nonsense%d: 1\n", i);
    return fclose(file) == 0;
}

static void put_chunk(FILE *file, const char *type, const uint8_t *data, uint32_t count) {
    uint8_t size[4] = {(uint8_t)(count >> 24), (uint8_t)(count >> 16), (uint8_t)(count >> 8), (uint8_t)count};
    uint8_t no_checksum[4] = {0}; // the decoder does not ask for it
    fwrite(size, 1, 4, file);
    fwrite(type, 1, 4, file);
    fwrite(data, 1, count, file);
    fwrite(no_checksum, 1, 4, file);
}

static bool put_png(const char *name, uint32_t width, uint32_t height, const uint8_t *stream,
                    uint32_t count) {
    FILE *file = fopen(name, "wb");
    if (!file)
        return false;
    uint8_t header[13] = {(uint8_t)(width >> 24),
                          (uint8_t)(width >> 16),
                          (uint8_t)(width >> 8),
                          (uint8_t)width,
                          (uint8_t)(height >> 24),
                          (uint8_t)(height >> 16),
                          (uint8_t)(height >> 8),
                          (uint8_t)height,
                          8,
                          2,
                          0,
                          0,
                          0};
    fwrite("\x89PNG\r\n\x1a\n", 1, 8, file);
    put_chunk(file, "IHDR", header, 13);
    put_chunk(file, "IDAT", stream, count);
    put_chunk(file, "IEND", header, 0);
    return fclose(file) == 0;
}

// A deflate stream of `runs` times 258 zero bytes: fixed codes (RFC 1951, 3.2.6), a literal 0, then
// matches of length 258 (symbol 285: 11000101) at distance 1 (00000), 13 bits each.
static uint8_t *zeros(uint32_t runs, uint32_t *count) {
    *count = 2 + (3 + 8 + runs * 13 + 7 + 7) / 8;
    uint8_t *stream = calloc(1, *count);
    if (!stream)
        return NULL;
    uint64_t bit = 16;
    stream[0] = 0x78;
    stream[1] = 0x01;
    static const char begin[] = "110"
                                "00110000"; // last block, fixed codes (low bit first); literal 0
    static const char run[] = "11000101"
                              "00000";
    for (const char *p = begin; *p; p++, bit++)
        stream[bit / 8] |= (uint8_t)((*p == '1') << (bit % 8));
    for (uint32_t i = 0; i < runs; i++)
        for (const char *p = run; *p; p++, bit++)
            stream[bit / 8] |= (uint8_t)((*p == '1') << (bit % 8));
    return stream;
}

static bool pngs(void) {
    uint32_t count = 0;
    uint8_t *megabyte = calloc(1, 1 << 20);
    uint8_t *stream = zeros(1040000, &count);
    bool good = megabyte && stream && put_png("huge.png", 65535, 65535, megabyte, 64) &&
                put_png("wide.png", 30000, 24000, megabyte, 1 << 20) &&
                put_png("inflates.png", 1, 1, stream, count);
    free(megabyte);
    free(stream);
    return good && put_text("huge-png.yaml", "glint: 1\nbackground: {image: huge.png}\n") &&
           put_text("wide-png.yaml", "glint: 1\nbackground: {image: wide.png}\n") &&
           put_text("inflates.yaml", "glint: 1\nbackground: {image: inflates.png}\n");
}

static bool special_files(void) {
    mkdir("folder.obj", 0777);
    unlink("link.obj");
    unlink("pipe.obj");
    return mkfifo("pipe.obj", 0666) == 0 && symlink("/dev/zero", "link.obj") == 0 &&
           put_text("zero.yaml", "glint: 1\nmodels: [{mesh: zero.obj}, {mesh: /dev/zero}]\n") &&
           put_text("link.yaml", "glint: 1\nmodels: [{mesh: link.obj}]\n") &&
           put_text("folder.yaml", "glint: 1\nmodels: [{mesh: folder.obj}]\n") &&
           put_text("pipe.yaml", "glint: 1\nmodels: [{mesh: pipe.obj}]\n");
}

bool hostile_make_inputs(void) {
    static const char nul_yaml[] = "glint: 1\ndescription: a\0b\n";
    static const char nul_xml[] = "<Scene\nglint=\"1\0\"/>\n";
    return alias_bomb() && mistakes() && pngs() && special_files() &&
           put_repeated("brackets.yaml", "glint: 1\nx-deep: ", "[", 200000, "\n") &&
           put_repeated("levels.xml", "<Scene glint=\"1\">", "<Model>", 100000, "\n") &&
           put_repeated("conflicts.yaml", "glint: 1\n", "<<<<<<< ours\n", 100000, "=======\n") &&
           put_repeated("scalar.yaml", "glint: 1\ndescription: ", "abcdefghij", 1 << 20, "\n") &&
           put_repeated("scalar.xml", "<Scene glint=\"1\" description=\"", "abcdefghij", 1 << 20, "\"/>\n") &&
           put_text("entities.xml",
                    "<?xml version=\"1.0\"?>\n<!DOCTYPE Scene [<!ENTITY a \"aaaa\"><!ENTITY b "
                    "\"&a;&a;&a;&a;\"><!ENTITY c \"&b;&b;&b;&b;\">]>\n<Scene glint=\"1\" "
                    "description=\"&c;\"/>\n") &&
           put("nul.yaml", nul_yaml, sizeof nul_yaml - 1) && put("nul.xml", nul_xml, sizeof nul_xml - 1) &&
           put_text("utf8.yaml", "glint: 1\n# fine\ndescription: caf\xE9\n") &&
           put_text("utf8.xml", "<Scene glint=\"1\">\n<!-- fine -->\n<!-- caf\xE9 -->\n</Scene>\n") &&
           put_text(
               "good.yaml",
               "glint: 1\nimage: {width: 64, height: 64}\nspheres: [{center: [0, 0, -5], radius: 2}]\n") &&
           put_text("kept.png", HOSTILE_KEPT_TEXT);
}
