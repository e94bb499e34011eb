#include "core/str.h"

#include "core/unicode.h"

#include <string.h>

enum {
    NAME_LETTERS_MAX = 128
};

str str_from(const char *cstring) {
    return (str){cstring ? cstring : "", cstring ? strlen(cstring) : 0};
}

int str_compare(str a, str b) {
    size_t n = a.len < b.len ? a.len : b.len;
    int order = n ? memcmp(a.ptr, b.ptr, n) : 0;
    if (order)
        return order;
    return a.len < b.len ? -1 : a.len > b.len;
}

bool str_starts_with(str s, str prefix) {
    return s.len >= prefix.len && str_equal(str_slice(s, 0, prefix.len), prefix);
}

bool str_ends_with_nocase(str s, const char *suffix) {
    size_t n = strlen(suffix);
    if (s.len < n)
        return false;
    for (size_t i = 0; i < n; i++)
        if (char_lower(s.ptr[s.len - n + i]) != char_lower(suffix[i]))
            return false;
    return true;
}

str str_trim(str s) {
    while (s.len && char_is_space(s.ptr[0]))
        s = str_slice(s, 1, s.len);
    while (s.len && char_is_space(s.ptr[s.len - 1]))
        s.len--;
    return s;
}

size_t str_yaml_break_length(str s, size_t at) {
    if (char_is_break(s.ptr[at]))
        return str_break_length(s, at);
    const unsigned char *p = (const unsigned char *)s.ptr + at;
    if (p[0] == 0xC2)
        return at + 1 < s.len && p[1] == 0x85 ? 2 : 0;
    return p[0] == 0xE2 && at + 2 < s.len && p[1] == 0x80 && (p[2] == 0xA8 || p[2] == 0xA9) ? 3 : 0;
}

bool str_yaml_break_before(str s, size_t end) {
    return (end >= 1 && char_is_break(s.ptr[end - 1])) ||
           (end >= 2 && str_yaml_break_length(s, end - 2) == 2) ||
           (end >= 3 && str_yaml_break_length(s, end - 3) == 3);
}

str str_line_end(str text) {
    size_t lf = 0, crlf = 0, cr = 0;
    for (size_t i = 0; i < text.len; i++) {
        bool pair = text.ptr[i] == '\r' && i + 1 < text.len && text.ptr[i + 1] == '\n';
        crlf += pair;
        cr += text.ptr[i] == '\r' && !pair;
        lf += text.ptr[i] == '\n';
        i += pair;
    }
    if (crlf > lf && crlf >= cr)
        return STR("\r\n");
    return cr > lf ? STR("\r") : STR("\n");
}

uint64_t str_hash(str s) {
    uint64_t h = UINT64_C(14695981039346656037);
    for (size_t i = 0; i < s.len; i++)
        h = (h ^ (unsigned char)s.ptr[i]) * UINT64_C(1099511628211);
    return h;
}

// Eight bytes at a time: a byte is below 0x20 if subtracting 0x20 borrows into its highest bit, and 0x7F if
// adding 1 carries into it.
size_t str_skip_printable(str s, size_t at) {
    const uint64_t ones = UINT64_C(0x0101010101010101), high = ones * 0x80;
    uint64_t eight;
    while (s.len - at >= sizeof eight) {
        memcpy(&eight, s.ptr + at, sizeof eight);
        if (((eight - ones * 0x20) | (eight + ones) | eight) & high)
            break;
        at += sizeof eight;
    }
    while (at < s.len && (unsigned char)s.ptr[at] >= 0x20 && (unsigned char)s.ptr[at] < 0x7F)
        at++;
    return at;
}

size_t utf8_sequence_length(str s, size_t at) {
    if (at >= s.len)
        return 0;
    const unsigned char *p = (const unsigned char *)s.ptr + at;
    size_t left = s.len - at;
    if (p[0] < 0x80)
        return 1;
    size_t n = p[0] >= 0xC2 && p[0] <= 0xDF   ? 2
               : (p[0] & 0xF0) == 0xE0        ? 3
               : p[0] >= 0xF0 && p[0] <= 0xF4 ? 4
                                              : 0;
    if (n == 0 || left < n)
        return 0;
    for (size_t i = 1; i < n; i++)
        if ((p[i] & 0xC0) != 0x80)
            return 0;
    if ((p[0] == 0xE0 && p[1] < 0xA0) || (p[0] == 0xED && p[1] > 0x9F) || (p[0] == 0xF0 && p[1] < 0x90) ||
        (p[0] == 0xF4 && p[1] > 0x8F))
        return 0;
    return n;
}

// Where the run of ASCII that begins at `at` ends, eight bytes at a time: scenes and meshes are nearly all
// ASCII.
static size_t skip_ascii(str s, size_t at) {
    uint64_t eight;
    while (s.len - at >= sizeof eight) {
        memcpy(&eight, s.ptr + at, sizeof eight);
        if (eight & UINT64_C(0x8080808080808080))
            break;
        at += sizeof eight;
    }
    while (at < s.len && (unsigned char)s.ptr[at] < 0x80)
        at++;
    return at;
}

size_t utf8_first_error(str s) {
    for (size_t at = skip_ascii(s, 0); at < s.len; at = skip_ascii(s, at)) {
        size_t n = utf8_sequence_length(s, at);
        if (n == 0)
            return at;
        at += n;
    }
    return s.len;
}

uint32_t utf8_decode(str s, size_t at) {
    const unsigned char *p = (const unsigned char *)s.ptr + at;
    switch (utf8_sequence_length(s, at)) {
    case 2:
        return (uint32_t)(p[0] & 0x1F) << 6 | (p[1] & 0x3Fu);
    case 3:
        return (uint32_t)(p[0] & 0x0F) << 12 | (uint32_t)(p[1] & 0x3F) << 6 | (p[2] & 0x3Fu);
    case 4:
        return (uint32_t)(p[0] & 0x07) << 18 | (uint32_t)(p[1] & 0x3F) << 12 | (uint32_t)(p[2] & 0x3F) << 6 |
               (p[3] & 0x3Fu);
    default:
        return p[0];
    }
}

size_t utf8_count(str s) {
    size_t count = 0;
    size_t at = 0;
    while (at < s.len) {
        size_t ascii_end = skip_ascii(s, at);
        count += ascii_end - at;
        at = ascii_end;
        if (at == s.len)
            break;
        size_t n = utf8_sequence_length(s, at);
        at += n ? n : 1;
        count++;
    }
    return count;
}

bool str_is_name(str s) {
    size_t count = 0;
    for (size_t at = 0; at < s.len; count++) {
        size_t n = utf8_sequence_length(s, at);
        if (n == 0 || count == NAME_LETTERS_MAX)
            return false;
        uint32_t c = utf8_decode(s, at);
        if (!(unicode_is_letter(c) || c == '_' || c == '-' || (count > 0 && unicode_is_digit(c))))
            return false;
        at += n;
    }
    return count >= 1;
}
