#include "lsp/position.h"

#include "core/strbuf.h"

#include <string.h>

// Units that the character at `at` takes in a line.
static uint32_t units(str text, size_t at, enum position_encoding encoding, size_t *length) {
    *length = utf8_sequence_length(text, at);
    if (*length == 0)
        *length = 1;
    if (encoding == POSITION_UTF8)
        return (uint32_t)*length;
    return encoding == POSITION_UTF16 && *length == 4 ? 2 : 1;
}

static size_t line_begin(str text, uint32_t line) {
    size_t at = 0;
    for (; line > 0 && at < text.len; line--) {
        const char *end = memchr(text.ptr + at, '\n', text.len - at);
        at = end ? (size_t)(end - text.ptr) + 1 : text.len;
    }
    return at;
}

size_t position_offset(str text, enum position_encoding encoding, uint32_t line, uint32_t character) {
    size_t at = line_begin(text, line);
    uint32_t count = 0;
    while (at < text.len && text.ptr[at] != '\n' && text.ptr[at] != '\r') {
        size_t length;
        uint32_t more = units(text, at, encoding, &length);
        if (count + more > character)
            break;
        count += more;
        at += length;
    }
    return at;
}

void position_of(str text, enum position_encoding encoding, size_t offset, uint32_t *line,
                 uint32_t *character) {
    size_t begin = 0;
    offset = offset < text.len ? offset : text.len;
    *line = 0;
    *character = 0;
    for (size_t i = 0; i < offset; i++) {
        if (text.ptr[i] != '\n')
            continue;
        ++*line;
        begin = i + 1;
    }
    while (begin < offset) {
        size_t length;
        *character += units(text, begin, encoding, &length);
        begin += length;
    }
}

static bool read_unsigned(const json_t *object, const char *key, uint32_t *out) {
    const json_t *value = json_object_get(object, key);
    json_int_t number = json_integer_value(value);
    *out = (uint32_t)(number < 0 ? 0 : number > UINT32_MAX ? UINT32_MAX : number);
    return json_is_integer(value);
}

size_t position_read(str text, enum position_encoding encoding, const json_t *position) {
    uint32_t line;
    uint32_t character;
    if (!read_unsigned(position, "line", &line) || !read_unsigned(position, "character", &character))
        return text.len;
    return position_offset(text, encoding, line, character);
}

static json_t *position_object(str text, enum position_encoding encoding, size_t offset) {
    uint32_t line;
    uint32_t character;
    json_t *position = json_object();
    position_of(text, encoding, offset, &line, &character);
    json_object_set_new(position, "line", json_integer(line));
    json_object_set_new(position, "character", json_integer(character));
    return position;
}

json_t *position_range(str text, enum position_encoding encoding, size_t begin, size_t end) {
    json_t *range = json_object();
    json_object_set_new(range, "start", position_object(text, encoding, begin));
    json_object_set_new(range, "end", position_object(text, encoding, end));
    return range;
}

static int hex_digit(char c) {
    if (c >= '0' && c <= '9')
        return c - '0';
    c |= 0x20;
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

str position_path(struct arena *arena, const char *uri) {
    static const char scheme[] = "file://";
    if (strncmp(uri, scheme, sizeof scheme - 1) != 0)
        return STR("");
    const char *from = strchr(uri + sizeof scheme - 1, '/'); // behind a host, if there is one
    if (!from)
        return STR("");
    char *path = arena_alloc(arena, strlen(from) + 1);
    size_t length = 0;
    while (*from && *from != '?' && *from != '#') {
        int high = *from == '%' ? hex_digit(from[1]) : -1;
        int low = high >= 0 ? hex_digit(from[2]) : -1;
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
