#include "core/number.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NUMBER_TEXT_MAX = 1000 };

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

static size_t digits(str s, size_t at) {
    size_t n = 0;
    while (at + n < s.len && is_digit(s.ptr[at + n]))
        n++;
    return n;
}

static bool equals_nocase(str s, const char *word) { return s.len == strlen(word) && str_ends_with_nocase(s, word); }

static enum number_status explain_no_number(str text) {
    str s = text;
    if (s.len && (s.ptr[0] == '+' || s.ptr[0] == '-'))
        s = str_slice(s, 1, s.len);
    if (equals_nocase(s, "nan") || equals_nocase(s, ".nan"))
        return NUMBER_NAN;
    if (equals_nocase(s, "inf") || equals_nocase(s, ".inf") || equals_nocase(s, "infinity"))
        return NUMBER_INFINITE;
    if (s.len > 2 && s.ptr[0] == '0' && (s.ptr[1] == 'x' || s.ptr[1] == 'X'))
        return NUMBER_HEX;
    if (s.len > 2 && s.ptr[0] == '0' && (s.ptr[1] == 'o' || s.ptr[1] == 'O'))
        return NUMBER_OCTAL;
    if (s.len == 0 || !(is_digit(s.ptr[0]) || s.ptr[0] == '.'))
        return NUMBER_NOT_A_NUMBER;
    size_t end = 0;
    while (end < s.len && (is_digit(s.ptr[end]) || s.ptr[end] == '.'))
        end++;
    if (end == s.len || end == 0)
        return NUMBER_NOT_A_NUMBER;
    if (s.ptr[end] == '_')
        return NUMBER_UNDERSCORE;
    if (s.ptr[end] == ',')
        return NUMBER_COMMA;
    bool letter = (unsigned char)s.ptr[end] >= 0x80 || s.ptr[end] == ' ' || s.ptr[end] == '%' ||
                  (s.ptr[end] >= 'a' && s.ptr[end] <= 'z') || (s.ptr[end] >= 'A' && s.ptr[end] <= 'Z');
    return letter ? NUMBER_UNIT : NUMBER_NOT_A_NUMBER;
}

// Checks the grammar; where it holds, *zero tells whether every digit of the mantissa is 0.
static enum number_status check(str s, bool *zero) {
    size_t at = s.len && (s.ptr[0] == '+' || s.ptr[0] == '-') ? 1 : 0;
    size_t whole = digits(s, at);
    size_t whole_at = at;
    size_t fraction = 0;
    at += whole;
    if (at < s.len && s.ptr[at] == '.') {
        fraction = digits(s, at + 1);
        at += 1 + fraction;
    }
    size_t mantissa_end = at;
    if (whole + fraction == 0)
        return explain_no_number(s);
    if (at < s.len && (s.ptr[at] == 'e' || s.ptr[at] == 'E')) {
        size_t sign = at + 1 < s.len && (s.ptr[at + 1] == '+' || s.ptr[at + 1] == '-') ? 1 : 0;
        size_t exponent = digits(s, at + 1 + sign);
        if (exponent == 0)
            return explain_no_number(s);
        at += 1 + sign + exponent;
    }
    if (at != s.len)
        return explain_no_number(s);
    if (whole > 1 && s.ptr[whole_at] == '0')
        return NUMBER_LEADING_ZERO;
    *zero = true;
    for (size_t i = whole_at; i < mantissa_end; i++)
        *zero = *zero && (s.ptr[i] == '0' || s.ptr[i] == '.');
    return NUMBER_OK;
}

enum number_status number_parse(str text, double *value) {
    *value = 0;
    if (text.len == 0)
        return NUMBER_EMPTY;
    if (text.len > NUMBER_TEXT_MAX)
        return NUMBER_TOO_LONG;
    bool zero = false;
    enum number_status status = check(text, &zero);
    if (status != NUMBER_OK || zero)
        return status;
    char copy[NUMBER_TEXT_MAX + 1];
    memcpy(copy, text.ptr, text.len);
    copy[text.len] = '\0';
    double read = strtod(copy, NULL);
    if (isinf(read))
        return NUMBER_OVERFLOW;
    if (read == 0.0)
        return NUMBER_UNDERFLOW;
    *value = read;
    return NUMBER_OK;
}

