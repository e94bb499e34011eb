#include "diag/source.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct fixture {
    struct arena arena;
    struct source_set set;
};

static int set_up(void **state) {
    struct fixture *f = calloc(1, sizeof *f);
    if (!f)
        return -1;
    arena_init(&f->arena, SIZE_MAX);
    source_set_init(&f->set, &f->arena);
    *state = f;
    return 0;
}

static int tear_down(void **state) {
    struct fixture *f = *state;
    arena_finish(&f->arena);
    free(f);
    return 0;
}

static uint32_t add(struct fixture *f, str text) {
    return source_add(&f->set, SOURCE_KIND_FILE, STR("file"), text);
}

static void expect(struct fixture *f, span at, uint32_t line, uint32_t column, const char *text) {
    struct source_place place = source_locate(&f->set, at);
    if (place.line != line || place.column != column || !str_equal_cstr(place.line_text, text))
        fail_msg("byte %u: %u:%u '%.*s', expected %u:%u '%s'", at.begin, place.line, place.column,
                 STR_ARG(place.line_text), line, column, text);
}

static void source_0_is_the_default(void **state) {
    struct fixture *f = *state;
    assert_int_equal(f->set.count, 1);
    assert_int_equal(f->set.items[0].kind, SOURCE_KIND_DEFAULT);
    struct source_place place = source_locate(&f->set, SPAN_NONE);
    assert_true(str_equal_cstr(place.path, "default"));
    assert_int_equal(place.line, 1);
    assert_int_equal(place.column, 1);
    assert_int_equal(place.line_text.len, 0);
    assert_true(span_is_none(SPAN_NONE));
    // A source that does not exist is shown as the default, never read.
    assert_true(str_equal_cstr(source_locate(&f->set, (span){99, 5, 6}).path, "default"));
    assert_int_equal(source_text(&f->set, (span){99, 0, 5}).len, 0);
}

static void an_empty_source_has_one_place(void **state) {
    struct fixture *f = *state;
    uint32_t s = add(f, STR(""));
    assert_int_equal(s, 1);
    expect(f, (span){s, 0, 0}, 1, 1, "");
    expect(f, (span){s, 7, 9}, 1, 1, "");
    uint32_t none = add(f, (str){0});
    expect(f, (span){none, 0, 0}, 1, 1, "");
}

static void lines_end_in_three_ways(void **state) {
    struct fixture *f = *state;
    uint32_t s = add(f, STR("a\nbc\r\nd\re\n\nf"));
    expect(f, (span){s, 0, 1}, 1, 1, "a");
    expect(f, (span){s, 1, 1}, 1, 2, "a"); // the line end belongs to its line
    expect(f, (span){s, 2, 4}, 2, 1, "bc");
    expect(f, (span){s, 4, 4}, 2, 3, "bc"); // \r of \r\n
    expect(f, (span){s, 5, 5}, 2, 4, "bc"); // \n of \r\n
    expect(f, (span){s, 6, 7}, 3, 1, "d");
    expect(f, (span){s, 7, 7}, 3, 2, "d"); // a lone \r
    expect(f, (span){s, 8, 9}, 4, 1, "e");
    expect(f, (span){s, 10, 10}, 5, 1, "");
    expect(f, (span){s, 11, 12}, 6, 1, "f");
    expect(f, (span){s, 12, 12}, 6, 2, "f");
}

static void a_closing_line_end_opens_an_empty_line(void **state) {
    struct fixture *f = *state;
    uint32_t s = add(f, STR("a\n"));
    expect(f, (span){s, 2, 2}, 2, 1, "");
    uint32_t cr = add(f, STR("\r\r\n\r"));
    expect(f, (span){cr, 0, 0}, 1, 1, "");
    expect(f, (span){cr, 1, 1}, 2, 1, "");
    expect(f, (span){cr, 3, 3}, 3, 1, "");
    expect(f, (span){cr, 4, 4}, 4, 1, "");
}

static void columns_count_code_points(void **state) {
    struct fixture *f = *state;
    uint32_t s = add(f, STR("\té漢😀x\xFFy"));
    expect(f, (span){s, 1, 3}, 1, 2, "\té漢😀x\xFFy");
    expect(f, (span){s, 3, 6}, 1, 3, "\té漢😀x\xFFy");
    expect(f, (span){s, 6, 10}, 1, 4, "\té漢😀x\xFFy");
    expect(f, (span){s, 10, 11}, 1, 5, "\té漢😀x\xFFy");
    expect(f, (span){s, 11, 12}, 1, 6, "\té漢😀x\xFFy");
    expect(f, (span){s, 12, 13}, 1, 7, "\té漢😀x\xFFy");
    // A byte inside a character is that character.
    expect(f, (span){s, 2, 3}, 1, 2, "\té漢😀x\xFFy");
    expect(f, (span){s, 9, 10}, 1, 4, "\té漢😀x\xFFy");
    assert_int_equal(source_locate(&f->set, (span){s, 3, 10}).end_column, 5);
}

