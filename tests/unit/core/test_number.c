#include "core/number.h"
#include "random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static double from_bits(uint64_t bits) {
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint64_t to_bits(double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

struct accepted {
    const char *text;
    double value;
};

static void accepts_the_grammar(void **state) {
    (void)state;
    static const struct accepted cases[] = {
        {"0", 0},
        {"-0", 0},
        {"+0.0e5", 0},
        {"0e999999", 0},
        {"0.000", 0},
        {"1", 1},
        {"+1", 1},
        {"-1", -1},
        {"10", 10},
        {"5.", 5},
        {".5", 0.5},
        {"-.5", -0.5},
        {"-4.15", -4.15},
        {"1e3", 1000},
        {"1E+3", 1000},
        {"1.e2", 100},
        {".1e1", 1},
        {"1e-007", 1e-7},
        {"0.1", 0.1},
        {"123456789012345678901234567890", 123456789012345678901234567890.0},
        {"9007199254740993", 9007199254740992.0},
        {"9007199254740992e22", 9007199254740992e22},
        {"9007199254740993e22", 9007199254740993e22},
        {"1.7976931348623157e308", DBL_MAX},
        {"4.9406564584124654e-324", 4.9406564584124654e-324},
        {"2.2250738585072011e-308", 2.2250738585072011e-308},
        {"0.000000000000000000000000000000000000000001", 1e-42},
        {"1e22", 1e22},
        {"1e23", 1e23},
        {"18446744073709551616", 18446744073709551616.0},
        {"0.5000000000000000000000000000000000000000001", 0.5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = 7;
        if (number_parse(str_from(cases[i].text), &value) != NUMBER_OK ||
            to_bits(value) != to_bits(cases[i].value))
            fail_msg("%s gave %.17g", cases[i].text, value);
    }
}

struct refused {
    const char *text;
    enum number_status status;
};

static const struct refused refusals[] = {
    {"", NUMBER_EMPTY},
    {"abc", NUMBER_NOT_A_NUMBER},
    {"+", NUMBER_NOT_A_NUMBER},
    {"-", NUMBER_NOT_A_NUMBER},
    {".", NUMBER_NOT_A_NUMBER},
    {"-.", NUMBER_NOT_A_NUMBER},
    {"--1", NUMBER_NOT_A_NUMBER},
    {"1.2.3", NUMBER_NOT_A_NUMBER},
    {"1e", NUMBER_NOT_A_NUMBER},
    {"1e+", NUMBER_NOT_A_NUMBER},
    {"1e+-3", NUMBER_UNIT},
    {"e5", NUMBER_NOT_A_NUMBER},
    {".e5", NUMBER_UNIT},
    {" 1", NUMBER_NOT_A_NUMBER},
    {"1 ", NUMBER_UNIT},
    {"(1)", NUMBER_NOT_A_NUMBER},
    {"1+2", NUMBER_NOT_A_NUMBER},
    {"1/2", NUMBER_NOT_A_NUMBER},
    {"nan", NUMBER_NAN},
    {"-NaN", NUMBER_NAN},
    {".NaN", NUMBER_NAN},
    {"inf", NUMBER_INFINITE},
    {"-.inf", NUMBER_INFINITE},
    {"+Infinity", NUMBER_INFINITE},
    {"0x1f", NUMBER_HEX},
    {"-0X1F", NUMBER_HEX},
    {"0x1p3", NUMBER_HEX},
    {"0o17", NUMBER_OCTAL},
    {"1_000", NUMBER_UNDERSCORE},
    {"1_000.5", NUMBER_UNDERSCORE},
    {"0,5", NUMBER_COMMA},
    {"-1.000,5", NUMBER_COMMA},
    {"007", NUMBER_LEADING_ZERO},
    {"-00.5", NUMBER_LEADING_ZERO},
    {"00", NUMBER_LEADING_ZERO},
    {"60deg", NUMBER_UNIT},
    {"60°", NUMBER_UNIT},
    {"50%", NUMBER_UNIT},
    {"1e5x", NUMBER_UNIT},
    {"1e309", NUMBER_OVERFLOW},
    {"-1e309", NUMBER_OVERFLOW},
    {"1e999999999999999999999", NUMBER_OVERFLOW},
    {"1.7976931348623159e308", NUMBER_OVERFLOW},
    {"1e-400", NUMBER_UNDERFLOW},
    {"2.4703282292062327e-324", NUMBER_UNDERFLOW},
    {"-1e-99999999999999999999", NUMBER_UNDERFLOW},
    {"\xE2\x88\x92"
     "5", // MINUS SIGN
     NUMBER_DASH},
    {"\xE2\x80\x93.5", NUMBER_DASH}, // EN DASH
    {"\xE2\x80\x93", NUMBER_NOT_A_NUMBER},
    {"½", NUMBER_NOT_A_NUMBER},
    {"٣", NUMBER_NOT_A_NUMBER},
};

static void explains_what_it_refuses(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
        double value = 7;
        enum number_status status = number_parse(str_from(refusals[i].text), &value);
        if (status != refusals[i].status || value != 0)
            fail_msg("'%s' gave %d (%s), value %g", refusals[i].text, status, number_problem(status), value);
    }
    double value;
    assert_int_equal(number_parse(STR("1\0"), &value), NUMBER_NOT_A_NUMBER);
    assert_int_equal(number_parse((str){0}, &value), NUMBER_EMPTY);
}

static void takes_a_number_from_the_beginning(void **state) {
    (void)state;
    static const struct {
        const char *text;
        size_t length; // 0: none that is read at once
        double value;
    } cases[] = {
        {"1 2", 1, 1},       {"-1.5/7", 4, -1.5},
        {"+.5e1\n", 5, 5},   {"007.250x", 7, 7.25},
        {"-0 1", 2, 0},      {"1.2.3", 3, 1.2},
        {"1e-22", 5, 1e-22}, {"1e23", 0, 0},
        {"", 0, 0},          {"-", 0, 0},
        {".", 0, 0},         {"x1", 0, 0},
        {"1e", 0, 0},        {"1e+ 3", 0, 0},
        {"nan", 0, 0},       {"9007199254740993", 0, 0},
        {"0x1f", 1, 0},      {"9007199254740992", 16, 9007199254740992.0},
        {"0e9 ", 3, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = 0;
        size_t length = number_take(str_from(cases[i].text), &value);
        assert_int_equal(length, cases[i].length);
        if (length)
            assert_true(to_bits(value) == to_bits(cases[i].value));
    }
}

static void long_texts_end_at_1000_characters(void **state) {
    (void)state;
    char text[1001];
    memset(text, '1', sizeof text);
    text[1] = '.';
    double value;
    assert_int_equal(number_parse((str){text, 1000}, &value), NUMBER_OK);
    assert_true(value == 10.0 / 9.0 || fabs(value - 1.1111111111111112) < 1e-15);
    assert_int_equal(number_parse((str){text, 1001}, &value), NUMBER_TOO_LONG);
    int64_t whole;
    assert_int_equal(number_parse_integer((str){text, 1001}, &whole), NUMBER_TOO_LONG);
}

struct integer {
    const char *text;
    enum number_status status;
    int64_t value;
};

static void integers(void **state) {
    (void)state;
    static const struct integer cases[] = {
        {"0", NUMBER_OK, 0},
        {"-0", NUMBER_OK, 0},
        {"+12", NUMBER_OK, 12},
        {"-12", NUMBER_OK, -12},
        {"9223372036854775807", NUMBER_OK, INT64_MAX},
        {"-9223372036854775808", NUMBER_OK, INT64_MIN},
        {"9223372036854775808", NUMBER_OVERFLOW, 0},
        {"-9223372036854775809", NUMBER_OVERFLOW, 0},
        {"18446744073709551616", NUMBER_OVERFLOW, 0},
        {"99999999999999999999999999", NUMBER_OVERFLOW, 0},
        {"1.0", NUMBER_NOT_INTEGER, 0},
        {"5.", NUMBER_NOT_INTEGER, 0},
        {"1e3", NUMBER_NOT_INTEGER, 0},
        {"1e999", NUMBER_NOT_INTEGER, 0},
        {"0.0", NUMBER_NOT_INTEGER, 0},
        {"007", NUMBER_LEADING_ZERO, 0},
        {"1,000", NUMBER_COMMA, 0},
        {"0x10", NUMBER_HEX, 0},
        {"", NUMBER_EMPTY, 0},
        {"ten", NUMBER_NOT_A_NUMBER, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int64_t value = 7;
        enum number_status status = number_parse_integer(str_from(cases[i].text), &value);
        if (status != cases[i].status || value != cases[i].value)
            fail_msg("'%s' gave %d and %lld", cases[i].text, status, (long long)value);
    }
}

// Both ends belong to a range, and what is refused leaves the value alone.
static void within_a_range(void **state) {
    (void)state;
    int32_t whole = 7;
    double real = 7;
    assert_true(number_parse_whole(STR("-2"), -2, 5, &whole) && whole == -2);
    assert_true(number_parse_whole(STR("5"), -2, 5, &whole) && whole == 5);
    assert_false(number_parse_whole(STR("-3"), -2, 5, &whole) ||
                 number_parse_whole(STR("6"), -2, 5, &whole) ||
                 number_parse_whole(STR("1.0"), -2, 5, &whole) || number_parse_whole(STR(""), -2, 5, &whole));
    assert_int_equal(whole, 5);
    assert_true(number_parse_real(STR("0.25"), 0.25, 0.5, &real) && real == 0.25);
    assert_true(number_parse_real(STR("5e-1"), 0.25, 0.5, &real) && real == 0.5);
    assert_false(number_parse_real(STR("0.2499"), 0.25, 0.5, &real) ||
                 number_parse_real(STR("0.51"), 0.25, 0.5, &real) ||
                 number_parse_real(STR("nan"), 0.25, 0.5, &real));
    assert_true(real == 0.5);
}

static void sizes(void **state) {
    static const char *const bad[] = {"",    "x",   "4",   "4x",  "x4",  "4x4x4",
                                      "0x4", "4x0", "9x1", "1x9", "4y4", "4X4"};
    int32_t width = 0, height = 0;
    (void)state;
    assert_true(number_parse_size(STR("1x8"), "x", 8, &width, &height) && width == 1 && height == 8);
    assert_true(number_parse_size(STR("8X1"), "xX", 8, &width, &height) && width == 8 && height == 1);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(number_parse_size(str_from(bad[i]), "x", 8, &width, &height));
    assert_false(number_parse_size((str){"4\0004", 3}, "x", 8, &width, &height));
    assert_int_equal(width, 8);
}

static void every_status_has_words(void **state) {
    (void)state;
    for (int a = NUMBER_OK; a <= NUMBER_DASH; a++) {
        assert_non_null(number_problem((enum number_status)a));
        for (int b = NUMBER_OK; b < a; b++)
            assert_string_not_equal(number_problem((enum number_status)a),
                                    number_problem((enum number_status)b));
    }
}

// Decimals of every length and size, those around the limits of the fast path among them.
static void parses_as_strtod_does(void **state) {
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 400000; i++) {
        char text[80];
        uint64_t mantissa = random_bits(&seed) >> random_bits(&seed) % 64;
        int exponent = (int)(random_bits(&seed) % 64) - 32;
        if (i % 8 == 0)
            exponent = (int)(random_bits(&seed) % 700) - 350;
        if (i % 2)
            snprintf(text, sizeof text, "%llue%d", (unsigned long long)mantissa, exponent);
        else
            snprintf(text, sizeof text, "%s%llu.%0*llu", i % 4 ? "-" : "",
                     (unsigned long long)(mantissa % 100000), (int)(seed % 12) + 6,
                     (unsigned long long)(random_bits(&seed) % 1000000));
        double value;
        double expected = strtod(text, NULL);
        enum number_status status = number_parse(str_from(text), &value);
        if (isinf(expected) ? status != NUMBER_OVERFLOW
            : expected == 0 ? value != 0
                            : status != NUMBER_OK || to_bits(value) != to_bits(expected))
            fail_msg("%s: %.17g, strtod %.17g", text, value, expected);
    }
}

static size_t digit_count(const char *text) {
    size_t count = 0;
    size_t zeros = 0;
    for (const char *p = text; *p && *p != 'e'; p++) {
        if (*p < '0' || *p > '9' || (*p == '0' && count == 0))
            continue;
        count++;
        zeros = *p == '0' ? zeros + 1 : 0;
    }
    return count > zeros ? count - zeros : 1;
}

// Whether a decimal of `digits` digits reads as `value`: only the two around it can.
static bool has_shorter(double value, size_t digits) {
    char text[40];
    snprintf(text, sizeof text, "%.*e", (int)digits - 1, fabs(value));
    if (strtod(text, NULL) == fabs(value))
        return true;
    long exponent = strtol(strchr(text, 'e') + 1, NULL, 10);
    uint64_t mantissa = 0;
    for (const char *p = text; *p != 'e'; p++)
        if (*p != '.')
            mantissa = mantissa * 10 + (uint64_t)(*p - '0');
    for (int step = -1; step <= 1; step += 2) {
        snprintf(text, sizeof text, "%llue%ld", (unsigned long long)(mantissa + (uint64_t)step),
                 exponent - (long)digits + 1);
        if (strtod(text, NULL) == fabs(value))
            return true;
    }
    return false;
}

static void check_format(double value) {
    char text[NUMBER_FORMAT_MAX];
    memset(text, 'X', sizeof text);
    size_t length = number_format(value, text);
    assert_int_equal(length, strlen(text));
    double read;
    if (number_parse((str){text, length}, &read) != NUMBER_OK || read != value)
        fail_msg("%.17g was written as %s, which reads as %.17g", value, text, read);
    size_t digits = digit_count(text);
    if (digits > 17 || (digits > 1 && has_shorter(value, digits - 1)))
        fail_msg("%.17g was written as %s: too long", value, text);
}

static void writes_the_shortest_of_random_doubles(void **state) {
    (void)state;
    uint64_t seed = 42;
    for (int i = 0; i < 100000; i++) {
        double value = from_bits(random_bits(&seed));
        if (isfinite(value) && value != 0)
            check_format(value);
    }
    for (int i = 0; i < 20000; i++) {
        check_format(from_bits(1 + (random_bits(&seed) >> (12 + random_bits(&seed) % 50)))); // denormals
        check_format((double)(float)(from_bits(random_bits(&seed) >> 12 | UINT64_C(0x3FF) << 52) - 1.5));
    }
}

static void writes_the_shortest_of_decimals(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int i = 0; i < 100000; i++) {
        double value = (double)(1 + (random_bits(&seed) >> (14 + random_bits(&seed) % 48)));
        value /= pow(10, (double)(random_bits(&seed) % 20));
        check_format(i % 2 ? value : -value);
    }
}

// Below a power of two the doubles lie closer: the nearest 16 digits may miss, and others not.
static void writes_the_shortest_of_powers_of_two(void **state) {
    (void)state;
    for (int exponent = -1074; exponent <= 1023; exponent++) {
        check_format(ldexp(1, exponent));
        check_format(nextafter(ldexp(1, exponent), INFINITY));
        check_format(nextafter(ldexp(1, exponent), DBL_MIN));
    }
    char text[NUMBER_FORMAT_MAX];
    number_format(ldexp(1, -44), text);
    assert_string_equal(text, "5.684341886080802e-14");
}

struct layout_case {
    double value;
    const char *text;
};

static void lays_numbers_out(void **state) {
    (void)state;
    const struct layout_case cases[] = {
        {0, "0"},
        {-0.0, "0"},
        {1, "1"},
        {-1, "-1"},
        {0.5, "0.5"},
        {-4.15, "-4.15"},
        {100, "100"},
        {1024, "1024"},
        {0.1 + 0.2, "0.30000000000000004"},
        {1.0 / 3, "0.3333333333333333"},
        {2.0 / 3e4, "0.00006666666666666667"},
        {0.0009765625, "0.0009765625"},
        {0.00001, "0.00001"},
        {0.000012, "0.000012"},
        {0.0000099, "9.9e-06"},
        {1e-6, "1.0e-06"},
        {1e14, "100000000000000"},
        {1e15, "1000000000000000"},
        {123456789012345.0, "123456789012345"},
        {1234567890123456.0, "1234567890123456"},
        {9999999999999998.0, "9999999999999998"},
        {1e16, "1.0e+16"},
        {1e20, "1.0e+20"},
        {-1.5e20, "-1.5e+20"},
        {1e22, "1.0e+22"},
        {1e23, "1.0e+23"},
        {1e18, "1.0e+18"},
        {12345.678, "12345.678"},
        {999999999999999.9, "999999999999999.9"},
        {DBL_MAX, "1.7976931348623157e+308"},
        {-DBL_MAX, "-1.7976931348623157e+308"},
        {DBL_MIN, "2.2250738585072014e-308"},
        {4.9406564584124654e-324, "5.0e-324"},
        {INFINITY, ".inf"},
        {-INFINITY, "-.inf"},
        {NAN, ".nan"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[NUMBER_FORMAT_MAX];
        assert_int_equal(number_format(cases[i].value, text), strlen(cases[i].text));
        assert_string_equal(text, cases[i].text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accepts_the_grammar),
        cmocka_unit_test(explains_what_it_refuses),
        cmocka_unit_test(takes_a_number_from_the_beginning),
        cmocka_unit_test(long_texts_end_at_1000_characters),
        cmocka_unit_test(integers),
        cmocka_unit_test(within_a_range),
        cmocka_unit_test(sizes),
        cmocka_unit_test(every_status_has_words),
        cmocka_unit_test(parses_as_strtod_does),
        cmocka_unit_test(writes_the_shortest_of_random_doubles),
        cmocka_unit_test(writes_the_shortest_of_decimals),
        cmocka_unit_test(writes_the_shortest_of_powers_of_two),
        cmocka_unit_test(lays_numbers_out),
    };
    return cmocka_run_group_tests_name("number", tests, NULL, NULL);
}