enum number_status number_parse_integer(str text, int64_t *value) {
    *value = 0;
    double number;
    enum number_status status = number_parse(text, &number);
    if (status != NUMBER_OK)
        return status;
    size_t sign = text.ptr[0] == '+' || text.ptr[0] == '-' ? 1 : 0;
    if (digits(text, sign) != text.len - sign)
        return NUMBER_NOT_INTEGER;
    char copy[NUMBER_TEXT_MAX + 1];
    memcpy(copy, text.ptr, text.len);
    copy[text.len] = '\0';
    errno = 0;
    long long read = strtoll(copy, NULL, 10);
    if (errno == ERANGE)
        return NUMBER_OVERFLOW;
    *value = read;
    return NUMBER_OK;
}

const char *number_problem(enum number_status status) {
    switch (status) {
    case NUMBER_OK:
        return "is a number";
    case NUMBER_EMPTY:
        return "is empty";
    case NUMBER_NOT_A_NUMBER:
        return "is not a number";
    case NUMBER_NAN:
        return "is not a finite number";
    case NUMBER_INFINITE:
        return "is infinite; write a large number such as 1.0e+18";
    case NUMBER_HEX:
        return "is hexadecimal; write it in decimal";
    case NUMBER_OCTAL:
        return "is octal; write it in decimal";
    case NUMBER_UNDERSCORE:
        return "holds an underscore; write the digits together";
    case NUMBER_COMMA:
        return "has a decimal comma; write a point";
    case NUMBER_LEADING_ZERO:
        return "has superfluous leading zeros";
    case NUMBER_UNIT:
        return "has text behind the number; write the number alone";
    case NUMBER_OVERFLOW:
        return "is too large to be represented";
    case NUMBER_UNDERFLOW:
        return "is too small to be represented; write 0 if you mean 0";
    case NUMBER_TOO_LONG:
        return "has more than 1000 characters";
    case NUMBER_NOT_INTEGER:
        return "is not a whole number written with digits only";
    }
    return "is not a number";
}

// Rewrites a "%.*e" text as digits with a point or, where that is long, as d.ddde+XX.
static size_t layout(const char *scientific, char *out) {
    char mantissa[24];
    size_t count = 0;
    const char *p = scientific;
    size_t length = 0;
    if (*p == '-')
        out[length++] = *p++;
    for (; *p && *p != 'e'; p++)
        if (*p != '.')
            mantissa[count++] = *p;
    long exponent = strtol(p + 1, NULL, 10);
    while (count > 1 && mantissa[count - 1] == '0')
        count--;
    if (exponent < -5 || exponent > 15) {
        out[length++] = mantissa[0];
        out[length++] = '.';
        if (count == 1)
            out[length++] = '0';
        memcpy(out + length, mantissa + 1, count - 1);
        length += count - 1;
        return length + (size_t)snprintf(out + length, 8, "e%+03ld", exponent);
    }
    if (exponent < 0) {
        out[length++] = '0';
        out[length++] = '.';
        for (long i = -1; i > exponent; i--)
            out[length++] = '0';
        memcpy(out + length, mantissa, count);
        length += count;
    } else {
        for (size_t i = 0; i < count || i <= (size_t)exponent; i++) {
            if (i == (size_t)exponent + 1)
                out[length++] = '.';
            out[length++] = i < count ? mantissa[i] : '0';
        }
    }
    out[length] = '\0';
    return length;
}

size_t number_format(double value, char out[NUMBER_FORMAT_MAX]) {
    if (!isfinite(value) || value == 0.0)
        return (size_t)snprintf(out, NUMBER_FORMAT_MAX, "%s", value == 0.0 ? "0" : isnan(value) ? ".nan" : value > 0 ? ".inf" : "-.inf");
    char scientific[40];
    for (int precision = 0; precision < 17; precision++) {
        snprintf(scientific, sizeof scientific, "%.*e", precision, value);
        if (strtod(scientific, NULL) == value)
            break;
    }
    return layout(scientific, out);
}
