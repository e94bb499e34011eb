#include "assets/ply/ply_rows.h"
#include "diag/codes/file.h"

#include "assets/file/mesh_number.h"
#include "core/float_bits.h"

#include <math.h>

// ---- text

static bool more_words(struct ply_cursor *c) {
    while (c->at < c->end && char_is_blank(*c->at))
        c->at++;
    return c->at < c->end && !char_is_break(*c->at);
}

static str take_word(struct ply_cursor *c) {
    const char *begin = c->at;
    while (c->at < c->end && !char_is_space(*c->at))
        c->at++;
    return (str){begin, (size_t)(c->at - begin)};
}

static void take_line_end(struct ply_cursor *c) {
    if (c->at == c->end)
        return;
    c->at += *c->at == '\r' && c->at + 1 < c->end && c->at[1] == '\n' ? 2 : 1;
    c->line++;
}

static void skip_line(struct ply_cursor *c) {
    while (c->at < c->end && !char_is_break(*c->at))
        c->at++;
    take_line_end(c);
}

static enum ply_status text_number(struct ply_cursor *c, double *value, enum number_status *why) {
    if (!more_words(c))
        return PLY_ENDS;
    const size_t length = number_take((str){c->at, (size_t)(c->end - c->at)}, value);
    if (length && (c->at + length == c->end || char_is_space(c->at[length]))) {
        c->at += length;
        return PLY_OK;
    }
    *why = mesh_number(take_word(c), value);
    return *why == NUMBER_OK ? PLY_OK : PLY_BAD;
}

// ---- binary

static uint64_t load(const char *at, unsigned bytes, bool is_big) {
    const unsigned char *b = (const unsigned char *)at;
    uint64_t bits = 0;
    for (unsigned i = 0; i < bytes; i++)
        bits |= (uint64_t)b[is_big ? bytes - 1 - i : i] << 8 * i;
    return bits;
}

static uint32_t load32(const char *at, bool is_big) {
    const unsigned char *b = (const unsigned char *)at;
    return is_big ? (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3]
                  : (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0];
}

static double binary_number(const char *at, enum ply_type type, bool is_big) {
    switch (type) {
    case PLY_FLOAT32:
        return (double)float_of_bits(load32(at, is_big));
    case PLY_INT32:
        return (int32_t)load32(at, is_big);
    case PLY_UINT32:
        return load32(at, is_big);
    case PLY_UINT8:
        return *(const unsigned char *)at;
    case PLY_INT8:
        return *(const signed char *)at;
    case PLY_INT16:
        return (int16_t)load(at, 2, is_big);
    case PLY_UINT16:
        return (uint16_t)load(at, 2, is_big);
    case PLY_INT64:
        return (double)(int64_t)load(at, 8, is_big);
    case PLY_UINT64:
        return (double)load(at, 8, is_big);
    default:
        return double_of_bits(load(at, 8, is_big));
    }
}

// ---- both

enum ply_status ply_number(struct ply_cursor *c, enum ply_type type, double *value, enum number_status *why) {
    if (c->form == PLY_TEXT)
        return text_number(c, value, why);
    if ((size_t)(c->end - c->at) < ply_type_bytes[type])
        return PLY_ENDS;
    *value = binary_number(c->at, type, c->form == PLY_BIG);
    c->at += ply_type_bytes[type];
    return PLY_OK;
}

enum ply_status ply_count(struct ply_cursor *c, enum ply_type type, uint32_t *count) {
    double value;
    enum number_status why;
    const enum ply_status status = ply_number(c, type, &value, &why);
    if (status != PLY_OK)
        return status;
    if (!(value >= 0 && value < UINT32_MAX) || floor(value) != value)
        return PLY_BAD;
    *count = (uint32_t)value;
    return PLY_OK;
}

bool ply_skip(struct ply_cursor *c, enum ply_type type, uint64_t count) {
    if (c->form != PLY_TEXT) {
        const bool fits = count <= (size_t)(c->end - c->at) / ply_type_bytes[type];
        c->at = fits ? c->at + count * ply_type_bytes[type] : c->end;
        return fits;
    }
    for (; count && more_words(c); count--)
        take_word(c);
    return count == 0;
}

void ply_begin_row(struct ply_cursor *c) {
    while (c->form == PLY_TEXT && c->at < c->end && !more_words(c) && c->at < c->end)
        take_line_end(c);
}

bool ply_end_row(struct ply_cursor *c) {
    if (c->form != PLY_TEXT)
        return true;
    const bool ends = !more_words(c);
    skip_line(c);
    return ends;
}

struct ply_cursor ply_piece(const struct ply_extent *extent, size_t piece) {
    struct ply_cursor cursor = extent->begin;
    if (extent->starts) {
        cursor.at = extent->starts[piece].at;
        cursor.line = extent->starts[piece].line;
    } else {
        cursor.at += piece * PLY_PIECE * extent->element->bytes_least;
    }
    return cursor;
}

