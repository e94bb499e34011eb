#include "picture/read/texts.h"

#include <string.h>

struct texts {
    struct picture_text *items;
    uint32_t count, most;
};

static void add(struct texts *texts, str keyword, str text) {
    if (texts->count < texts->most)
        texts->items[texts->count++] = (struct picture_text){keyword, text};
}

static str from(str s, size_t begin) {
    return str_slice(s, begin, s.len);
}

// The part before the first byte of this value; all if there is none.
static str until(str s, char end) {
    const char *at = s.len ? memchr(s.ptr, end, s.len) : NULL;
    return at ? (str){s.ptr, (size_t)(at - s.ptr)} : s;
}

// "Keyword: text"
static void add_line(struct texts *texts, str line) {
    const str keyword = until(line, ':');
    if (keyword.len < line.len)
        add(texts, str_trim(keyword), str_trim(from(line, keyword.len + 1)));
}

static uint32_t big(str s, size_t at) {
    const uint8_t *b = (const uint8_t *)s.ptr + at;
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

static uint32_t little(str s, size_t at) {
    const uint8_t *b = (const uint8_t *)s.ptr + at;
    return (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0];
}

// ---- PNG

enum {
    PNG_HEAD = 8,
    PNG_FRAME = 12, // length, type and checksum of a chunk
    ITXT_FLAGS = 2,
};

// After the keyword: whether it is compressed, and how; a language, and the keyword in it.
static void add_itxt(struct texts *texts, str keyword, str rest) {
    if (rest.len < ITXT_FLAGS || rest.ptr[0] != 0)
        return;
    rest = from(rest, ITXT_FLAGS);
    for (int i = 0; i < 2; i++)
        rest = from(rest, until(rest, '\0').len + 1);
    add(texts, keyword, rest);
}

static void png_texts(str bytes, struct texts *texts) {
    for (size_t at = PNG_HEAD; at + PNG_FRAME <= bytes.len;) {
        const uint32_t length = big(bytes, at);
        if (length > bytes.len - at - PNG_FRAME)
            return;
        const str type = {bytes.ptr + at + 4, 4}, data = {bytes.ptr + at + 8, length};
        const str keyword = until(data, '\0');
        if (str_equal(type, STR("tEXt")))
            add(texts, keyword, from(data, keyword.len + 1));
        else if (str_equal(type, STR("iTXt")))
            add_itxt(texts, keyword, from(data, keyword.len + 1));
        at += PNG_FRAME + (size_t)length;
    }
}

// ---- JPEG

enum {
    JPEG_HEAD = 2,
    JPEG_FRAME = 4, // marker and length of a segment
    JPEG_MARK = 0xff,
    JPEG_SCAN = 0xda,
    JPEG_COMMENT = 0xfe,
};

static void jpeg_texts(str bytes, struct texts *texts) {
    for (size_t at = JPEG_HEAD; at + JPEG_FRAME <= bytes.len;) {
        const uint32_t head = big(bytes, at), marker = head >> 16 & 0xff, length = head & 0xffff;
        if (head >> 24 != JPEG_MARK || marker == JPEG_SCAN || length < 2 || length + 2 > bytes.len - at)
            return;
        if (marker == JPEG_COMMENT)
            add_line(texts, (str){bytes.ptr + at + JPEG_FRAME, length - 2});
        at += length + 2;
    }
}

// ---- OpenEXR

enum {
    EXR_HEAD = 8,
};

// Attributes: name, type, size, value; an empty name ends them.
static void exr_texts(str bytes, struct texts *texts) {
    for (size_t at = EXR_HEAD; at < bytes.len;) {
        const str name = until(from(bytes, at), '\0');
        at += name.len + 1;
        const str type = until(from(bytes, at), '\0');
        at += type.len + 1;
        if (name.len == 0 || at > bytes.len || bytes.len - at < 4)
            return;
        const uint32_t size = little(bytes, at);
        at += 4;
        if (size > bytes.len - at)
            return;
        if (str_equal(type, STR("string")))
            add(texts, name, (str){bytes.ptr + at, size});
        at += size;
    }
}

// ---- Radiance

static void hdr_texts(str bytes, struct texts *texts) {
    while (bytes.len) {
        const str line = until(bytes, '\n');
        if (line.len == 0)
            return; // the head ends
        if (line.ptr[0] == '#' && !str_starts_with(line, STR("#?")))
            add_line(texts, from(line, 1));
        bytes = from(bytes, line.len + 1);
    }
}

uint32_t picture_texts(str bytes, struct picture_text *out, uint32_t most) {
    struct texts texts = {.items = out, .most = most};
    if (str_starts_with(bytes, STR("\x89PNG\r\n\x1A\n")))
        png_texts(bytes, &texts);
    else if (str_starts_with(bytes, STR("\xFF\xD8\xFF")))
        jpeg_texts(bytes, &texts);
    else if (str_starts_with(bytes, STR("v/1\x01")))
        exr_texts(bytes, &texts);
    else if (str_starts_with(bytes, STR("#?")))
        hdr_texts(bytes, &texts);
    return texts.count;
}

static char lower(char c) {
    return (char)(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
}

bool picture_keyword_is(str keyword, str other) {
    size_t i = 0, k = 0;
    for (;;) {
        while (i < keyword.len && keyword.ptr[i] == ' ')
            i++;
        while (k < other.len && other.ptr[k] == ' ')
            k++;
        if (i == keyword.len || k == other.len)
            return i == keyword.len && k == other.len;
        if (lower(keyword.ptr[i++]) != lower(other.ptr[k++]))
            return false;
    }
}
