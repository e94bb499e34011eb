#include "core/number.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    NUMBER_TEXT_MAX = 1000,
    POWER_EXACT = 22, // 10^22 is the largest power of ten that is a double
    EXPONENT_FULL = 100000,
};

#define MANTISSA_FULL    (UINT64_C(1000000000000000000)) // another digit may not fit into 64 bits
#define MANTISSA_EXACT   (UINT64_C(1) << DBL_MANT_DIG)   // integers up to this one are doubles
#define DIGITS_EXACT     1e15                            // decimals of DBL_DIG digits survive a double
#define DOUBLE_IS_DOUBLE (FLT_EVAL_METHOD == 0) // no excess precision, so that one operation rounds once

static const double powers_of_ten[POWER_EXACT + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                      1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                      1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

static bool equals_nocase(str s, const char *word) {
    return s.len == strlen(word) && str_ends_with_nocase(s, word);
}

// HYPHEN to HORIZONTAL BAR and MINUS SIGN, which a text processor or a web page writes for '-'.
static bool begins_with_dash(str s) {
    if (utf8_sequence_length(s, 0) != 3 || s.len < 4 || !(char_is_digit(s.ptr[3]) || s.ptr[3] == '.'))
        return false;
    uint32_t c = utf8_decode(s, 0);
    return (c >= 0x2010 && c <= 0x2015) || c == 0x2212;
}

// Whether `s` from `at` is an exponent without its digits.
static bool ends_in_exponent(str s, size_t at) {
    if (at >= s.len || (s.ptr[at] != 'e' && s.ptr[at] != 'E'))
        return false;
    at += at + 1 < s.len && (s.ptr[at + 1] == '+' || s.ptr[at + 1] == '-') ? 2 : 1;
    return at == s.len;
}

static enum number_status explain_no_number(str text) {
    str s = text;
    if (begins_with_dash(s))
        return NUMBER_DASH;
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
    if (s.len == 0 || !(char_is_digit(s.ptr[0]) || s.ptr[0] == '.'))
        return NUMBER_NOT_A_NUMBER;
    size_t end = 0;
    while (end < s.len && (char_is_digit(s.ptr[end]) || s.ptr[end] == '.'))
        end++;
    if (end == s.len || ends_in_exponent(s, end))
        return NUMBER_NOT_A_NUMBER;
    if (s.ptr[end] == '_')
        return NUMBER_UNDERSCORE;
    if (s.ptr[end] == ',')
        return NUMBER_COMMA;
    bool letter = (unsigned char)s.ptr[end] >= 0x80 || s.ptr[end] == ' ' || s.ptr[end] == '%' ||
                  (s.ptr[end] >= 'a' && s.ptr[end] <= 'z') || (s.ptr[end] >= 'A' && s.ptr[end] <= 'Z');
    return letter ? NUMBER_UNIT : NUMBER_NOT_A_NUMBER;
}

// A number in the language's grammar: mantissa * 10^exponent, if the digits fit.
struct decimal {
    bool negative;
    bool padded;       // superfluous leading zeros
    bool whole;        // digits only
    bool exact;        // mantissa and exponent hold all of it
    uint64_t mantissa; // at most 19 digits
    long exponent;
};

// Adds a run of digits to the mantissa; returns their number.
static size_t scan_digits(str s, size_t at, struct decimal *decimal) {
    uint64_t mantissa = decimal->mantissa;
    size_t end = at;
    for (; end < s.len; end++) {
        unsigned digit = (unsigned char)s.ptr[end] - (unsigned)'0';
        if (digit > 9)
            break;
        if (mantissa < MANTISSA_FULL)
            mantissa = mantissa * 10 + digit;
        else
            decimal->exact = false;
    }
    decimal->mantissa = mantissa;
    return end - at;
}

// The exponent after an 'e' at `at`; *length is 0 if there are no digits.
static long scan_exponent(str s, size_t at, size_t *length) {
    bool negative = at + 1 < s.len && s.ptr[at + 1] == '-';
    size_t sign = negative || (at + 1 < s.len && s.ptr[at + 1] == '+') ? 1 : 0;
    size_t first = at + 1 + sign;
    long value = 0;
    size_t n = 0;
    for (; first + n < s.len && char_is_digit(s.ptr[first + n]); n++)
        if (value < EXPONENT_FULL)
            value = value * 10 + (s.ptr[first + n] - '0');
    *length = n ? 1 + sign + n : 0;
    return negative ? -value : value;
}

// The number that `s` begins with; returns its length, 0 if there is none.
static size_t scan_decimal(str s, struct decimal *decimal) {
    *decimal = (struct decimal){.exact = true, .negative = s.len && s.ptr[0] == '-'};
    size_t first = decimal->negative || (s.len && s.ptr[0] == '+') ? 1 : 0;
    size_t whole = scan_digits(s, first, decimal);
    size_t fraction = 0;
    size_t at = first + whole;
    if (at < s.len && s.ptr[at] == '.') {
        fraction = scan_digits(s, at + 1, decimal);
        at += 1 + fraction;
    }
    if (whole + fraction == 0)
        return 0;
    if (at < s.len && (s.ptr[at] == 'e' || s.ptr[at] == 'E')) {
        size_t length;
        decimal->exponent = scan_exponent(s, at, &length);
        if (length == 0)
            return 0;
        at += length;
    }
    decimal->exponent -= (long)fraction;
    decimal->whole = at == first + whole;
    decimal->padded = whole > 1 && s.ptr[first] == '0';
    return at;
}

static enum number_status scan(str s, struct decimal *decimal) {
    size_t length = scan_decimal(s, decimal);
    if (length == 0 || length != s.len)
        return explain_no_number(s);
    return decimal->padded ? NUMBER_LEADING_ZERO : NUMBER_OK;
}

// Clinger, How to Read Floating Point Numbers Accurately (1990), section 3: if mantissa and power of ten are
// doubles, one multiplication or division rounds once and so correctly. false: they are not.
static bool read_fast(const struct decimal *decimal, double *value) {
    if (!DOUBLE_IS_DOUBLE || !decimal->exact || decimal->mantissa > MANTISSA_EXACT)
        return false;
    double mantissa = (double)decimal->mantissa;
    if (decimal->exponent < -POWER_EXACT || decimal->exponent > POWER_EXACT)
        return false;
    *value = decimal->exponent < 0 ? mantissa / powers_of_ten[-decimal->exponent]
                                   : mantissa * powers_of_ten[decimal->exponent];
    return true;
}

size_t number_take(str text, double *value) {
    struct decimal decimal;
    size_t length = scan_decimal(text, &decimal);
    if (length == 0 || !read_fast(&decimal, value))
        return 0;
    if (decimal.negative && decimal.mantissa != 0)
        *value = -*value;
    return length;
}

enum number_status number_parse(str text, double *value) {
    *value = 0;
    if (text.len == 0)
        return NUMBER_EMPTY;
    if (text.len > NUMBER_TEXT_MAX)
        return NUMBER_TOO_LONG;
    struct decimal decimal;
    enum number_status status = scan(text, &decimal);
    if (status != NUMBER_OK || decimal.mantissa == 0)
        return status;
    double read;
    if (read_fast(&decimal, &read)) {
        *value = decimal.negative ? -read : read;
        return NUMBER_OK;
    }
    char copy[NUMBER_TEXT_MAX + 1];
    memcpy(copy, text.ptr, text.len);
    copy[text.len] = '\0';
    read = strtod(copy, NULL);
    if (isinf(read))
        return NUMBER_OVERFLOW;
    if (read == 0.0)
        return NUMBER_UNDERFLOW;
    *value = read;
    return NUMBER_OK;
}

enum number_status number_parse_integer(str text, int64_t *value) {
    *value = 0;
    if (text.len == 0)
        return NUMBER_EMPTY;
    if (text.len > NUMBER_TEXT_MAX)
        return NUMBER_TOO_LONG;
    struct decimal decimal;
    enum number_status status = scan(text, &decimal);
    if (status != NUMBER_OK)
        return status;
    if (!decimal.whole)
        return NUMBER_NOT_INTEGER;
    uint64_t largest = (uint64_t)INT64_MAX + (decimal.negative ? 1 : 0);
    if (!decimal.exact || decimal.mantissa > largest)
        return NUMBER_OVERFLOW;
    if (decimal.negative && decimal.mantissa == largest)
        *value = INT64_MIN;
    else
        *value = decimal.negative ? -(int64_t)decimal.mantissa : (int64_t)decimal.mantissa;
    return NUMBER_OK;
}

bool number_parse_whole(str text, int64_t least, int64_t most, int32_t *value) {
    int64_t number;
    if (number_parse_integer(text, &number) != NUMBER_OK || number < least || number > most)
        return false;
    *value = (int32_t)number;
    return true;
}

bool number_parse_real(str text, double least, double most, double *value) {
    double number;
    if (number_parse(text, &number) != NUMBER_OK || !(number >= least && number <= most))
        return false;
    *value = number;
    return true;
}

bool number_parse_size(str text, const char *signs, int32_t most, int32_t *width, int32_t *height) {
    size_t x = 0;
    int32_t first;
    while (x < text.len && (text.ptr[x] == '\0' || !strchr(signs, text.ptr[x])))
        x++;
    if (x == text.len || !number_parse_whole(str_slice(text, 0, x), 1, most, &first) ||
        !number_parse_whole(str_slice(text, x + 1, text.len), 1, most, height))
        return false;
    *width = first;
    return true;
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
        return "contains an underscore; write the digits without it";
    case NUMBER_COMMA:
        return "has a decimal comma; write a decimal point";
    case NUMBER_LEADING_ZERO:
        return "has superfluous leading zeros";
    case NUMBER_UNIT:
        return "has text after the number; write only the number";
    case NUMBER_OVERFLOW:
        return "is too large to be represented";
    case NUMBER_UNDERFLOW:
        return "is too small to be represented; write 0 if you mean 0";
    case NUMBER_TOO_LONG:
        return "has more than 1000 characters";
    case NUMBER_NOT_INTEGER:
        return "is not a whole number written with digits only";
    case NUMBER_DASH:
        return "begins with a typographic dash; write '-'";
    }
    return "is not a number";
}

