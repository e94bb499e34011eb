#include "core/text_diff.h"
#include "core/text_edit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void check_edits(const char *text, struct text_edit *edits, uint32_t count, const char *expected) {
    struct strbuf out;
    strbuf_init(&out);
    uint32_t kept = text_edits_settle(edits, count);
    text_edits_apply(str_from(text), edits, kept, &out);
    assert_string_equal(out.data, expected);
    strbuf_finish(&out);
}

static void test_edits(void **state) {
    (void)state;
    struct text_edit two[] = {{4, 5, STR("Y"), 0}, {0, 2, STR(""), 1}};
    check_edits("abcdef", two, 2, "cdYf");
    struct text_edit insert[] = {{3, 3, STR("-"), 0}, {6, 6, STR("!"), 1}, {0, 0, STR(">"), 2}};
    check_edits("abcdef", insert, 3, ">abc-def!");
}

static void test_edits_that_collide(void **state) {
    (void)state;
    struct text_edit repeat[] = {{1, 3, STR("X"), 0}, {1, 3, STR("X"), 1}};
    check_edits("abcdef", repeat, 2, "aXdef");
    struct text_edit overlap[] = {{2, 4, STR("late"), 7}, {1, 3, STR("early"), 3}, {3, 5, STR("Z"), 9}};
    check_edits("abcdef", overlap, 3, "aearlyZf");
    struct text_edit inside[] = {{0, 6, STR("all"), 2}, {2, 2, STR("in"), 1}};
    check_edits("abcdef", inside, 2, "abincdef");
    struct text_edit behind[] = {{3, 3, STR("-"), 1}, {1, 3, STR("X"), 0}};
    check_edits("abcdef", behind, 2, "aXdef");
}

static void check_diff(const char *a, const char *b, const char *expected) {
    struct strbuf out;
    strbuf_init(&out);
    text_diff(STR("a"), str_from(a), STR("b"), str_from(b), &out);
    assert_false(out.failed);
    assert_string_equal(out.data ? out.data : "", expected);
    strbuf_finish(&out);
}

static void test_diff(void **state) {
    (void)state;
    check_diff("same\n", "same\n", "");
    check_diff("", "new\n", "--- a\n+++ b\n@@ -0,0 +1 @@\n+new\n");
    check_diff("old\n", "", "--- a\n+++ b\n@@ -1 +0,0 @@\n-old\n");
    check_diff("1\n2\n3\n4\n5\n6\n7\n8\n", "1\n2\n3\n4\nV\n6\n7\n8\n",
               "--- a\n+++ b\n@@ -2,7 +2,7 @@\n 2\n 3\n 4\n-5\n+V\n 6\n 7\n 8\n");
    check_diff("1\n2", "1\n2\n", "--- a\n+++ b\n@@ -1,2 +1,2 @@\n 1\n-2\n\\ No newline at end of file\n+2\n");
    check_diff("a\nb\nc\na\nb\nb\na\n", "c\nb\na\nb\na\nc\n",
               "--- a\n+++ b\n@@ -1,7 +1,6 @@\n-a\n-b\n c\n+b\n a\n b\n-b\n a\n+c\n");
}

static void test_diff_of_far_hunks(void **state) {
    (void)state;
    check_diff("a\n1\n2\n3\n4\n5\n6\n7\nb\n", "A\n1\n2\n3\n4\n5\n6\n7\nB\n",
               "--- a\n+++ b\n@@ -1,4 +1,4 @@\n-a\n+A\n 1\n 2\n 3\n@@ -6,4 +6,4 @@\n 5\n 6\n 7\n-b\n+B\n");
    check_diff("a\n1\n2\n3\n4\n5\n6\nb\n", "A\n1\n2\n3\n4\n5\n6\nB\n",
               "--- a\n+++ b\n@@ -1,8 +1,8 @@\n-a\n+A\n 1\n 2\n 3\n 4\n 5\n 6\n-b\n+B\n");
}

// What a patch says of random texts gives the one from the other.
static void apply(const char *patch, const char *from, struct strbuf *to) {
    const char *at = from, *line = strstr(patch, "@@");
    while (line && *line) {
        const char *end = strchr(line, '\n') + 1;
        if (line[0] == '@') {
            long begin = strtol(line + 4, NULL, 10);
            const char *stop = from;
            bool none = strstr(line, ",0 +") && strstr(line, ",0 +") < end;
            for (long i = none ? 0 : 1; i < begin; i++)
                stop = strchr(stop, '\n') + 1;
            strbuf_add(to, at, (size_t)(stop - at));
            at = stop;
        } else {
            if (line[0] != '-')
                strbuf_add(to, line + 1, (size_t)(end - line - 1));
            if (line[0] != '+') {
                assert_memory_equal(at, line + 1, (size_t)(end - line - 1));
                at += end - line - 1;
            }
        }
        line = end;
    }
    strbuf_cstr(to, at);
}

static void test_diff_of_random_texts(void **state) {
    (void)state;
    srand(7);
    for (int round = 0; round < 500; round++) {
        char a[256] = "", b[256] = "";
        for (int i = rand() % 40; i > 0; i--) {
            char line[3] = {(char)('a' + rand() % 4), '\n', '\0'};
            int what = rand() % 4;
            if (what != 0)
                memcpy(a + strlen(a), line, 3);
            if (what != 1)
                memcpy(b + strlen(b), line, 3);
        }
        struct strbuf patch, made;
        strbuf_init(&patch), strbuf_init(&made);
        text_diff(STR("a"), str_from(a), STR("b"), str_from(b), &patch);
        apply(patch.data ? patch.data : "", a, &made);
        assert_string_equal(made.data ? made.data : "", b);
        strbuf_finish(&patch), strbuf_finish(&made);
    }
}

static void test_diff_of_large_texts(void **state) {
    (void)state;
    struct strbuf a, b, out;
    strbuf_init(&a), strbuf_init(&b), strbuf_init(&out);
    for (int i = 0; i < 3 * TEXT_DIFF_MOST; i++) {
        strbuf_format(&a, "a %d\n", i);
        strbuf_format(&b, "b %d\n", i);
    }
    text_diff(STR("a"), strbuf_view(&a), STR("b"), strbuf_view(&b), &out);
    assert_false(out.failed);
    assert_non_null(strstr(out.data, "@@ -1,12000 +1,12000 @@\n-a 0\n"));
    strbuf_finish(&a), strbuf_finish(&b), strbuf_finish(&out);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_edits),
        cmocka_unit_test(test_edits_that_collide),
        cmocka_unit_test(test_diff),
        cmocka_unit_test(test_diff_of_far_hunks),
        cmocka_unit_test(test_diff_of_random_texts),
        cmocka_unit_test(test_diff_of_large_texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
