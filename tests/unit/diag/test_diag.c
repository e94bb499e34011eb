#include "diag/codes/binding.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "diag/codes/rule.h"
#include "diag/codes/syntax.h"
#include "diag/diag.h"
#include "diag/diag_share.h"
#include "diag/diag_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct fixture {
    struct arena arena;
    struct source_set sources;
    struct diag_sink sink;
    struct strbuf text;
};

static int set_up(void **state) {
    struct fixture *f = calloc(1, sizeof *f);
    if (!f)
        return -1;
    arena_init(&f->arena, SIZE_MAX);
    source_set_init(&f->sources, &f->arena);
    diag_sink_init(&f->sink);
    strbuf_init(&f->text);
    *state = f;
    return 0;
}

static int tear_down(void **state) {
    struct fixture *f = *state;
    strbuf_finish(&f->text);
    diag_sink_finish(&f->sink);
    arena_finish(&f->arena);
    free(f);
    return 0;
}

static const struct diag_text_options plain = {.notes = true};

static void expect_text(struct fixture *f, struct diag_text_options options, const char *expected) {
    strbuf_clear(&f->text);
    diag_text(&f->text, &f->sink, &f->sources, options);
    assert_string_equal(strbuf_view(&f->text).ptr, expected);
}

static uint32_t add_source(struct fixture *f, const char *text) {
    return source_add(&f->sources, SOURCE_KIND_FILE, STR("a.yaml"), str_from(text));
}

// ---- the table of codes

static void codes_are_well_formed_and_unique(void **state) {
    (void)state;
    for (diag_code i = diag_next(-1); i < DIAG_CODE_COUNT; i = diag_next(i)) {
        const struct diag_info *info = diag_info(i);
        assert_int_equal(strlen(info->code), 4);
        assert_int_equal(strspn(info->code + 1, "0123456789"), 3);
        assert_true(info->severity == (info->code[0] == 'E'   ? DIAG_ERROR
                                       : info->code[0] == 'W' ? DIAG_WARNING
                                                              : DIAG_NOTE));
        assert_non_null(strchr("EWN", info->code[0]));
        assert_in_range(info->code[1], '1', '9');
        assert_in_range(info->where, 1, 31);
        assert_true(strlen(info->title) > 3 && strlen(info->title) < 80);
        assert_true(info->meaning[strlen(info->meaning) - 1] == '.');
        assert_true(info->remedy[strlen(info->remedy) - 1] == '.');
        assert_int_equal(diag_find(str_from(info->code)), i);
        for (diag_code j = diag_next(-1); j < i; j = diag_next(j))
            assert_string_not_equal(info->code, diag_info(j)->code);
    }
}

static void finds_codes(void **state) {
    (void)state;
    assert_int_equal(diag_find(STR("e202")), DIAG_UNKNOWN_NAME);
    assert_int_equal(diag_find(STR("E2022")), DIAG_CODE_COUNT);
    assert_int_equal(diag_find(STR("202")), DIAG_CODE_COUNT);
    assert_int_equal(diag_find(STR("")), DIAG_CODE_COUNT);
    assert_string_equal(diag_severity_name(DIAG_ERROR), "error");
    assert_string_equal(diag_severity_name(DIAG_WARNING), "warning");
    assert_string_equal(diag_severity_name(DIAG_NOTE), "note");
}

// ---- collecting

static void collects_all_parts(void **state) {
    struct fixture *f = *state;
    char name[] = "colr";
    struct diag *d = diag_add(&f->sink, DIAG_UNKNOWN_NAME, (span){1, 2, 6}, "unknown key '%s'", name);
    diag_note(&f->sink, (span){1, 0, 1}, "first");
    diag_note(&f->sink, SPAN_NONE, "second %d", 2);
    diag_help(&f->sink, "did you mean '%s'?", "color");
    diag_fix(&f->sink, true, (span){1, 2, 6}, STR("color"));
    name[0] = 'X';
    assert_ptr_equal(d, &f->sink.items[0]);
    assert_true(str_equal_cstr(d->message, "unknown key 'colr'"));
    assert_true(str_equal_cstr(d->notes->message, "first"));
    assert_true(str_equal_cstr(d->notes->next->message, "second 2"));
    assert_null(d->notes->next->next);
    assert_true(str_equal_cstr(d->help, "did you mean 'color'?"));
    assert_true(d->has_fix && d->fix_is_safe);
    assert_true(str_equal_cstr(d->fix_text, "color"));
    diag_fix(&f->sink, false, (span){1, 2, 6}, (str){0});
    assert_int_equal(d->fix_text.len, 0);
    assert_int_equal(f->sink.errors, 1);
    diag_add(&f->sink, DIAG_OPEN_DIELECTRIC, SPAN_NONE, "open");
    diag_add(&f->sink, DIAG_DEFAULT_CAMERA, SPAN_NONE, "camera");
    assert_int_equal(f->sink.warnings, 1);
    assert_int_equal(f->sink.notes, 1);
    assert_int_equal(f->sink.count, 3);
}