// Rewrites a "%.*e" text as digits with a point or, if that is long, as d.ddde+XX.
static size_t write_decimal(const char *scientific, char *out) {
    char mantissa[24] = {'0'};
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

// Most numbers that people write have few decimals. This finds the fewest decimals that make the value an
// integer of at most DBL_DIG digits which, divided by its power of ten, gives the value again. No other
// decimal with so few digits reads as the value (and dividing rounds once, as in `read_fast`), so it is the
// shortest.
static size_t format_fast(double value, char *out) {
    double size = fabs(value);
    if (!DOUBLE_IS_DOUBLE || size < 1e-5)
        return 0;
    for (int decimals = 0; decimals <= POWER_EXACT; decimals++) {
        double scaled = size * powers_of_ten[decimals];
        if (scaled >= DIGITS_EXACT)
            return 0;
        uint64_t whole = (uint64_t)(scaled + 0.5);
        if ((double)whole / powers_of_ten[decimals] != size)
            continue;
        char reversed[NUMBER_FORMAT_MAX];
        size_t count = 0;
        size_t length = 0;
        for (; whole || count <= (size_t)decimals; whole /= 10)
            reversed[count++] = (char)('0' + whole % 10);
        if (value < 0)
            out[length++] = '-';
        while (count > (size_t)decimals)
            out[length++] = reversed[--count];
        if (count)
            out[length++] = '.';
        while (count)
            out[length++] = reversed[--count];
        out[length] = '\0';
        return length;
    }
    return 0;
}

// Adds one to the last digit of a "%.*e" text; false if that would change its exponent.
static bool next_decimal(char *scientific) {
    char *digit = strchr(scientific, 'e');
    while (digit > scientific) {
        digit--;
        if (*digit >= '0' && *digit < '9') {
            ++*digit;
            return true;
        }
        if (*digit == '9')
            *digit = '0';
    }
    return false;
}

static bool reads_back(const char *text, double value) {
    double read;
    return number_parse(str_from(text), &read) == NUMBER_OK && read == value;
}

// printf writes the nearest decimal with that number of digits. Above a power of two doubles are twice as far
// apart as below it: at one, the next decimal away from 0 may read back while the nearest, on the other side,
// does not.
static bool print_digits(double value, int digits, char scientific[NUMBER_FORMAT_MAX]) {
    snprintf(scientific, NUMBER_FORMAT_MAX, "%.*e", digits - 1, value);
    if (reads_back(scientific, value))
        return true;
    int exponent;
    return fabs(frexp(value, &exponent)) == 0.5 && next_decimal(scientific) && reads_back(scientific, value);
}

size_t number_format(double value, char out[NUMBER_FORMAT_MAX]) {
    if (!isfinite(value) || value == 0.0) {
        const char *word = value == 0.0 ? "0" : isnan(value) ? ".nan" : value > 0 ? ".inf" : "-.inf";
        return (size_t)snprintf(out, NUMBER_FORMAT_MAX, "%s", word);
    }
    size_t length = format_fast(value, out);
    if (length)
        return length;
    // Every decimal of DBL_DIG digits survives a normal double, so trying fewer finds nothing shorter.
    int digits = fabs(value) < DBL_MIN ? 1 : DBL_DIG;
    char scientific[NUMBER_FORMAT_MAX];
    while (!print_digits(value, digits, scientific))
        digits++;
    return write_decimal(scientific, out);
}
