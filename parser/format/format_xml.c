#include "parser/format/format_internal.h"
#include "parser/tree/xml_scan.h"

#include <string.h>

enum piece_kind {
    PIECE_OPEN, // <A ...>
    PIECE_LEAF, // <A .../>
    PIECE_CLOSE,
    PIECE_COMMENT,
    PIECE_OTHER, // an instruction, a DOCTYPE, text between elements
};

// A piece between spaces at the level of elements.
struct piece {
    uint32_t kind; // piece_kind
    uint32_t begin, end;
    uint32_t close; // PIECE_OPEN: the index of its closing tag
};

struct printer {
    struct arena *arena;
    str text;
    uint32_t begin;
    struct {
        struct piece *items;
        uint32_t count, capacity;
    } pieces;
    struct {
        uint32_t *items;
        uint32_t count, capacity;
    } open; // while pieces are found: indices of the tags that are open
    struct format_lines *lines;
    struct format_place place; // of the last comment
    uint32_t gap;              // where the last piece ended
};

// ---- pieces

// After the '>' of the DOCTYPE at `at`; 0: there is none.
static uint32_t behind_doctype(const struct printer *p, uint32_t at) {
    char quote = '\0';
    for (; at < p->text.len; at++) {
        char c = p->text.ptr[at];
        if (quote)
            quote = c == quote ? '\0' : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (c == '>')
            return at + 1;
    }
    return 0;
}

static uint32_t behind_text(const struct printer *p, uint32_t at) {
    uint32_t end = at;
    while (at && at < p->text.len) {
        bool data = str_starts_with(str_slice(p->text, at, p->text.len), STR("<![CDATA["));
        if (p->text.ptr[at] == '<' && !data)
            break;
        uint32_t next = data ? xml_behind(p->text, at, "]]>") : at + 1;
        end = char_is_space(p->text.ptr[at]) ? end : next;
        at = next;
    }
    return at ? end : 0;
}

// The offset after the opening tag at `at`; 0: it has no end.
static uint32_t behind_tag(const struct printer *p, uint32_t at, uint32_t *kind) {
    struct xml_attribute ignored;
    enum xml_tag_end end;
    at = xml_name_end(p->text, at);
    do
        end = xml_next_attribute(p->text, &at, &ignored);
    while (end == XML_TAG_MORE);
    *kind = end == XML_TAG_OPEN ? PIECE_OPEN : PIECE_LEAF;
    return end == XML_TAG_MALFORMED ? 0 : xml_behind(p->text, at, ">");
}

static struct piece next_piece(const struct printer *p, uint32_t at) {
    str rest = str_slice(p->text, at, p->text.len);
    struct piece piece = {.kind = PIECE_OTHER, .begin = at};
    if (str_starts_with(rest, STR("<!--"))) {
        piece.kind = PIECE_COMMENT;
        piece.end = xml_behind(p->text, at + 4, "-->");
    } else if (str_starts_with(rest, STR("<?"))) {
        piece.end = xml_behind(p->text, at, "?>");
    } else if (str_starts_with(rest, STR("<!DOCTYPE"))) {
        piece.end = behind_doctype(p, at);
    } else if (str_starts_with(rest, STR("</"))) {
        piece.kind = PIECE_CLOSE;
        piece.end = xml_behind(p->text, at, ">");
    } else if (rest.ptr[0] == '<' && !str_starts_with(rest, STR("<![CDATA["))) {
        piece.end = behind_tag(p, at, &piece.kind);
    } else {
        piece.end = behind_text(p, at);
    }
    return piece;
}

static bool find_pieces(struct printer *p) {
    for (uint32_t at = p->begin; at < p->text.len;) {
        if (char_is_space(p->text.ptr[at])) {
            at++;
            continue;
        }
        struct piece piece = next_piece(p, at);
        uint32_t index = p->pieces.count;
        if (piece.end <= at || (piece.kind == PIECE_CLOSE && p->open.count == 0))
            return false;
        *ARENA_PUSH(p->arena, &p->pieces) = piece;
        if (piece.kind == PIECE_OPEN)
            *ARENA_PUSH(p->arena, &p->open) = index;
        else if (piece.kind == PIECE_CLOSE)
            p->pieces.items[p->open.items[--p->open.count]].close = index;
        at = piece.end;
    }
    return p->open.count == 0;
}

// ---- tags

struct attribute {
    str name, value; // the value with its quotes
};

// The next attribute from *at on, which moves past it; false: the tag ends.
static bool next_attribute(const struct printer *p, uint32_t *at, struct attribute *attribute) {
    struct xml_attribute place;
    if (xml_next_attribute(p->text, at, &place) != XML_TAG_MORE)
        return false;
    attribute->name = str_slice(p->text, place.name_begin, place.name_end);
    attribute->value = str_slice(p->text, place.value_begin - 1, place.value_end + 1);
    return true;
}

static str piece_text(const struct printer *p, const struct piece *piece) {
    return str_slice(p->text, piece->begin, piece->end);
}

static uint32_t name_end(const struct printer *p, const struct piece *tag) {
    return xml_name_end(p->text, tag->kind == PIECE_CLOSE ? tag->begin + 1 : tag->begin);
}

static const char *tag_end(const struct piece *piece) {
    return piece->kind == PIECE_LEAF ? "/>" : ">";
}

// Columns of a tag on one line; UINT32_MAX if a value holds a line end.
static uint32_t tag_width(const struct printer *p, const struct piece *piece) {
    uint32_t at = name_end(p, piece);
    str name = str_slice(p->text, piece->begin, at);
    size_t width = utf8_count(name) + strlen(tag_end(piece));
    struct attribute a;
    while (next_attribute(p, &at, &a)) {
        if (memchr(a.value.ptr, '\n', a.value.len) || memchr(a.value.ptr, '\r', a.value.len))
            return UINT32_MAX;
        width += 2 + utf8_count(a.name) + utf8_count(a.value);
    }
    return (uint32_t)width;
}