static void parts_without_a_diagnostic_do_nothing(void **state) {
    struct fixture *f = *state;
    diag_note(&f->sink, SPAN_NONE, "note");
    diag_help(&f->sink, "help");
    diag_fix(&f->sink, true, SPAN_NONE, STR("fix"));
    diag_sort(&f->sink);
    assert_int_equal(f->sink.count, 0);
}

static void long_messages_are_cut_between_characters(void **state) {
    struct fixture *f = *state;
    char text[3001];
    for (size_t i = 0; i < 1500; i++)
        memcpy(text + 2 * i, "é", 2);
    text[3000] = '\0';
    for (int shift = 0; shift < 2; shift++) {
        struct diag *d = diag_add(&f->sink, DIAG_LIMIT, SPAN_NONE, "%s%s", shift ? "x" : "", text);
        assert_in_range(d->message.len, 1990, 2000);
        assert_int_equal(utf8_first_error(d->message), d->message.len);
        assert_memory_equal(d->message.ptr + d->message.len - 3, "...", 3);
    }
    text[2000] = '\0';
    assert_int_equal(diag_add(&f->sink, DIAG_LIMIT, SPAN_NONE, "%s", text)->message.len, 2000);
}

// ---- a sink whose memory has ended

static void the_first_diagnostic_may_find_no_memory(void **state) {
    struct fixture *f = *state;
    f->sink.arena.cap_bytes = 0;
    struct diag *d = diag_add(&f->sink, DIAG_LIMIT, (span){1, 2, 3}, "message");
    assert_non_null(d);
    assert_int_equal(d->code, DIAG_LIMIT);
    diag_note(&f->sink, SPAN_NONE, "note");
    diag_help(&f->sink, "help");
    diag_fix(&f->sink, true, SPAN_NONE, STR("fix"));
    assert_int_equal(f->sink.count, 0);
    assert_int_equal(f->sink.dropped, 1);
    assert_int_equal(f->sink.errors, 1);
    diag_sort(&f->sink);
    expect_text(f, plain, "glint: 1 more message not shown (E501: 1); --limit messages=10001 shows more\n");
}

// What belongs to a dropped diagnostic must not land on the one before it.
static void parts_of_a_dropped_one_are_dropped(void **state) {
    struct fixture *f = *state;
    diag_add(&f->sink, DIAG_BAD_NUMBER, (span){1, 2, 3}, "kept");
    f->sink.arena.cap_bytes = f->sink.arena.used_bytes + 8;
    diag_add(&f->sink, DIAG_BAD_NUMBER, (span){1, 4, 5}, "a message longer than what is left");
    diag_note(&f->sink, SPAN_NONE, "n");
    diag_help(&f->sink, "h");
    diag_fix(&f->sink, true, SPAN_NONE, STR("f"));
    assert_int_equal(f->sink.count, 1);
    assert_int_equal(f->sink.dropped, 1);
    assert_int_equal(f->sink.errors, 2);
    assert_null(f->sink.items[0].notes);
    assert_int_equal(f->sink.items[0].help.len, 0);
    assert_false(f->sink.items[0].has_fix);
}

