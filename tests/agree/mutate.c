#include "tests/agree/mutate.h"

#include "tests/unit/kit/png_kit.h"
#include "tests/unit/kit/random.h"

#include <string.h>

enum {
    CHANGES_MOST = 3,
    SIGNATURE = 8,
    FRAME = 12, // length, type and checksum of a chunk
};

static size_t below(uint64_t *state, size_t count) {
    return (size_t)(random_bits(state) % count);
}

static bool is_number_part(char c) {
    return (c >= '0' && c <= '9') || c == '.' || c == '-';
}

// Replaces a number, the first at or after a place.
static void replace_number(struct strbuf *out, uint64_t *state) {
    static const char *const hard[] = {"0",   "-0",    "-1",    "1e300", "1e18", "9.9e17",
                                       "nan", "1e-30", "99999", "1/2/3", "-1e9", "4294967296"};
    size_t at = below(state, out->len);
    while (at < out->len && !is_number_part(out->data[at]))
        at++;
    size_t end = at;
    while (end < out->len && is_number_part(out->data[end]))
        end++;
    struct strbuf rest;
    strbuf_init(&rest);
    strbuf_add(&rest, out->data + end, out->len - end);
    out->len = at;
    strbuf_cstr(out, hard[below(state, sizeof hard / sizeof *hard)]);
    strbuf_str(out, strbuf_view(&rest));
    strbuf_finish(&rest);
}

static void leave_out(struct strbuf *out, uint64_t *state) {
    size_t at = below(state, out->len), count = 1 + below(state, 8);
    count = count < out->len - at ? count : out->len - at;
    memmove(out->data + at, out->data + at + count, out->len - at - count);
    out->len -= count;
}

static void put_twice(struct strbuf *out, uint64_t *state) {
    char piece[16];
    size_t at = below(state, out->len), count = 1 + below(state, sizeof piece);
    count = count < out->len - at ? count : out->len - at;
    memcpy(piece, out->data + at, count);
    strbuf_add(out, piece, count); // for its room; what is behind moves up
    memmove(out->data + at + count, out->data + at, out->len - at - count);
    memcpy(out->data + at, piece, count);
}

static void change(struct strbuf *out, uint64_t *state, bool is_text) {
    switch (below(state, is_text ? 9 : 6)) {
    case 0:
        leave_out(out, state);
        return;
    case 1:
        put_twice(out, state);
        return;
    case 2:
        out->len = below(state, out->len) + 1;
        return;
    case 3:
        out->data[below(state, out->len)] = (char)(below(state, 2) ? 0xFF : 0);
        return;
    case 4:
    case 5:
        out->data[below(state, out->len)] ^= (char)(1 << below(state, 8));
        return;
    default:
        replace_number(out, state);
    }
}

void mutate(str bytes, uint64_t seed, bool is_text, struct strbuf *out) {
    uint64_t state = seed;
    strbuf_clear(out);
    strbuf_str(out, bytes);
    for (size_t i = 1 + below(&state, CHANGES_MOST); i > 0 && out->len > 0; i--)
        change(out, &state, is_text);
}

static uint32_t read32(const unsigned char *p) {
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

void mutate_repair_png(struct strbuf *file) {
    unsigned char *data = (unsigned char *)file->data;
    if (file->len < SIGNATURE || memcmp(data, "\x89PNG", 4) != 0)
        return;
    for (size_t at = SIGNATURE; file->len - at >= FRAME;) {
        uint32_t length = read32(data + at);
        if (length > file->len - at - FRAME)
            return;
        uint32_t sum = png_checksum(data + at + 4, (size_t)length + 4);
        at += 8 + (size_t)length;
        for (int i = 0; i < 4; i++)
            data[at++] = (unsigned char)(sum >> (24 - 8 * i));
    }
}
