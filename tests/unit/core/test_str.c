#include "core/str.h"
#include "core/unicode.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void compares(void **state) {
    (void)state;
    assert_true(str_equal(STR("abc"), str_from("abc")));
    assert_false(str_equal(STR("abc"), STR("abd")));
    assert_false(str_equal(STR("abc"), STR("ab")));
    assert_true(str_equal((str){0}, STR("")));
    assert_int_equal(str_from(NULL).len, 0);
    assert_true(str_equal_cstr(STR("a\0b"), "a") == false);
    assert_true(str_compare(STR("a"), STR("b")) < 0);
    assert_true(str_compare(STR("ab"), STR("a")) > 0);
    assert_true(str_compare(STR("a"), STR("ab")) < 0);
    assert_true(str_compare(STR("\xC3"), STR("z")) > 0);
    assert_int_equal(str_compare((str){0}, STR("")), 0);
    assert_true(str_starts_with(STR("abc"), STR("ab")));
    assert_false(str_starts_with(STR("ab"), STR("abc")));
    assert_true(str_starts_with((str){0}, STR("")));
    assert_true(str_ends_with_nocase(STR("a.YaML"), ".yaml"));
    assert_false(str_ends_with_nocase(STR("yaml"), ".yaml"));
    // '[' is 'A' + 26 and '{' is 'a' + 26: neither is a letter.
    assert_false(str_ends_with_nocase(STR("["), "{"));
}

static void slices_and_trims(void **state) {
    (void)state;
    assert_true(str_equal(str_slice(STR("hello"), 1, 3), STR("el")));
    assert_true(str_equal(str_slice(STR("hello"), 3, 99), STR("lo")));
    assert_int_equal(str_slice(STR("hello"), 9, 99).len, 0);
    assert_int_equal(str_slice(STR("hello"), 3, 1).len, 0);
    assert_int_equal(str_slice((str){0}, 0, 5).len, 0);
    assert_true(str_equal(str_trim(STR(" \t\r\na b\n ")), STR("a b")));
    assert_int_equal(str_trim(STR(" \n ")).len, 0);
    assert_int_equal(str_trim((str){0}).len, 0);
    assert_true(str_equal(str_trim(STR("\v")), STR("\v")));
}

static void hash_is_fnv1a(void **state) {
    (void)state;
    assert_true(str_hash(STR("")) == UINT64_C(0xcbf29ce484222325));
    assert_true(str_hash(STR("a")) == UINT64_C(0xaf63dc4c8601ec8c));
    assert_true(str_hash(STR("foobar")) == UINT64_C(0x85944171f73967e8));
}

struct sequence {
    const char *bytes;
    size_t length;
};