static void a_full_sink_counts_on(void **state) {
    struct fixture *f = *state;
    f->sink.arena.cap_bytes = 20000;
    for (uint32_t i = 0; i < 1000; i++) {
        diag_add(&f->sink, DIAG_BAD_NUMBER, (span){1, i, i + 1}, "number %u", i);
        diag_note(&f->sink, SPAN_NONE, "note of %u", i);
        diag_help(&f->sink, "help of %u", i);
    }
    assert_int_equal(f->sink.errors, 1000);
    assert_int_equal(f->sink.count + f->sink.dropped, 1000);
    assert_in_range(f->sink.count, 10, 300);
    for (uint32_t i = 0; i < f->sink.count; i++) {
        char expected[32];
        const struct diag *d = &f->sink.items[i];
        snprintf(expected, sizeof expected, "number %u", d->at.begin);
        assert_true(str_equal_cstr(d->message, expected));
        snprintf(expected, sizeof expected, "help of %u", d->at.begin);
        assert_true(d->help.len == 0 || str_equal_cstr(d->help, expected));
        snprintf(expected, sizeof expected, "note of %u", d->at.begin);
        assert_true(!d->notes || (str_equal_cstr(d->notes->message, expected) && !d->notes->next));
    }
}

// ---- sorting, grouping, merging

static void sorts_by_source_and_place_stably(void **state) {
    struct fixture *f = *state;
    diag_add(&f->sink, DIAG_LIMIT, (span){2, 0, 1}, "d");
    diag_add(&f->sink, DIAG_LIMIT, (span){1, 9, 10}, "b");
    diag_add(&f->sink, DIAG_BAD_NUMBER, (span){1, 9, 9}, "c");
    diag_add(&f->sink, DIAG_LIMIT, (span){1, 3, 4}, "a");
    diag_add(&f->sink, DIAG_LIMIT, SPAN_NONE, "_");
    diag_sort(&f->sink);
    const char *const order[] = {"_", "a", "b", "c", "d"};
    assert_int_equal(f->sink.count, 5);
    for (int i = 0; i < 5; i++)
        assert_true(str_equal_cstr(f->sink.items[i].message, order[i]));
}

static void drops_exact_repeats_only(void **state) {
    struct fixture *f = *state;
    for (int i = 0; i < 3; i++) {
        diag_add(&f->sink, DIAG_LIMIT, (span){1, 3, 4}, "same");
        diag_add(&f->sink, DIAG_LIMIT, (span){1, 3, 4}, "other message");
        diag_add(&f->sink, DIAG_LIMIT, (span){1, 3, 5}, "same");
        diag_add(&f->sink, DIAG_BAD_NUMBER, (span){1, 3, 4}, "same");
        diag_add(&f->sink, DIAG_LIMIT, (span){2, 3, 4}, "same");
        diag_add(&f->sink, DIAG_OPEN_DIELECTRIC, (span){1, 3, 4}, "same");
        diag_add(&f->sink, DIAG_DEFAULT_LIGHT, (span){1, 3, 4}, "same");
    }
    diag_sort(&f->sink);
    assert_int_equal(f->sink.count, 7);
    assert_int_equal(f->sink.errors, 5);
    assert_int_equal(f->sink.warnings, 1);
    assert_int_equal(f->sink.notes, 1);
    diag_sort(&f->sink);
    assert_int_equal(f->sink.count, 7);
}

// A hostile mesh has a mistake in each of its lines: neither sorting nor looking for repeats is quadratic.
// A sink keeps so many and counts the rest.
static void sorts_all_it_keeps_at_one_place(void **state) {
    struct fixture *f = *state;
    for (uint32_t i = 0; i < DIAG_KEPT_MAX + 7; i++)
        diag_add(&f->sink, DIAG_LIMIT, SPAN_NONE, "%u", i % (DIAG_KEPT_MAX / 2));
    assert_true(diag_is_full(&f->sink));
    assert_int_equal(f->sink.dropped, 7);
    diag_sort(&f->sink);
    assert_int_equal(f->sink.count, DIAG_KEPT_MAX / 2);
    assert_int_equal(f->sink.errors, DIAG_KEPT_MAX / 2 + 7);
    assert_true(str_equal_cstr(f->sink.items[DIAG_KEPT_MAX / 2 - 1].message, "4999"));
}