// ---- walking

// Moves past the next row; *items is the length of its list. In text, only the list's count is read, and the
// rest of the line checked to be long enough for it.
static enum ply_status walk_row(struct ply_cursor *c, const struct ply_extent *extent, uint32_t *items) {
    const struct ply_element *element = extent->element;
    const bool is_text = c->form == PLY_TEXT;
    if (is_text && c->at == c->end)
        return PLY_ENDS;
    for (uint32_t i = 0; i < element->properties.count && (!is_text || extent->list != PLY_ABSENT); i++) {
        const struct ply_property *property = &element->properties.items[i];
        uint32_t count = 1;
        const enum ply_status status = property->count ? ply_count(c, property->count, &count) : PLY_OK;
        if (status != PLY_OK)
            return status;
        if (i == extent->list)
            *items = count;
        if (is_text && i == extent->list)
            break;
        if (!ply_skip(c, property->type, count))
            return PLY_ENDS;
    }
    const char *after = c->at;
    if (is_text)
        skip_line(c);
    return is_text && *items > (size_t)(c->at - after) ? PLY_ENDS : PLY_OK;
}

static void report_row(struct asset_file *file, const struct ply_extent *extent, uint32_t row,
                       const struct ply_cursor *at, enum ply_status status) {
    const struct ply_element *element = extent->element;
    const bool in_line = at->form == PLY_TEXT && at->at < at->end;
    const char *what = status != PLY_ENDS ? "the number of a list's items is wrong"
                       : in_line          ? "the line ends"
                                          : "the file ends";
    if (at->form != PLY_TEXT)
        asset_report_byte(file, DIAG_MESH_SYNTAX, (uint64_t)(at->at - file->text.ptr),
                          "%s in '%.*s' number %u of %u", what, STR_ARG(element->name), row + 1,
                          element->count);
    else
        asset_report_line(file, DIAG_MESH_SYNTAX, at->line, "%s in '%.*s' number %u of %u", what,
                          STR_ARG(element->name), row + 1, element->count);
}

// Walks over rows that have one list with a one-byte length, and nothing else of varying length. Returns how
// many rows precede the first fault, which the general way reports.
static uint32_t walk_plain(struct ply_cursor *cursor, struct ply_extent *extent) {
    const struct ply_element *element = extent->element;
    const uint32_t size = ply_type_bytes[element->properties.items[extent->list].type];
    uint32_t before = 0, row = 0;
    for (uint32_t i = 0; i < extent->list; i++)
        before += ply_type_bytes[element->properties.items[i].type];
    const char *at = cursor->at;
    for (; row < element->count; row++) {
        if ((size_t)(cursor->end - at) < element->bytes_least)
            break;
        const uint32_t items = (unsigned char)at[before];
        if ((size_t)(cursor->end - at) - element->bytes_least < (size_t)items * size)
            break;
        if (row % PLY_PIECE == 0)
            extent->starts[row / PLY_PIECE] = (struct ply_start){at, cursor->line, (uint32_t)extent->items};
        at += element->bytes_least + (size_t)items * size;
        extent->items += items;
        extent->items_most = items > extent->items_most ? items : extent->items_most;
    }
    cursor->at = at;
    return row;
}

static bool is_plain(const struct ply_cursor *cursor, const struct ply_extent *extent) {
    const struct ply_element *element = extent->element;
    if (cursor->form == PLY_TEXT || extent->list == PLY_ABSENT)
        return false;
    for (uint32_t i = 0; i < element->properties.count; i++)
        if (element->properties.items[i].count && i != extent->list)
            return false;
    return element->properties.items[extent->list].count == PLY_UINT8;
}

bool ply_walk(struct asset_file *file, struct arena *arena, struct ply_cursor *cursor,
              struct ply_extent *extent) {
    const struct ply_element *element = extent->element;
    extent->begin = *cursor;
    if (element->properties.count == 0)
        return true;
    // The header was checked against the size of the file: all these rows are there.
    if (cursor->form != PLY_TEXT && !element->has_lists)
        return ply_skip(cursor, PLY_UINT8, (uint64_t)element->count * element->bytes_least);
    extent->starts = ARENA_ARRAY(arena, struct ply_start, element->count / PLY_PIECE + 1);
    for (uint32_t row = is_plain(cursor, extent) ? walk_plain(cursor, extent) : 0; row < element->count;
         row++) {
        if (row % PLY_PIECE == 0)
            extent->starts[row / PLY_PIECE] =
                (struct ply_start){cursor->at, cursor->line, (uint32_t)extent->items};
        ply_begin_row(cursor);
        const struct ply_cursor before = *cursor;
        uint32_t items = 0;
        const enum ply_status status = walk_row(cursor, extent, &items);
        if (status != PLY_OK) {
            report_row(file, extent, row, &before, status);
            return false;
        }
        extent->items += items;
        extent->items_most = items > extent->items_most ? items : extent->items_most;
    }
    return true;
}
