#include "lsp/position.h"

#include "core/heap.h"
#include "core/strbuf.h"

#include <stdlib.h>
#include <string.h>

enum {
    MARK_BYTES = 512, // from one mark to the next, at least
};

// The units of the encoding that the character at `at` takes.
static uint32_t units(str text, size_t at, enum position_encoding encoding, size_t *length) {
    *length = utf8_sequence_length(text, at);
    if (*length == 0)
        *length = 1;
    if (encoding == POSITION_UTF8)
        return (uint32_t)*length;
    return encoding == POSITION_UTF16 && *length == 4 ? 2 : 1;
}

// The beginning of the line before the one that begins at `at`, which is not the first.
static size_t line_before(str text, size_t at) {
    at -= at >= 2 && text.ptr[at - 1] == '\n' && text.ptr[at - 2] == '\r' ? 2 : 1;
    while (at > 0 && !char_is_break(text.ptr[at - 1]))
        at--;
    return at;
}

// Walks from the place where the last search ended, or from the beginning if that is nearer.
static size_t line_begin(str text, uint32_t line, struct position_hint *hint) {
    if (line < hint->line / 2)
        *hint = (struct position_hint){0};
    for (; hint->line > line; hint->line--)
        hint->begin = line_before(text, hint->begin);
    while (hint->line < line) {
        size_t at = hint->begin;
        while (at < text.len && !char_is_break(text.ptr[at]))
            at++;
        if (at == text.len)
            return text.len;
        hint->begin = at + str_break_length(text, at);
        hint->line++;
    }
    return hint->begin;
}

static size_t find_offset(str text, enum position_encoding encoding, uint32_t line, uint32_t character,
                          struct position_hint *hint) {
    size_t at = line_begin(text, line, hint);
    uint32_t count = 0;
    while (at < text.len && !char_is_break(text.ptr[at])) {
        size_t length;
        uint32_t more = units(text, at, encoding, &length);
        if (character - count < more)
            break;
        count += more;
        at += length;
    }
    return at;
}

// ---- from bytes to positions

static void step(str text, enum position_encoding encoding, struct position_mark *at) {
    unsigned char c = (unsigned char)text.ptr[at->offset];
    if (char_is_break((char)c)) {
        *at = (struct position_mark){at->offset + str_break_length(text, at->offset), at->line + 1, 0};
        return;
    }
    size_t length = 1;
    at->character += c < 0x80 ? 1 : units(text, at->offset, encoding, &length);
    at->offset += length;
}

static bool add_mark(struct position_index *index, struct position_mark mark) {
    struct position_mark *marks = heap_grow(index->marks, index->count, &index->capacity, sizeof *marks);
    if (!marks)
        return false;
    index->marks = marks;
    index->marks[index->count++] = mark;
    return true;
}

void position_index_use(struct position_index *index, str text, enum position_encoding encoding) {
    if (index->text.ptr == text.ptr && index->text.len == text.len && index->encoding == encoding)
        return;
    struct position_mark at = {0};
    index->text = text;
    index->encoding = encoding;
    index->count = 0;
    for (size_t next = MARK_BYTES; at.offset < text.len; step(text, encoding, &at)) {
        if (at.offset < next)
            continue;
        if (!add_mark(index, at))
            return;
        next = at.offset + MARK_BYTES;
    }
}

void position_index_forget(struct position_index *index) {
    index->text = STR("");
    index->count = 0;
}

void position_index_finish(struct position_index *index) {
    free(index->marks);
    *index = (struct position_index){0};
}

static void position_of(const struct position_index *index, size_t offset, uint32_t *line,
                        uint32_t *character) {
    size_t low = 0;
    size_t high = index->count; // marks before `low` are not after the offset, those from `high` on are
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (index->marks[middle].offset <= offset)
            low = middle + 1;
        else
            high = middle;
    }
    struct position_mark at = {0};
    struct position_mark next = low ? index->marks[low - 1] : at;
    while (next.offset <= offset) {
        at = next;
        if (at.offset >= index->text.len)
            break;
        step(index->text, index->encoding, &next);
    }
    *line = at.line;
    *character = at.character;
}