static void merges_copies(void **state) {
    struct fixture *f = *state;
    struct diag_sink other;
    diag_sink_init(&other);
    diag_add(&f->sink, DIAG_BAD_NUMBER, (span){1, 5, 6}, "mine");
    diag_add(&other, DIAG_LIMIT, (span){1, 2, 3}, "theirs with %% and %s", "%d");
    diag_note(&other, (span){1, 0, 1}, "note");
    diag_note(&other, SPAN_NONE, "another");
    diag_help(&other, "help");
    diag_fix(&other, true, (span){1, 2, 3}, STR("fix"));
    diag_add(&other, DIAG_OPEN_DIELECTRIC, SPAN_NONE, "warning");
    other.arena.cap_bytes = 0;
    diag_add(&other, DIAG_LIMIT, SPAN_NONE, "dropped");
    diag_merge(&f->sink, &other);
    diag_sink_finish(&other);
    assert_int_equal(f->sink.count, 3);
    assert_int_equal(f->sink.errors, 3);
    assert_int_equal(f->sink.warnings, 1);
    assert_int_equal(f->sink.dropped, 1);
    assert_int_equal(f->sink.dropped_of[DIAG_LIMIT], 1);
    const struct diag *d = &f->sink.items[1];
    assert_true(str_equal_cstr(d->message, "theirs with % and %d"));
    assert_true(str_equal_cstr(d->notes->next->message, "another"));
    assert_true(str_equal_cstr(d->help, "help"));
    assert_true(str_equal_cstr(d->fix_text, "fix"));
    assert_null(f->sink.items[0].notes);
}

static void merging_into_a_full_sink_keeps_the_counts(void **state) {
    struct fixture *f = *state;
    struct diag_sink other;
    diag_sink_init(&other);
    for (int i = 0; i < 5; i++)
        diag_add(&other, DIAG_LIMIT, SPAN_NONE, "%d", i);
    f->sink.arena.cap_bytes = 0;
    diag_merge(&f->sink, &other);
    diag_sink_finish(&other);
    assert_int_equal(f->sink.errors, 5);
    assert_int_equal(f->sink.dropped, 5);
}

// ---- text

static void writes_a_caret(void **state) {
    struct fixture *f = *state;
    uint32_t s = add_source(f, "glint: 1\nspheres:\n  - colr: red\n");
    diag_add(&f->sink, DIAG_UNKNOWN_NAME, (span){s, 22, 26}, "unknown key 'colr'");
    diag_help(&f->sink, "did you mean 'color'?");
    expect_text(f, plain,
                "a.yaml:3:5: error: unknown key 'colr' [E202]\n"
                "     3 |   - colr: red\n"
                "       |     ^~~~\n"
                "       = help: did you mean 'color'?\n");
}

static void writes_notes_with_and_without_places(void **state) {
    struct fixture *f = *state;
    uint32_t s = add_source(f, "ab: 1\nab: 2\n");
    uint32_t option = source_add(&f->sources, SOURCE_KIND_OPTION, STR("--set"), STR("ab=3"));
    uint32_t empty = source_add(&f->sources, SOURCE_KIND_FILE, STR("empty.obj"), STR(""));
    diag_add(&f->sink, DIAG_DUPLICATE_KEY, (span){s, 6, 8}, "key 'ab' is given twice");
    diag_note(&f->sink, (span){s, 0, 2}, "first given here");
    diag_note(&f->sink, (span){option, 3, 4}, "and here");
    diag_note(&f->sink, (span){empty, 0, 0}, "a file without text");
    diag_note(&f->sink, SPAN_NONE, "a remark");
    expect_text(f, plain,
                "a.yaml:2:1: error: key 'ab' is given twice [E109]\n"
                "     2 | ab: 2\n"
                "       | ^~\n"
                "a.yaml:1:1: note: first given here\n"
                "     1 | ab: 1\n"
                "       | ^~\n"
                "--set:1:4: note: and here\n"
                "     1 | ab=3\n"
                "       |    ^\n"
                "empty.obj:1:1: note: a file without text\n"
                "       = note: a remark\n");
}

static void places_without_text_have_no_excerpt(void **state) {
    struct fixture *f = *state;
    diag_add(&f->sink, DIAG_DEFAULT_CAMERA, SPAN_NONE, "a camera was chosen");
    diag_add(&f->sink, DIAG_OPEN_DIELECTRIC, (span){77, 1, 2}, "of no source");
    expect_text(f, plain,
                "default:1:1: note: a camera was chosen [N401]\n"
                "default:1:1: warning: of no source [W401]\n");
    expect_text(f, (struct diag_text_options){0}, "default:1:1: warning: of no source [W401]\n");
}

