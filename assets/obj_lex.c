#include "assets/obj_lex.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    DIGITS_MAX = 19,      // any number of 19 digits fits 64 bits
    EXACT_POWER_MAX = 22, // 10^22 is the largest power of ten that is a double
    WORD_NUMBER_MAX = 1000,
};

static const double exact_powers[EXACT_POWER_MAX + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                         1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                         1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

void obj_lex_init(struct obj_lex *lex, str text) {
    *lex = (struct obj_lex){
        .begin = text.ptr, .end = text.ptr + text.len, .at = text.ptr + str_skip_mark(text), .line = 1};
}

static bool is_line_end(char c) {
    return c == '\n' || c == '\r';
}

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// Length of the line end at `p`, 0 if there is none.
static size_t line_end_length(const char *p, const char *end) {
    if (p == end || !is_line_end(*p))
        return 0;
    return *p == '\r' && p + 1 < end && p[1] == '\n' ? 2 : 1;
}

// Length of the continuation at `p`, 0 if there is none. A backslash elsewhere is a letter (of a path).
static size_t continuation_length(const char *p, const char *end) {
    if (p == end || *p != '\\')
        return 0;
    size_t length = line_end_length(p + 1, end);
    return length ? length + 1 : 0;
}

bool obj_lex_more(struct obj_lex *lex) {
    for (;;) {
        while (lex->at < lex->end && (*lex->at == ' ' || *lex->at == '\t'))
            lex->at++;
        size_t length = continuation_length(lex->at, lex->end);
        if (length == 0)
            return lex->at < lex->end && !is_line_end(*lex->at) && *lex->at != '#';
        lex->at += length;
        lex->line++;
    }
}

void obj_lex_next_line(struct obj_lex *lex) {
    // A comment ends with its line, whatever its last character is.
    bool is_comment = lex->at < lex->end && *lex->at == '#';
    for (;;) {
        while (lex->at < lex->end && !is_line_end(*lex->at))
            lex->at++;
        if (lex->at == lex->end)
            return;
        bool continues = !is_comment && lex->at > lex->begin && lex->at[-1] == '\\';
        lex->at += line_end_length(lex->at, lex->end);
        lex->line++;
        if (!continues)
            return;
    }
}

static bool ends_word(const char *p, const char *end) {
    return p == end || *p == ' ' || *p == '\t' || is_line_end(*p) || continuation_length(p, end);
}

bool obj_lex_word_ends(const struct obj_lex *lex) {
    return ends_word(lex->at, lex->end);
}

str obj_lex_word(struct obj_lex *lex) {
    const char *begin = lex->at;
    while (!ends_word(lex->at, lex->end))
        lex->at++;
    return (str){begin, (size_t)(lex->at - begin)};
}

str obj_lex_rest(struct obj_lex *lex) {
    const char *begin = lex->at;
    while (lex->at < lex->end && !is_line_end(*lex->at) && !continuation_length(lex->at, lex->end))
        lex->at++;
    return str_trim((str){begin, (size_t)(lex->at - begin)});
}

// What the fast path does not decide: long mantissas, large exponents, and all that is no number.
static enum number_status slow_number(str word, double *value) {
    // The language's own grammar finds what is wrong; only leading zeros are taken away before.
    char copy[WORD_NUMBER_MAX + 1];
    size_t length = 0;
    size_t at = 0;
    if (word.len > WORD_NUMBER_MAX)
        return NUMBER_TOO_LONG;
    if (at < word.len && (word.ptr[at] == '+' || word.ptr[at] == '-'))
        copy[length++] = word.ptr[at++];
    while (at + 1 < word.len && word.ptr[at] == '0' && is_digit(word.ptr[at + 1]))
        at++;
    memcpy(copy + length, word.ptr + at, word.len - at);
    enum number_status status = number_parse((str){copy, length + word.len - at}, value);
    return status == NUMBER_UNDERFLOW ? NUMBER_OK : status;
}

struct decimal {
    uint64_t mantissa;
    int digits;   // of the mantissa, without leading zeros
    int exponent; // of ten
    bool any;     // a digit was seen
};

static const char *scan_digits(const char *p, const char *end, struct decimal *d, int exponent_step) {
    for (; p < end && is_digit(*p); p++) {
        d->any = true;
        if (d->digits < DIGITS_MAX) {
            d->mantissa = d->mantissa * 10 + (uint64_t)(*p - '0');
            d->digits += d->mantissa != 0;
            d->exponent -= exponent_step;
        } else {
            d->digits = DIGITS_MAX + 1;
        }
    }
    return p;
}

static const char *scan_exponent(const char *p, const char *end, struct decimal *d) {
    bool negative = p < end && *p == '-';
    if (p < end && (*p == '-' || *p == '+'))
        p++;
    int value = 0;
    const char *begin = p;
    for (; p < end && is_digit(*p); p++)
        value = value < 10000 ? value * 10 + (*p - '0') : value;
    d->any = d->any && p > begin;
    d->exponent += negative ? -value : value;
    return p;
}

enum number_status obj_lex_number(struct obj_lex *lex, double *value) {
    const char *p = lex->at;
    const char *end = lex->end;
    struct decimal d = {0};
    bool negative = p < end && *p == '-';
    if (p < end && (*p == '-' || *p == '+'))
        p++;
    p = scan_digits(p, end, &d, 0);
    if (p < end && *p == '.')
        p = scan_digits(p + 1, end, &d, 1);
    if (p < end && (*p == 'e' || *p == 'E'))
        p = scan_exponent(p + 1, end, &d);
    // Exact: both operands are doubles without rounding, so the one operation rounds once (Clinger 1990).
    bool is_exact = d.any && d.digits <= DIGITS_MAX && d.mantissa <= (UINT64_C(1) << 53) &&
                    d.exponent >= -EXACT_POWER_MAX && d.exponent <= EXACT_POWER_MAX;
    if (is_exact && ends_word(p, end)) {
        double m = (double)d.mantissa;
        m = d.exponent < 0 ? m / exact_powers[-d.exponent] : m * exact_powers[d.exponent];
        *value = negative && m != 0 ? -m : m;
        lex->at = p;
        return NUMBER_OK;
    }
    *value = 0;
    return slow_number(obj_lex_word(lex), value);
}

bool obj_lex_integer(struct obj_lex *lex, int64_t *value) {
    const char *p = lex->at;
    bool negative = p < lex->end && *p == '-';
    if (p < lex->end && (*p == '-' || *p == '+'))
        p++;
    const char *begin = p;
    int64_t n = 0;
    for (; p < lex->end && is_digit(*p); p++)
        n = n < INT64_C(1) << 36 ? n * 10 + (*p - '0') : INT64_C(1) << 40;
    if (p == begin)
        return false;
    lex->at = p;
    *value = negative ? -n : n;
    return true;
}