// A value as written, line ends and spaces included.
static void put_value(struct printer *p, str value) {
    size_t begin = 0;
    for (size_t i = 0; i < value.len; i++) {
        if (!char_is_break(value.ptr[i]))
            continue;
        format_lines_text(p->lines, str_slice(value, begin, i));
        format_lines_next(p->lines, 0, 0);
        i += str_break_length(value, i) - 1;
        begin = i + 1;
    }
    format_lines_text(p->lines, str_slice(value, begin, value.len));
}

// Characters of an attribute; a line end is one, however it is written: the file may get another one.
static size_t attribute_width(const struct attribute *a) {
    size_t width = utf8_count(a->name) + 1 + utf8_count(a->value);
    for (size_t i = 0; i < a->value.len; i++)
        width -= str_break_length(a->value, i) == 2;
    return width;
}

// A tag; attributes that do not fit into the line continue below the first one, if they fit at all.
static void put_tag(struct printer *p, const struct piece *piece) {
    uint32_t at = name_end(p, piece);
    uint32_t ending = (uint32_t)strlen(tag_end(piece));
    format_lines_text(p->lines, str_slice(p->text, piece->begin, at));
    uint32_t first = p->lines->column + 1;
    struct attribute a;
    for (bool begun = false; next_attribute(p, &at, &a); begun = true) {
        size_t width = 1 + attribute_width(&a) + ending;
        if (begun && p->lines->column + width > FORMAT_WIDTH && first + width - 1 <= FORMAT_WIDTH)
            format_lines_next(p->lines, 0, first);
        else
            format_lines_text(p->lines, STR(" "));
        format_lines_text(p->lines, a.name);
        format_lines_text(p->lines, STR("="));
        put_value(p, a.value);
    }
    format_lines_text(p->lines, str_from(tag_end(piece)));
}

// ---- elements

static bool on_one_line(const struct printer *p, uint32_t begin, uint32_t end) {
    for (uint32_t i = begin; i < end; i++)
        if (char_is_break(p->text.ptr[i]))
            return false;
    return true;
}

// Whether an element that its author wrote on one line fits there, without comments in it.
static bool is_flat(const struct printer *p, uint32_t first, uint32_t last, uint32_t indent) {
    const struct piece *items = p->pieces.items;
    uint64_t width = indent;
    if (!on_one_line(p, items[first].begin, items[last].end))
        return false;
    for (uint32_t i = first; i <= last && width <= FORMAT_WIDTH; i++) {
        const struct piece *piece = &items[i];
        if (piece->kind == PIECE_COMMENT || (piece->kind == PIECE_OTHER && p->text.ptr[piece->begin] == '<'))
            return false;
        width += piece->kind == PIECE_OTHER ? utf8_count(piece_text(p, piece)) : tag_width(p, piece);
    }
    return width <= FORMAT_WIDTH;
}

static void put_plain(struct printer *p, const struct piece *piece) {
    if (piece->kind == PIECE_OTHER)
        format_lines_moved(p->lines, piece_text(p, piece), format_column(p->text, &p->place, piece->begin));
    else
        put_tag(p, piece);
}

static void begin_line(struct printer *p, const struct piece *piece, uint32_t indent) {
    uint32_t breaks = 0;
    for (uint32_t i = p->gap; i < piece->begin; i++) {
        breaks += char_is_break(p->text.ptr[i]);
        i += (uint32_t)str_break_length(p->text, i) - 1;
    }
    uint32_t blank = breaks > 1 ? breaks - 1 : 0;
    format_lines_next(p->lines, blank < FORMAT_BLANK_MOST ? blank : FORMAT_BLANK_MOST, indent);
}

static void put_comment(struct printer *p, const struct piece *piece, uint32_t indent) {
    str comment = piece_text(p, piece);
    uint32_t column = format_column(p->text, &p->place, piece->begin);
    if (p->lines->begun && on_one_line(p, p->gap, piece->begin)) {
        format_lines_comment(p->lines, comment, column);
        return;
    }
    begin_line(p, piece, indent);
    format_lines_moved(p->lines, comment, column);
}

// The pieces from `first` to before `last`, each on lines of its own. Nesting is only a number, the
// indentation, so that depth costs no stack.
static void put_pieces(struct printer *p) {
    uint32_t depth = 0;
    for (uint32_t i = 0; i < p->pieces.count; i++) {
        const struct piece *piece = &p->pieces.items[i];
        depth -= piece->kind == PIECE_CLOSE;
        uint32_t indent = depth * FORMAT_INDENT;
        uint32_t last = i;
        if (piece->kind == PIECE_COMMENT) {
            put_comment(p, piece, indent);
        } else {
            begin_line(p, piece, indent);
            bool is_empty = piece->kind == PIECE_OPEN && piece->close == i + 1;
            bool flat = piece->kind == PIECE_OPEN && (is_empty || is_flat(p, i, piece->close, indent));
            last = flat ? piece->close : i;
            depth += piece->kind == PIECE_OPEN && !flat;
            for (uint32_t j = i; j <= last; j++)
                put_plain(p, &p->pieces.items[j]);
        }
        p->gap = p->pieces.items[last].end;
        i = last;
    }
}

bool format_xml(struct arena *arena, str text, uint32_t begin, struct format_lines *lines) {
    struct printer p = {.arena = arena,
                        .text = text,
                        .begin = begin,
                        .gap = begin,
                        .lines = lines,
                        .place = {begin, 0, false}};
    if (!find_pieces(&p) || p.pieces.count == 0)
        return false;
    put_pieces(&p);
    return true;
}