static void underlines_end_with_their_line(void **state) {
    struct fixture *f = *state;
    uint32_t s = add_source(f, "ab [1,\n  2]\n\nend");
    diag_add(&f->sink, DIAG_WRONG_COUNT, (span){s, 3, 11}, "over lines");
    diag_add(&f->sink, DIAG_LIMIT, (span){s, 12, 12}, "an empty line");
    diag_add(&f->sink, DIAG_LIMIT, (span){s, 13, 999}, "past the end");
    diag_add(&f->sink, DIAG_LIMIT, (span){s, 999, 1000}, "at the end");
    expect_text(f, plain,
                "a.yaml:1:4: error: over lines [E210]\n"
                "     1 | ab [1,\n"
                "       |    ^~~\n"
                "a.yaml:3:1: error: an empty line [E501]\n"
                "     3 | \n"
                "       | ^\n"
                "a.yaml:4:1: error: past the end [E501]\n"
                "     4 | end\n"
                "       | ^~~\n"
                "a.yaml:4:4: error: at the end [E501]\n"
                "     4 | end\n"
                "       |    ^\n");
}

static void carets_stand_below_tabs_and_wide_characters(void **state) {
    struct fixture *f = *state;
    uint32_t s = add_source(f, "\ta\tbc\n漢字: x\ne\xCC\x81: x");
    diag_add(&f->sink, DIAG_LIMIT, (span){s, 1, 2}, "tab");
    diag_add(&f->sink, DIAG_LIMIT, (span){s, 1, 5}, "tab inside");
    diag_add(&f->sink, DIAG_LIMIT, (span){s, 6, 12}, "wide");
    diag_add(&f->sink, DIAG_LIMIT, (span){s, 14, 15}, "behind wide");
    diag_add(&f->sink, DIAG_LIMIT, (span){s, 21, 22}, "behind a combining accent");
    expect_text(f, plain,
                "a.yaml:1:2: error: tab [E501]\n"
                "     1 |         a       bc\n"
                "       |         ^\n"
                "a.yaml:1:2: error: tab inside [E501]\n"
                "     1 |         a       bc\n"
                "       |         ^~~~~~~~~~\n"
                "a.yaml:2:1: error: wide [E501]\n"
                "     2 | 漢字: x\n"
                "       | ^~~~\n"
                "a.yaml:2:5: error: behind wide [E501]\n"
                "     2 | 漢字: x\n"
                "       |       ^\n"
                "a.yaml:3:5: error: behind a combining accent [E501]\n"
                "     3 | e\xCC\x81: x\n"
                "       |    ^\n");
}

static void nothing_reaches_the_terminal_raw(void **state) {
    struct fixture *f = *state;
    uint32_t s = source_add(&f->sources, SOURCE_KIND_FILE, STR("a\033[2J\n.yaml"),
                            STR("a\033[31m\xFF\xC2\x9B\xE2\x80\xAE: b"));
    diag_add(&f->sink, DIAG_BAD_UTF8, (span){s, 6, 7}, "text\nwith\t\033 and \xFF");
    diag_note(&f->sink, SPAN_NONE, "\r");
    diag_help(&f->sink, "\x7F");
    expect_text(f, plain,
                "a?[2J?.yaml:1:7: error: text?with ? and ? [E103]\n"
                "     1 | a?[31m???: b\n"
                "       |       ^\n"
                "       = note: ?\n"
                "       = help: ?\n");
}

static void long_lines_are_cut_around_the_place(void **state) {
    struct fixture *f = *state;
    char line[1001];
    for (int i = 0; i < 1000; i++)
        line[i] = (char)('0' + i % 10);
    line[1000] = '\0';
    uint32_t s = add_source(f, line);
    diag_add(&f->sink, DIAG_LIMIT, (span){s, 500, 503}, "middle");
    diag_add(&f->sink, DIAG_LIMIT, (span){s, 600, 1000}, "long");
    diag_add(&f->sink, DIAG_LIMIT, (span){s, 999, 1000}, "end");
    diag_sort(&f->sink);
    char expected[3000];
    snprintf(expected, sizeof expected,
             "a.yaml:1:501: error: middle [E501]\n"
             "     1 | ...%.160s...\n"
             "       | %*s^~~\n"
             "a.yaml:1:601: error: long [E501]\n"
             "     1 | ...%.160s...\n"
             "       | %*s^%.79s\n"
             "a.yaml:1:1000: error: end [E501]\n"
             "     1 | ...%s\n"
             "       | %*s^\n",
             line + 420, 83, "", line + 520, 83, "",
             "~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~", line + 919,
             83, "");
    expect_text(f, plain, expected);
}

