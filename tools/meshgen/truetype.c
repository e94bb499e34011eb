#include "tools/meshgen/truetype.h"

#include <string.h>

enum {
    EM = 1000,
    ASCENT = 800,
    DESCENT = -200,
    GAP = 100,
    CAPITAL = 700,
    SMALL = 505,
    TABLES = 10,
    CODES_MAX = 256, // letters of a font
};

struct font {
    const struct truetype_letter *letters;
    int count;
    const struct truetype_names *names;
    int left, bottom, right, top, points_most, contours_most, advance_most;
    uint32_t starts[CODES_MAX + 1]; // of each letter in glyf
};

static void put8(struct strbuf *to, uint32_t value) {
    const char byte = (char)(value & 0xFF);
    strbuf_add(to, &byte, 1);
}

static void put16(struct strbuf *to, int value) {
    put8(to, (uint32_t)value >> 8);
    put8(to, (uint32_t)value);
}

static void put32(struct strbuf *to, uint32_t value) {
    put16(to, (int)(value >> 16));
    put16(to, (int)(value & 0xFFFF));
}

static void put_many(struct strbuf *to, const int *values, int count) {
    for (int i = 0; i < count; i++)
        put16(to, values[i]);
}

#define PUT(to, ...)                                                                                         \
    put_many(to, (const int[]){__VA_ARGS__}, (int)(sizeof((const int[]){__VA_ARGS__}) / sizeof(int)))

static void pad(struct strbuf *to, size_t to_bytes) {
    while (!to->failed && to->len % to_bytes != 0)
        put8(to, 0);
}

// ---- outlines

// A difference of 0 has a flag and no byte, up to 255 a byte and a flag with its sign, else two bytes.
static uint32_t flags_of(int d, uint32_t is_byte, uint32_t is_same) {
    return d == 0 ? is_same : d > 0 && d < 256 ? is_byte | is_same : d < 0 && d > -256 ? is_byte : 0;
}

static void put_difference(struct strbuf *to, int d) {
    if (d > -256 && d < 256 && d != 0)
        put8(to, (uint32_t)(d < 0 ? -d : d));
    else if (d != 0)
        put16(to, d);
}

static void put_glyph(const struct glyph *glyph, struct strbuf *to) {
    const struct glyph_point *points = glyph->points;
    if (glyph->contour_count == 0)
        return;
    PUT(to, glyph->contour_count, glyph->left, glyph->bottom, glyph->right, glyph->top);
    put_many(to, glyph->ends, glyph->contour_count);
    put16(to, 0); // no instructions
    for (int i = 0; i < glyph->point_count; i++) {
        const int dx = points[i].x - (i ? points[i - 1].x : 0), dy = points[i].y - (i ? points[i - 1].y : 0);
        const uint32_t overlaps = i == 0 ? 0x40 : 0;
        put8(to, flags_of(dx, 2, 0x10) | flags_of(dy, 4, 0x20) | points[i].on | overlaps);
    }
    for (int i = 0; i < glyph->point_count; i++)
        put_difference(to, points[i].x - (i ? points[i - 1].x : 0));
    for (int i = 0; i < glyph->point_count; i++)
        put_difference(to, points[i].y - (i ? points[i - 1].y : 0));
    pad(to, 2);
}

static void write_glyf(struct font *font, struct strbuf *to) {
    const size_t begin = to->len;
    for (int i = 0; i < font->count; i++) {
        font->starts[i] = (uint32_t)(to->len - begin);
        put_glyph(&font->letters[i].glyph, to);
    }
    font->starts[font->count] = (uint32_t)(to->len - begin);
}

static void write_loca(struct font *font, struct strbuf *to) {
    for (int i = 0; i <= font->count; i++)
        put16(to, (int)(font->starts[i] / 2));
}

// ---- what the font says about itself

static int greater(int a, int b) {
    return a > b ? a : b;
}

static void measure(struct font *font) {
    for (int i = 0; i < font->count; i++) {
        const struct glyph *glyph = &font->letters[i].glyph;
        font->left = -greater(-font->left, -glyph->left);
        font->bottom = -greater(-font->bottom, -glyph->bottom);
        font->right = greater(font->right, glyph->right);
        font->top = greater(font->top, glyph->top);
        font->points_most = greater(font->points_most, glyph->point_count);
        font->contours_most = greater(font->contours_most, glyph->contour_count);
        font->advance_most = greater(font->advance_most, font->letters[i].advance);
    }
}

static void write_head(struct font *font, struct strbuf *to) {
    PUT(to, 1, 0, 1, 0); // versions of the table and of the font
    put32(to, 0);        // the file's sum, put in at the end
    put32(to, 0x5F0F3CF5);
    PUT(to, 3, EM);
    PUT(to, 0, 0, 0, 0, 0, 0, 0, 0); // no times
    PUT(to, font->left, font->bottom, font->right, font->top);
    PUT(to, 0, 8, 2, 0, 0); // regular, readable from 8 pixels on; short places
}

static void write_hhea(struct font *font, struct strbuf *to) {
    PUT(to, 1, 0, ASCENT, DESCENT, GAP, font->advance_most, font->left, 0, font->right, 1, 0, 0, 0, 0, 0, 0,
        0, font->count);
}

static void write_hmtx(struct font *font, struct strbuf *to) {
    for (int i = 0; i < font->count; i++)
        PUT(to, font->letters[i].advance, font->letters[i].glyph.left);
}

