// Strings that are not NUL-terminated: a pointer and a length in bytes.
//
// A `str` never owns its bytes: they belong to a source, an arena or a literal. Text is UTF-8.
// Thread safety: values; no function here keeps state.
#ifndef GLINT_CORE_STR_H
#define GLINT_CORE_STR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef struct {
    const char *ptr;
    size_t len;
} str;

// A `str` of a string literal.
#define STR(literal) ((str){"" literal, sizeof(literal) - 1})
// The two arguments of a `%.*s` conversion.
#define STR_ARG(s) (int)((s).len), (s).ptr

static inline bool char_is_digit(char c) {
    return c >= '0' && c <= '9';
}
static inline bool char_is_break(char c) {
    return c == '\n' || c == '\r';
}
static inline bool char_is_blank(char c) {
    return c == ' ' || c == '\t';
}
static inline bool char_is_space(char c) {
    return char_is_blank(c) || char_is_break(c);
}
static inline bool char_is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
// The value of a hexadecimal digit; -1: another character.
static inline int char_hex(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}
static inline char char_lower(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}
// Bytes of the line end at `at`: LF, CR or both.
static inline size_t str_break_length(str s, size_t at) {
    return s.ptr[at] == '\r' && at + 1 < s.len && s.ptr[at + 1] == '\n' ? 2 : 1;
}

// Bytes of the line end at `at` as YAML 1.1 has them, 0 if there is none: those above, and NEL, LS and PS
// (U+0085, U+2028, U+2029).
size_t str_yaml_break_length(str s, size_t at);
// Whether such a line end is directly before `end`.
bool str_yaml_break_before(str s, size_t end);

str str_from(const char *cstring); // NULL becomes the empty string
static inline bool str_equal(str a, str b) {
    return a.len == b.len && (a.len == 0 || memcmp(a.ptr, b.ptr, a.len) == 0);
}
static inline bool str_equal_cstr(str a, const char *b) {
    return str_equal(a, (str){b, strlen(b)});
}
int str_compare(str a, str b); // byte order, as memcmp
bool str_starts_with(str s, str prefix);
bool str_ends_with_nocase(str s, const char *suffix); // ASCII letters only
// The part of `s` from `begin` to before `end`; both are clamped to the length.
static inline str str_slice(str s, size_t begin, size_t end) {
    if (end > s.len)
        end = s.len;
    if (begin > end)
        begin = end;
    return (str){begin ? s.ptr + begin : s.ptr, end - begin};
}
// Without the spaces, tabs and line ends at both ends.
str str_trim(str s);
// Where a text begins after its byte order mark, if it has one: 3 or 0.
static inline size_t str_skip_mark(str text) {
    return str_starts_with(text, STR("\xEF\xBB\xBF")) ? 3 : 0;
}
// The kind of line end that most lines of a text have; of equal counts "\n" wins over "\r\n", and "\r\n" over
// "\r".
str str_line_end(str text);

// FNV-1a, 64 bits (Fowler, Noll, Vo).
uint64_t str_hash(str s);

// Where the run of printable ASCII that begins at `at` ends: the first byte that is a control character, DEL
// or above 0x7F; s.len if there is none.
size_t str_skip_printable(str s, size_t at);

// Length in bytes of the well-formed UTF-8 sequence that begins at `at`, 0 if there is none
// (Unicode 15, table 3-7: no overlong forms, no surrogates, nothing above U+10FFFF).
size_t utf8_sequence_length(str s, size_t at);
// Byte offset of the first byte that is not part of well-formed UTF-8; s.len if all is well.
size_t utf8_first_error(str s);
// Code point at `at`, which must begin a well-formed sequence.
uint32_t utf8_decode(str s, size_t at);
// Code points in `s`; an ill-formed byte counts as one.
size_t utf8_count(str s);

// 1 to 128 letters of any script, digits, '_', '-', not beginning with a digit (docs/language.md, "Names").
bool str_is_name(str s);

#endif