static void long_lines_are_cut_between_characters(void **state) {
    struct fixture *f = *state;
    char line[1501];
    for (size_t i = 0; i < 500; i++)
        memcpy(line + 3 * i, "漢", 3);
    line[1500] = '\0';
    uint32_t s = add_source(f, line);
    for (uint32_t at = 0; at < 500; at += 7)
        diag_add(&f->sink, DIAG_LIMIT, (span){s, 3 * at, 3 * at + 3}, "here");
    diag_text(&f->text, &f->sink, &f->sources, plain);
    str all = strbuf_view(&f->text);
    assert_int_equal(utf8_first_error(all), all.len);
    assert_null(strchr(all.ptr, '?'));
}

static void line_numbers_may_be_long(void **state) {
    struct fixture *f = *state;
    char *text = malloc(10000001);
    assert_non_null(text);
    memset(text, '\n', 10000000);
    memcpy(text + 9999999, "x", 2);
    uint32_t s = add_source(f, text);
    diag_add(&f->sink, DIAG_LIMIT, (span){s, 9999999, 10000000}, "far down");
    expect_text(f, plain,
                "a.yaml:10000000:1: error: far down [E501]\n"
                "10000000 | x\n"
                "         | ^\n");
    free(text);
}

static void colours(void **state) {
    struct fixture *f = *state;
    uint32_t s = add_source(f, "ab: 1\n");
    diag_add(&f->sink, DIAG_UNKNOWN_NAME, (span){s, 0, 2}, "m");
    expect_text(f, (struct diag_text_options){.color = true},
                "\033[1ma.yaml:1:1: \033[1;31merror: \033[0mm [E202]\n"
                "     1 | ab: 1\n"
                "       | \033[1;32m^~\033[0m\n");
}

static void caps_what_is_shown_but_not_the_first_error(void **state) {
    struct fixture *f = *state;
    static const diag_code warnings[] = {DIAG_OPEN_DIELECTRIC, DIAG_CAMERA_INSIDE, DIAG_LIGHT_INSIDE};
    for (uint32_t i = 0; i < 3; i++)
        diag_add(&f->sink, warnings[i], (span){0, i, i}, "warning %u", i);
    diag_add(&f->sink, DIAG_LIMIT, (span){0, 7, 7}, "why it failed");
    diag_add(&f->sink, DIAG_LIMIT, (span){0, 8, 8}, "another");
    diag_add(&f->sink, DIAG_DEFAULT_LIGHT, (span){0, 9, 9}, "a note");
    expect_text(f, (struct diag_text_options){.most = 2},
                "default:1:1: warning: warning 0 [W401]\n"
                "default:1:1: warning: warning 1 [W402]\n"
                "default:1:1: error: why it failed [E501]\n"
                "glint: 2 more messages not shown (W403: 1, E501: 1); --limit messages=101 shows all\n");
}

// Findings that are alike are cut short, more so in files that programs write; who names a number gets as
// many.
static void cuts_what_is_alike(void **state) {
    struct fixture *f = *state;
    for (uint32_t i = 0; i < 30; i++) {
        diag_add(&f->sink, DIAG_BAD_NUMBER, (span){0, i, i}, "m");
        diag_add(&f->sink, DIAG_MESH_INDEX, (span){0, i, i}, "m");
    }
    diag_sort(&f->sink);
    strbuf_clear(&f->text);
    diag_text(&f->text, &f->sink, &f->sources, (struct diag_text_options){.most = 100, .alike = 20});
    const char *closing =
        "glint: 38 more messages not shown (E205: 10, E612: 28); --limit messages=101 shows all\n";
    assert_non_null(strstr(strbuf_view(&f->text).ptr, closing));
    strbuf_clear(&f->text);
    diag_text(&f->text, &f->sink, &f->sources, (struct diag_text_options){.most = 101});
    assert_null(strstr(strbuf_view(&f->text).ptr, "glint: "));
}

