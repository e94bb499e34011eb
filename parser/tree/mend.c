#include "parser/tree/mend.h"

#include "core/heap.h"
#include "core/nearest.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

static bool is_lower(char c) {
    return c >= 'a' && c <= 'z';
}
static bool is_upper(char c) {
    return c >= 'A' && c <= 'Z';
}

static str without(struct arena *arena, str text, char dropped) {
    str copy = arena_copy(arena, text);
    char *out = (char *)copy.ptr;
    size_t length = 0;
    for (size_t i = 0; i < text.len; i++)
        if (text.ptr[i] != dropped)
            out[length++] = text.ptr[i];
    return (str){out, length};
}

static str hex_as_decimal(struct arena *arena, str text) {
    size_t sign = text.len && (text.ptr[0] == '-' || text.ptr[0] == '+') ? 1 : 0;
    str digits = arena_copy(arena, str_slice(text, sign + 2, text.len));
    char *end = NULL;
    if (digits.len == 0 || digits.len > 13)
        return STR("");
    unsigned long long value = strtoull(digits.ptr, &end, 16);
    return *end ? STR("") : arena_format(arena, "%s%llu", text.ptr[0] == '-' ? "-" : "", value);
}

static str leading_number(str text) {
    size_t end = 0;
    while (end < text.len && (char_is_digit(text.ptr[end]) || strchr("+-.", text.ptr[end])))
        end++;
    return str_slice(text, 0, end);
}

static str without_leading_zeros(struct arena *arena, str text) {
    size_t sign = text.ptr[0] == '-' || text.ptr[0] == '+' ? 1 : 0;
    size_t first = sign;
    while (first + 1 < text.len && text.ptr[first] == '0' && char_is_digit(text.ptr[first + 1]))
        first++;
    return arena_format(arena, "%.*s%.*s", (int)sign, text.ptr, STR_ARG(str_slice(text, first, text.len)));
}

static str percent(struct arena *arena, str text) {
    double value;
    char digits[NUMBER_FORMAT_MAX];
    if (number_parse(str_slice(text, 0, text.len - 1), &value) != NUMBER_OK)
        return STR("");
    size_t length = number_format(value / 100, digits);
    return arena_copy(arena, (str){digits, length});
}

static str mend_integer(struct arena *arena, str text) {
    double value;
    char digits[NUMBER_FORMAT_MAX];
    if (number_parse(text, &value) != NUMBER_OK || !(value >= INT32_MIN && value <= INT32_MAX) ||
        value != (double)(int32_t)value)
        return STR("");
    size_t length = number_format(value, digits);
    return arena_copy(arena, (str){digits, length});
}

// A typographic dash in front, three bytes long, as '-'.
static str with_minus(struct arena *arena, str text) {
    size_t length = utf8_sequence_length(text, 0);
    return arena_format(arena, "-%.*s", STR_ARG(str_slice(text, length, text.len)));
}

// U+2018 to U+201F are typographic quotes, three bytes long.
static bool is_quote(str text, size_t at) {
    return text.len >= at + 3 && memcmp(text.ptr + at, "\xE2\x80", 2) == 0 &&
           (unsigned char)text.ptr[at + 2] >= 0x98 && (unsigned char)text.ptr[at + 2] <= 0x9F;
}

str mend_quotes(str text) {
    text = str_trim(text);
    while (is_quote(text, 0))
        text = str_slice(text, 3, text.len);
    while (text.len >= 3 && is_quote(text, text.len - 3))
        text = str_slice(text, 0, text.len - 3);
    return text;
}

str mend_number(struct arena *arena, enum number_status status, str text) {
    str copy;
    switch (status) {
    case NUMBER_COMMA:
        copy = arena_copy(arena, text);
        *(char *)memchr(copy.ptr, ',', copy.len) = '.';
        return copy;
    case NUMBER_DASH:
        return with_minus(arena, text);
    case NUMBER_UNDERSCORE:
        return without(arena, text, '_');
    case NUMBER_HEX:
        return hex_as_decimal(arena, text);
    case NUMBER_LEADING_ZERO:
        return without_leading_zeros(arena, text);
    case NUMBER_UNIT:
        return text.ptr[text.len - 1] == '%' ? percent(arena, text) : leading_number(text);
    case NUMBER_NOT_INTEGER:
        return mend_integer(arena, text);
    case NUMBER_NOT_A_NUMBER:
        return mend_quotes(text).len < text.len ? mend_quotes(text) : STR("");
    default:
        return STR("");
    }
}

// Characters that may be between numbers, or around them.
static bool is_between(char c) {
    return memchr(" ,;\t\r\n[](){}<>", c, 14) != NULL;
}