static void write_maxp(struct font *font, struct strbuf *to) {
    PUT(to, 1, 0, font->count, font->points_most, font->contours_most, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0);
}

static void write_os2(struct font *font, struct strbuf *to) {
    int mean = 0, inked = 0;
    for (int i = 0; i < font->count; i++) {
        mean += font->letters[i].advance;
        inked += font->letters[i].advance > 0;
    }
    PUT(to, 4, mean / inked, 400, 5, 0);
    PUT(to, 650, 600, 0, 75, 650, 600, 0, 350, 50, 300,
        0);                          // small raised and lowered letters, a line through
    PUT(to, 0, 0, 0, 0, 0);          // no class
    PUT(to, 0, 3, 0, 0, 0, 0, 0, 0); // Latin
    strbuf_add(to, "GLNT", 4);
    PUT(to, 0x40, font->letters[1].code, font->letters[font->count - 1].code, ASCENT, DESCENT, GAP, ASCENT,
        -DESCENT);
    PUT(to, 0, 1, 0, 0, SMALL, CAPITAL, 0, ' ', 0);
}

static void write_post(struct font *font, struct strbuf *to) {
    (void)font;
    PUT(to, 3, 0, 0, 0, -75, 50, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
}

static void write_name(struct font *font, struct strbuf *to) {
    const struct truetype_names *names = font->names;
    const struct {
        int id;
        const char *text;
    } rows[] = {{1, names->family}, {2, names->style},  {3, names->postscript},
                {4, names->family}, {5, "Version 1.0"}, {6, names->postscript}};
    const int count = sizeof rows / sizeof rows[0];
    int at = 0;
    PUT(to, 0, count, 6 + 12 * count);
    for (int i = 0; i < count; i++) {
        const int size = 2 * (int)strlen(rows[i].text);
        PUT(to, 3, 1, 0x409, rows[i].id, size, at);
        at += size;
    }
    for (int i = 0; i < count; i++)
        for (const char *c = rows[i].text; *c; c++)
            put16(to, *c);
}

// Codes that follow each other are a range, whose letters do too.
static void write_cmap(struct font *font, struct strbuf *to) {
    int first[CODES_MAX], last[CODES_MAX], delta[CODES_MAX], count = 0, power = 1, log = 0;
    for (int i = 1; i < font->count; i++) {
        const int code = font->letters[i].code;
        if (count == 0 || last[count - 1] != code - 1) {
            first[count] = code;
            delta[count++] = i - code;
        }
        last[count - 1] = code;
    }
    first[count] = last[count] = 0xFFFF;
    delta[count++] = 1;
    for (; 2 * power <= count; power *= 2)
        log++;
    PUT(to, 0, 1, 3, 1, 0, 12);
    PUT(to, 4, 16 + 8 * count, 0, 2 * count, 2 * power, log, 2 * (count - power));
    put_many(to, last, count);
    put16(to, 0);
    put_many(to, first, count);
    put_many(to, delta, count);
    for (int i = 0; i < count; i++)
        put16(to, 0);
}

// ---- the file

static uint32_t sum_of(const struct strbuf *bytes, size_t from, size_t to) {
    uint32_t sum = 0;
    for (size_t i = from; i < to; i++)
        sum += (uint32_t)(unsigned char)bytes->data[i] << (24 - 8 * (i % 4));
    return sum;
}

static const struct table {
    char tag[5];
    void (*write)(struct font *font, struct strbuf *to);
} IN_FILE[TABLES] = {
    {"OS/2", write_os2},  {"cmap", write_cmap}, {"glyf", write_glyf}, {"head", write_head},
    {"hhea", write_hhea}, {"hmtx", write_hmtx}, {"loca", write_loca}, {"maxp", write_maxp},
    {"name", write_name}, {"post", write_post},
};

void truetype_write(const struct truetype_letter *letters, int count, const struct truetype_names *names,
                    struct strbuf *bytes) {
    struct font font = {.letters = letters, .count = count < CODES_MAX ? count : CODES_MAX, .names = names};
    const size_t header = 12 + 16 * TABLES;
    size_t head = 0;
    struct strbuf body, list;
    strbuf_init(&body);
    strbuf_init(&list);
    measure(&font);
    PUT(&list, 1, 0, TABLES, 128, 3, 16 * TABLES - 128);
    for (int i = 0; i < TABLES; i++) {
        const size_t from = body.len;
        IN_FILE[i].write(&font, &body);
        const size_t size = body.len - from;
        pad(&body, 4);
        if (!strcmp(IN_FILE[i].tag, "head"))
            head = header + from;
        strbuf_add(&list, IN_FILE[i].tag, 4);
        put32(&list, body.failed ? 0 : sum_of(&body, from, body.len));
        put32(&list, (uint32_t)(header + from));
        put32(&list, (uint32_t)size);
    }
    if (!body.failed && !list.failed) {
        strbuf_add(bytes, list.data, list.len);
        strbuf_add(bytes, body.data, body.len);
    }
    if (body.failed || list.failed)
        bytes->failed = true;
    if (!bytes->failed) {
        const uint32_t rest = 0xB1B0AFBAu - sum_of(bytes, 0, bytes->len);
        for (int i = 0; i < 4; i++)
            bytes->data[head + 8 + (size_t)i] = (char)(rest >> (24 - 8 * i));
    }
    strbuf_finish(&list);
    strbuf_finish(&body);
}