// ---- shares of the room

static uint32_t shown_of(struct fixture *f, struct diag_share share, diag_code code, uint32_t source) {
    uint32_t shown = 0;
    for (uint32_t i = 0; i < f->sink.count; i++) {
        const struct diag *item = &f->sink.items[i];
        bool takes = diag_share_takes(&share, item, false);
        shown += takes && item->code == code && item->at.source == source;
    }
    return shown;
}

static void room_is_shared(void **state) {
    struct fixture *f = *state;
    for (uint32_t i = 0; i < 150; i++)
        diag_add(&f->sink, DIAG_BAD_NUMBER, (span){1, i, i}, "m");
    struct diag_share share = diag_share_begin(&f->sink, 100, 0, true);
    assert_int_equal(shown_of(f, share, DIAG_BAD_NUMBER, 1), 100);
    share = diag_share_begin(&f->sink, 150, 0, true);
    assert_int_equal(shown_of(f, share, DIAG_BAD_NUMBER, 1), 150);
    for (uint32_t i = 0; i < 60; i++)
        diag_add(&f->sink, DIAG_BAD_NUMBER, (span){2, i, i}, "m");
    for (uint32_t i = 0; i < 6; i++)
        diag_add(&f->sink, DIAG_MISSING, (span){2, i, i + 1}, "m");
    diag_sort(&f->sink);
    // What the six do not need goes to the others.
    share = diag_share_begin(&f->sink, 100, 0, true);
    assert_int_equal(shown_of(f, share, DIAG_BAD_NUMBER, 1), 47);
    assert_int_equal(shown_of(f, share, DIAG_BAD_NUMBER, 2), 47);
    assert_int_equal(shown_of(f, share, DIAG_MISSING, 2), 6);
}

static void notes_that_are_not_shown_take_no_room(void **state) {
    struct fixture *f = *state;
    for (uint32_t i = 0; i < 10; i++) {
        diag_add(&f->sink, DIAG_DEFAULT_LIGHT, (span){1, i, i}, "n");
        diag_add(&f->sink, DIAG_BAD_NUMBER, (span){1, i, i}, "m");
    }
    diag_sort(&f->sink);
    assert_int_equal(diag_share_begin(&f->sink, 10, 0, false).quota, UINT32_MAX);
    assert_int_equal(diag_share_begin(&f->sink, 10, 0, true).quota, 5);
}

static void more_is_kept_if_asked_for(void **state) {
    struct fixture *f = *state;
    diag_sink_keep(&f->sink, DIAG_KEPT_MAX + 5);
    for (uint32_t i = 0; i < DIAG_KEPT_MAX + 7; i++)
        diag_add(&f->sink, DIAG_LIMIT, (span){1, i, i}, "m");
    assert_int_equal(f->sink.count, DIAG_KEPT_MAX + 5);
    assert_int_equal(f->sink.dropped_of[DIAG_LIMIT], 2);
}

int main(void) {
#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        T(codes_are_well_formed_and_unique),
        T(finds_codes),
        T(collects_all_parts),
        T(parts_without_a_diagnostic_do_nothing),
        T(long_messages_are_cut_between_characters),
        T(the_first_diagnostic_may_find_no_memory),
        T(parts_of_a_dropped_one_are_dropped),
        T(a_full_sink_counts_on),
        T(sorts_by_source_and_place_stably),
        T(drops_exact_repeats_only),
        T(sorts_all_it_keeps_at_one_place),
        T(merges_copies),
        T(merging_into_a_full_sink_keeps_the_counts),
        T(writes_a_caret),
        T(writes_notes_with_and_without_places),
        T(places_without_text_have_no_excerpt),
        T(underlines_end_with_their_line),
        T(carets_stand_below_tabs_and_wide_characters),
        T(nothing_reaches_the_terminal_raw),
        T(long_lines_are_cut_around_the_place),
        T(long_lines_are_cut_between_characters),
        T(line_numbers_may_be_long),
        T(colours),
        T(caps_what_is_shown_but_not_the_first_error),
        T(cuts_what_is_alike),
        T(room_is_shared),
        T(notes_that_are_not_shown_take_no_room),
        T(more_is_kept_if_asked_for),
    };
    return cmocka_run_group_tests_name("diag", tests, NULL, NULL);
}