// The next number of the text, and the rest after it; the empty string if there is none.
static str next_number(str *rest) {
    size_t begin = 0;
    while (begin < rest->len && is_between(rest->ptr[begin]))
        begin++;
    size_t end = begin;
    while (end < rest->len && !is_between(rest->ptr[end]))
        end++;
    str word = str_slice(*rest, begin, end);
    while (end < rest->len && is_between(rest->ptr[end]))
        end++;
    *rest = str_slice(*rest, end, rest->len);
    double ignored;
    return number_parse(word, &ignored) == NUMBER_OK ? word : STR("");
}

str mend_numbers(struct arena *arena, str text, uint32_t count) {
    str rest = str_trim(text);
    str list = STR("");
    for (uint32_t i = 0; i < count; i++) {
        str number = next_number(&rest);
        if (number.len == 0)
            return STR("");
        list = arena_format(arena, "%.*s%s%.*s", STR_ARG(list), i ? ", " : "", STR_ARG(number));
    }
    return rest.len ? STR("") : list;
}

bool mend_is_numbers(str text) {
    str rest = str_trim(text);
    uint32_t count = 0;
    for (; rest.len; count++)
        if (next_number(&rest).len == 0)
            return false;
    return count > 1;
}

static bool equal_nocase(str a, const char *b) {
    return a.len == strlen(b) && str_ends_with_nocase(a, b);
}

str mend_boolean(str text) {
    static const char *const yes[] = {"true", "yes", "on", "y", "1"};
    static const char *const no[] = {"false", "no", "off", "n", "0"};
    str word = str_trim(text);
    for (size_t i = 0; i < sizeof yes / sizeof *yes; i++) {
        if (equal_nocase(word, yes[i]))
            return STR("true");
        if (equal_nocase(word, no[i]))
            return STR("false");
    }
    return STR("");
}

str mend_name(struct arena *arena, str text) {
    str copy =
        arena_format(arena, "%s%.*s", text.len && char_is_digit(text.ptr[0]) ? "_" : "", STR_ARG(text));
    char *c = (char *)copy.ptr;
    for (size_t i = 0; i < copy.len; i++)
        if ((unsigned char)c[i] < 0x80 && !char_is_digit(c[i]) && !is_lower(c[i]) && !is_upper(c[i]) &&
            c[i] != '-')
            c[i] = '_';
    return copy;
}

str mend_like(struct arena *arena, str written, str replacement) {
    char quote = written.len ? written.ptr[0] : ' ';
    if (quote != '"' && quote != '\'')
        return replacement;
    return arena_format(arena, "%c%.*s%c", quote, STR_ARG(replacement), quote);
}

// `out` has twice the room of the text.
static str put_snake(char *out, str text) {
    size_t length = 0;
    for (size_t i = 0; i < text.len; i++) {
        char c = text.ptr[i];
        bool begins = is_upper(c) && i > 0 && (is_lower(text.ptr[i - 1]) || char_is_digit(text.ptr[i - 1]));
        if (begins)
            out[length++] = '_';
        out[length++] = is_upper(c) ? (char)(c - 'A' + 'a') : c == '-' || c == ' ' ? '_' : c;
    }
    return (str){out, length};
}

str mend_snake(struct arena *arena, str text) {
    text = mend_quotes(text);
    return put_snake(arena_alloc(arena, heap_times(2, text.len) + 1), text);
}

struct mend_search mend_begin(struct diag_sink *sink, struct arena *arena, str word) {
    str snake = mend_snake(arena, word);
    return (struct mend_search){.arena = arena,
                                .word = word,
                                .snake = snake,
                                .near = nearest_begin_within(snake, &sink->search_left),
                                .distance = UINT_MAX};
}

enum {
    CANDIDATE_MAX = 128,
    PREFIX_DISTANCE = 2
};

void mend_offer_str(struct mend_search *search, str candidate, int id) {
    char room[2 * CANDIDATE_MAX];
    if (candidate.len > CANDIDATE_MAX)
        return;
    str snake = put_snake(room, mend_quotes(candidate));
    bool same = str_equal(snake, search->snake);
    search->near.best_distance = search->distance == UINT_MAX ? UINT_MAX : search->distance + 1;
    if (!same)
        nearest_offer(&search->near, snake);
    unsigned distance = same ? 0 : search->near.best_distance;
    if (distance > PREFIX_DISTANCE && search->snake.len >= 3 && str_starts_with(snake, search->snake))
        distance = PREFIX_DISTANCE; // "dir", "pos", "spec"
    if (distance == UINT_MAX || distance > search->distance)
        return;
    if (distance == search->distance) {
        search->ties += id != search->best_id;
        return;
    }
    search->best = arena_copy(search->arena, candidate).ptr;
    search->best_id = id;
    search->distance = distance;
    search->ties = 0;
}

void mend_offer(struct mend_search *search, const char *candidate, int id) {
    mend_offer_str(search, str_from(candidate), id);
}

bool mend_is_safe(const struct mend_search *search) {
    if (!search->best || search->ties)
        return false;
    size_t length = search->snake.len;
    return search->distance == 0 || (search->distance <= 2 && (size_t)search->distance * 3 <= length);
}