static bool read_unsigned(const json_t *object, const char *key, uint32_t *out) {
    const json_t *value = json_object_get(object, key);
    json_int_t number = json_integer_value(value);
    *out = (uint32_t)(number < 0 ? 0 : number > UINT32_MAX ? UINT32_MAX : number);
    return json_is_integer(value);
}

size_t position_read(str text, enum position_encoding encoding, const json_t *position,
                     struct position_hint *hint) {
    struct position_hint none = {0};
    uint32_t line;
    uint32_t character;
    if (!read_unsigned(position, "line", &line) || !read_unsigned(position, "character", &character))
        return text.len;
    return find_offset(text, encoding, line, character, hint ? hint : &none);
}

static json_t *position_object(const struct position_index *index, size_t offset) {
    uint32_t line;
    uint32_t character;
    json_t *position = json_object();
    position_of(index, offset, &line, &character);
    json_object_set_new(position, "line", json_integer(line));
    json_object_set_new(position, "character", json_integer(character));
    return position;
}

json_t *position_range(const struct position_index *index, size_t begin, size_t end) {
    json_t *range = json_object();
    json_object_set_new(range, "start", position_object(index, begin));
    json_object_set_new(range, "end", position_object(index, end));
    return range;
}

json_t *position_range_once(str text, enum position_encoding encoding, size_t begin, size_t end) {
    const struct position_index index = {.text = text, .encoding = encoding};
    return position_range(&index, begin, end);
}

str position_clip(str text, size_t most) {
    size_t length = text.len < most ? text.len : most;
    while (length > 0 && length < text.len && ((unsigned char)text.ptr[length] & 0xC0) == 0x80)
        length--;
    return str_slice(text, 0, length);
}

json_t *position_string(str text) {
    json_t *string = json_stringn(text.len ? text.ptr : "", text.len);
    if (string)
        return string;
    struct strbuf whole;
    strbuf_init(&whole);
    for (size_t at = 0; at < text.len;) {
        size_t length = utf8_sequence_length(text, at);
        if (length)
            strbuf_str(&whole, str_slice(text, at, at + length));
        else
            strbuf_cstr(&whole, "\xEF\xBF\xBD");
        at += length ? length : 1;
    }
    string = json_stringn(whole.data ? whole.data : "", whole.len);
    strbuf_finish(&whole);
    return string ? string : json_string("");
}

str position_path(struct arena *arena, const char *uri) {
    static const char scheme[] = "file://";
    if (strncmp(uri, scheme, sizeof scheme - 1) != 0)
        return STR("");
    const char *from = strchr(uri + sizeof scheme - 1, '/'); // after a host, if there is one
    if (!from)
        return STR("");
    char *path = arena_alloc(arena, strlen(from) + 1);
    size_t length = 0;
    while (*from && *from != '?' && *from != '#') {
        int high = *from == '%' ? char_hex(from[1]) : -1;
        int low = high >= 0 ? char_hex(from[2]) : -1;
        path[length++] = low >= 0 ? (char)(high << 4 | low) : *from;
        from += low >= 0 ? 3 : 1;
    }
    return (str){path, length};
}

// (RFC 3986: unreserved characters, and '/'.)
static bool stands_plain(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           (c && strchr("-._~/", c));
}

str position_uri(struct arena *arena, str path) {
    struct strbuf uri;
    strbuf_init(&uri);
    strbuf_cstr(&uri, "file://");
    for (size_t i = 0; i < path.len; i++) {
        if (stands_plain(path.ptr[i]))
            strbuf_char(&uri, path.ptr[i]);
        else
            strbuf_format(&uri, "%%%02X", (unsigned char)path.ptr[i]);
    }
    str copy = arena_copy(arena, strbuf_view(&uri));
    strbuf_finish(&uri);
    return copy;
}
