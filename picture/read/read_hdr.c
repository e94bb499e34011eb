#include "picture/read/read_hdr.h"

#include <string.h>

enum {
    RLE_WIDTH_MIN = 8, // rows outside these widths have no run lengths per channel
    RLE_WIDTH_MAX = 0x7FFF,
};

struct hdr_reader {
    const unsigned char *at;
    const unsigned char *end;
};

// The next line without its line end; false if the file ends first.
static bool next_line(str bytes, size_t *at, str *line) {
    const char *end = memchr(bytes.ptr + *at, '\n', bytes.len - *at);
    if (!end)
        return false;
    *line = str_slice(bytes, *at, (size_t)(end - bytes.ptr));
    *at = (size_t)(end - bytes.ptr) + 1;
    if (line->len && line->ptr[line->len - 1] == '\r')
        line->len--;
    return true;
}

// A number of at most 9 digits at the beginning of *text, which is moved past it.
static bool take_size(str *text, uint32_t *value) {
    size_t digits = 0;
    *value = 0;
    for (; digits < text->len && digits < 9 && text->ptr[digits] >= '0' && text->ptr[digits] <= '9'; digits++)
        *value = *value * 10 + (uint32_t)(text->ptr[digits] - '0');
    *text = str_slice(*text, digits, text->len);
    return digits > 0 && *value > 0;
}

static bool take(str *text, str part) {
    if (!str_starts_with(*text, part))
        return false;
    *text = str_slice(*text, part.len, text->len);
    return true;
}

const char *hdr_read_header(str bytes, struct picture_header *out) {
    size_t at = 0;
    str line;
    if (!next_line(bytes, &at, &line))
        return "the file ends within its header";
    while (next_line(bytes, &at, &line)) {
        if (line.len == 0) {
            if (!next_line(bytes, &at, &line))
                return "the file ends within its header";
            str rest = line;
            if (!take(&rest, STR("-Y ")) || !take_size(&rest, &out->height) || !take(&rest, STR(" +X ")) ||
                !take_size(&rest, &out->width) || str_trim(rest).len)
                return "its size line is not of the form '-Y HEIGHT +X WIDTH'";
            out->data_at = at;
            return NULL;
        }
        if (str_starts_with(line, STR("FORMAT=")) && !str_equal(line, STR("FORMAT=32-bit_rle_rgbe")))
            return "its format is not 32-bit_rle_rgbe";
        if (str_starts_with(line, STR("EXPOSURE=")) || str_starts_with(line, STR("COLORCORR=")) ||
            str_starts_with(line, STR("PRIMARIES=")) || str_starts_with(line, STR("GAMMA=")))
            out->ignored = "exposure or colour lines are";
    }
    return "the file ends within its header";
}

// One channel of a row: runs of one value (a count above 128) and of different ones.
static bool read_channel(struct hdr_reader *r, unsigned char *channel, uint32_t width) {
    uint32_t x = 0;
    while (x < width) {
        if (r->end - r->at < 2)
            return false;
        uint32_t count = *r->at++;
        bool is_run = count > 128;
        count -= is_run ? 128 : 0;
        if (count == 0 || count > width - x || (!is_run && (size_t)(r->end - r->at) < count))
            return false;
        for (uint32_t i = 0; i < count; i++)
            channel[4 * (size_t)x++] = is_run ? *r->at : r->at[i];
        r->at += is_run ? 1 : count;
    }
    return true;
}

// Pixels one by one, where 1 1 1 N repeats the last pixel N times; several of these in a row shift N by 8
// bits each.
static bool read_flat(struct hdr_reader *r, unsigned char *row, uint32_t width) {
    unsigned shift = 0;
    for (uint32_t x = 0; x < width;) {
        if (r->end - r->at < 4)
            return false;
        const unsigned char *p = r->at;
        r->at += 4;
        if (p[0] != 1 || p[1] != 1 || p[2] != 1) {
            memcpy(row + 4 * (size_t)x++, p, 4);
            shift = 0;
            continue;
        }
        uint64_t count = shift <= 24 ? (uint64_t)p[3] << shift : UINT64_MAX;
        shift += 8;
        if (x == 0 || count > width - x)
            return false;
        for (; count > 0; count--, x++)
            memcpy(row + 4 * (size_t)x, row + 4 * (size_t)(x - 1), 4);
    }
    return true;
}

static bool read_row(struct hdr_reader *r, unsigned char *row, uint32_t width) {
    const unsigned char *p = r->at;
    bool by_channel = width >= RLE_WIDTH_MIN && width <= RLE_WIDTH_MAX && r->end - p >= 4 && p[0] == 2 &&
                      p[1] == 2 && p[2] < 128;
    if (!by_channel)
        return read_flat(r, row, width);
    if ((uint32_t)p[2] << 8 != (width & 0xFF00) || p[3] != (width & 0xFF))
        return false;
    r->at += 4;
    for (int c = 0; c < 4; c++)
        if (!read_channel(r, row + c, width))
            return false;
    return true;
}

const char *hdr_read_rows(str bytes, const struct picture_header *header, struct picture_rows rows) {
    const unsigned char *data = (const unsigned char *)bytes.ptr;
    struct hdr_reader reader = {data + header->data_at, data + bytes.len};
    for (uint32_t y = 0; y < header->height; y++)
        if (!read_row(&reader, picture_row(&rows, y), header->width))
            return "its pixels are damaged, or the file ends before them";
    return NULL;
}