static void utf8_accepts_exactly_table_3_7(void **state) {
    (void)state;
    static const struct sequence cases[] = {
        {"a", 1},
        {"\x7F", 1},
        {"\x80", 0},
        {"\xC0\x80", 0},
        {"\xC1\xBF", 0},
        {"\xC2\x80", 2},
        {"\xDF\xBF", 2},
        {"\xC2", 0},
        {"\xC2\x7F", 0},
        {"\xC2\xC0", 0},
        {"\xE0\x9F\xBF", 0},
        {"\xE0\xA0\x80", 3},
        {"\xED\x9F\xBF", 3},
        {"\xED\xA0\x80", 0},
        {"\xED\xBF\xBF", 0},
        {"\xEE\x80\x80", 3},
        {"\xEF\xBF\xBF", 3},
        {"\xE2\x82", 0},
        {"\xF0\x8F\xBF\xBF", 0},
        {"\xF0\x90\x80\x80", 4},
        {"\xF4\x8F\xBF\xBF", 4},
        {"\xF4\x90\x80\x80", 0},
        {"\xF5\x80\x80\x80", 0},
        {"\xFF", 0},
        {"\xF0\x90\x80", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(utf8_sequence_length(str_from(cases[i].bytes), 0), cases[i].length);
    assert_int_equal(utf8_sequence_length(STR("a"), 1), 0);
    assert_int_equal(utf8_sequence_length((str){0}, 0), 0);
}

static size_t encode(uint32_t c, char out[4]) {
    if (c < 0x80) {
        out[0] = (char)c;
        return 1;
    }
    size_t n = c < 0x800 ? 2 : c < 0x10000 ? 3 : 4;
    for (size_t i = n - 1; i > 0; i--, c >>= 6)
        out[i] = (char)(0x80 | (c & 0x3F));
    out[0] = (char)((0xF00 >> n & 0xFF) | c);
    return n;
}

static void every_code_point_decodes(void **state) {
    (void)state;
    for (uint32_t c = 0; c <= 0x10FFFF; c++) {
        char bytes[4];
        size_t n = encode(c, bytes);
        bool surrogate = c >= 0xD800 && c <= 0xDFFF;
        if (utf8_sequence_length((str){bytes, n}, 0) != (surrogate ? 0 : n))
            fail_msg("U+%04X", c);
        if (!surrogate && utf8_decode((str){bytes, n}, 0) != c)
            fail_msg("U+%04X", c);
    }
}

static void first_error_and_count(void **state) {
    (void)state;
    assert_int_equal(utf8_first_error(STR("")), 0);
    assert_int_equal(utf8_first_error((str){0}), 0);
    assert_int_equal(utf8_first_error(STR("abcdefghijklmnop\xE2\x82\xAC!")), 20);
    assert_int_equal(utf8_first_error(STR("abcdefghijk\xFFlmnop")), 11);
    assert_int_equal(utf8_first_error(STR("ab\xE2\x82")), 2);
    assert_int_equal(utf8_first_error(STR("\0\0")), 2);
    assert_int_equal(utf8_count((str){0}), 0);
    assert_int_equal(utf8_count(STR("abcdefghijklmnop\xE2\x82\xAC!")), 18);
    assert_int_equal(utf8_count(STR("\xE2\x82")), 2);
    assert_int_equal(utf8_count(STR("\xF0\x9F\x98\x80")), 1);
}

// The eight-bytes-at-a-time run must find an odd byte at every offset.
static void runs_of_ascii_end_where_they_end(void **state) {
    (void)state;
    char bytes[40];
    for (size_t at = 0; at < sizeof bytes; at++) {
        memset(bytes, 'x', sizeof bytes);
        bytes[at] = '\xFF';
        assert_int_equal(utf8_first_error((str){bytes, sizeof bytes}), at);
        assert_int_equal(utf8_count((str){bytes, sizeof bytes}), sizeof bytes);
    }
}

static void names_of_any_script(void **state) {
    (void)state;
    static const char *const good[] = {
        "a",
        "NO",
        "_",
        "-",
        "glass_2",
        "a-b",
        "Zürich",
        "стекло",
        "玻璃",
        "ガラス",
        "유리",
        "زجاج",
        "काँच",
        "แก้ว",
        "γυαλί",
        "ß",
        "ª",
        "x\xCC\x81" /* a combining accent */,
        "a٣" /* an Arabic digit */,
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        if (!str_is_name(str_from(good[i])))
            fail_msg("'%s' is a name", good[i]);
    static const char *const bad[] = {
        "",     "1a", "٣a",           "a b",           "a.b",           "a[0]",          "a\n",
        "a/b",  "é!", "a\xC2\xA0",    "a\xE2\x80\x8B", "a\xE2\x80\xAE", "\357\273\277a", "a×b",
        "a€",   "😀",  "\xEE\x80\x80", "\xFF",          "a\xE2\x80\xA6", "a\xE3\x80\x80", "\xE3\x85\xA4",
        "a－b",
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        if (str_is_name(str_from(bad[i])))
            fail_msg("'%s' is no name", bad[i]);
    assert_false(str_is_name(STR("a\0b")));
    assert_false(str_is_name((str){0}));
}

static void names_have_128_letters_at_most(void **state) {
    (void)state;
    char text[2 * 129];
    for (size_t i = 0; i < 129; i++)
        memcpy(text + 2 * i, "é", 2);
    assert_true(str_is_name((str){text, (size_t)2 * 128}));
    assert_false(str_is_name((str){text, (size_t)2 * 129}));
}

static void widths(void **state) {
    (void)state;
    assert_int_equal(unicode_width('a'), 1);
    assert_int_equal(unicode_width(0xE9), 1);
    assert_int_equal(unicode_width(0x301), 0);
    assert_int_equal(unicode_width(0x200D), 0);
    assert_int_equal(unicode_width(0x4E00), 2);
    assert_int_equal(unicode_width(0xAC00), 2);
    assert_int_equal(unicode_width(0xFF21), 2);
    assert_int_equal(unicode_width(0x1F600), 2);
    assert_int_equal(unicode_width(0x10FFFF), 1);
    assert_true(unicode_is_control(0));
    assert_true(unicode_is_control(0x1B));
    assert_true(unicode_is_control(0x9B));
    assert_true(unicode_is_control(0x202E));
    assert_false(unicode_is_control(' '));
    assert_false(unicode_is_control(0xA0));
}

static void blanks_and_line_ends(void **state) {
    (void)state;
    for (int c = 0; c < 256; c++) {
        bool blank = c == ' ' || c == '\t', ends = c == '\n' || c == '\r';
        assert_int_equal(char_is_blank((char)c), blank);
        assert_int_equal(char_is_break((char)c), ends);
        assert_int_equal(char_is_space((char)c), blank || ends);
    }
    str text = STR("a\r\nb\n\r");
    assert_int_equal(str_break_length(text, 1), 2);
    assert_int_equal(str_break_length(text, 2), 1);
    assert_int_equal(str_break_length(text, 4), 1);
    assert_int_equal(str_break_length(text, 5), 1); // nothing behind it is looked at
}

static void finds_the_line_end_of_most_lines(void **state) {
    (void)state;
    assert_true(str_equal(str_line_end(STR("")), STR("\n")));
    assert_true(str_equal(str_line_end(STR("a\r\nb\r\nc\n")), STR("\r\n")));
    assert_true(str_equal(str_line_end(STR("a\rb\rc\n")), STR("\r")));
    assert_true(str_equal(str_line_end(STR("a\r\nb\n")), STR("\n")));
    assert_true(str_equal(str_line_end(STR("a\r\nb\r")), STR("\r\n")));
    assert_int_equal(str_skip_mark(STR("\xEF\xBB\xBFx")), 3);
    assert_int_equal(str_skip_mark(STR("\xEF\xBB")), 0);
}

static void letters_and_digits(void **state) {
    (void)state;
    static const char digits[] = "0123456789abcdef", capitals[] = "ABCDEF";
    for (int i = 0; i < 256; i++) {
        const char c = (char)i;
        const char *digit = c ? strchr(digits, c) : NULL, *capital = c ? strchr(capitals, c) : NULL;
        assert_int_equal(char_hex(c), digit ? digit - digits : capital ? capital - capitals + 10 : -1);
        const bool is_capital = i >= 'A' && i <= 'Z';
        assert_int_equal(char_is_letter(c), is_capital || (i >= 'a' && i <= 'z'));
        assert_int_equal(char_lower(c), (char)(is_capital ? i + 32 : i));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_and_digits),
        cmocka_unit_test(compares),
        cmocka_unit_test(slices_and_trims),
        cmocka_unit_test(blanks_and_line_ends),
        cmocka_unit_test(hash_is_fnv1a),
        cmocka_unit_test(utf8_accepts_exactly_table_3_7),
        cmocka_unit_test(every_code_point_decodes),
        cmocka_unit_test(first_error_and_count),
        cmocka_unit_test(runs_of_ascii_end_where_they_end),
        cmocka_unit_test(names_of_any_script),
        cmocka_unit_test(names_have_128_letters_at_most),
        cmocka_unit_test(widths),
        cmocka_unit_test(finds_the_line_end_of_most_lines),
    };
    return cmocka_run_group_tests_name("str", tests, NULL, NULL);
}