static void a_byte_order_mark_takes_no_column(void **state) {
    struct fixture *f = *state;
    uint32_t s = add(f, STR("\xEF\xBB\xBF"
                            "ab\ncd"));
    expect(f, (span){s, 0, 3}, 1, 1, "ab");
    expect(f, (span){s, 3, 4}, 1, 1, "ab");
    expect(f, (span){s, 4, 5}, 1, 2, "ab");
    expect(f, (span){s, 6, 7}, 2, 1, "cd");
    uint32_t alone = add(f, STR("\xEF\xBB\xBF"));
    expect(f, (span){alone, 3, 3}, 1, 1, "");
}

static void spans_past_the_end_are_clamped(void **state) {
    struct fixture *f = *state;
    uint32_t s = add(f, STR("ab\ncd"));
    expect(f, (span){s, 500, 600}, 2, 3, "cd");
    expect(f, (span){s, UINT32_MAX, UINT32_MAX}, 2, 3, "cd");
    struct source_place place = source_locate(&f->set, (span){s, 4, 1});
    assert_int_equal(place.end_line, 2);
    assert_int_equal(place.end_column, place.column);
    assert_true(str_equal_cstr(source_text(&f->set, (span){s, 3, 99}), "cd"));
    assert_int_equal(source_text(&f->set, (span){s, 9, 12}).len, 0);
    place = source_locate(&f->set, (span){s, 1, 4});
    assert_int_equal(place.line, 1);
    assert_int_equal(place.end_line, 2);
    assert_int_equal(place.end_column, 2);
}

// Text is made after memory has ended and its guard is gone: nothing may jump, and places stay right.
static void works_without_memory_for_its_map(void **state) {
    struct fixture *f = *state;
    uint32_t s = add(f, STR("a\nbc\r\nd\re\n\nf"));
    struct source_place expected[14];
    struct fixture full = {0};
    arena_init(&full.arena, SIZE_MAX);
    source_set_init(&full.set, &full.arena);
    source_add(&full.set, SOURCE_KIND_FILE, STR("file"), f->set.items[s].text);
    full.arena.cap_bytes = full.arena.used_bytes;
    for (uint32_t i = 0; i < 14; i++) {
        expected[i] = source_locate(&f->set, (span){s, i, i + 3});
        struct source_place place = source_locate(&full.set, (span){s, i, i + 3});
        assert_int_equal(place.line, expected[i].line);
        assert_int_equal(place.column, expected[i].column);
        assert_int_equal(place.end_line, expected[i].end_line);
        assert_int_equal(place.end_column, expected[i].end_column);
        assert_true(str_equal(place.line_text, expected[i].line_text));
    }
    assert_null(full.set.items[s].line_starts);
    arena_finish(&full.arena);
}

static void spans_join(void **state) {
    (void)state;
    span a = {1, 5, 8};
    span b = {1, 2, 6};
    span other = {2, 0, 99};
    span ab = span_join(a, b);
    assert_true(ab.source == 1 && ab.begin == 2 && ab.end == 8);
    assert_int_equal(span_join(SPAN_NONE, a).begin, 5);
    assert_int_equal(span_join(a, SPAN_NONE).end, 8);
    assert_int_equal(span_join(a, other).source, 1);
}

static void many_sources_keep_their_places(void **state) {
    struct fixture *f = *state;
    char name[2] = "A";
    for (int i = 0; i < 26; i++) {
        name[0] = (char)('A' + i);
        source_add(&f->set, SOURCE_KIND_OPTION, str_from(name), STR("x\ny"));
        expect(f, (span){(uint32_t)i + 1, 2, 3}, 2, 1, "y");
    }
    // The path was copied.
    assert_true(str_equal_cstr(source_locate(&f->set, (span){1, 0, 0}).path, "A"));
    assert_int_equal(f->set.items[1].kind, SOURCE_KIND_OPTION);
}

int main(void) {
#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        T(source_0_is_the_default),
        T(an_empty_source_has_one_place),
        T(lines_end_in_three_ways),
        T(a_closing_line_end_opens_an_empty_line),
        T(columns_count_code_points),
        T(a_byte_order_mark_takes_no_column),
        T(spans_past_the_end_are_clamped),
        T(works_without_memory_for_its_map),
        T(spans_join),
        T(many_sources_keep_their_places),
    };
    return cmocka_run_group_tests_name("source", tests, NULL, NULL);
}
