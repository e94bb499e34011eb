#include "files/glob.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static bool matches(const char *pattern, const char *path) {
    return glob_match(str_from(pattern), str_from(path));
}

static void names_match_at_any_depth(void **state) {
    (void)state;
    assert_true(matches("a.yaml", "a.yaml"));
    assert_true(matches("a.yaml", "x/y/a.yaml"));
    assert_true(matches("*.yaml", "x/a.yaml"));
    assert_true(matches("drafts", "drafts/a.yaml"));
    assert_true(matches("drafts/", "x/drafts/a.yaml"));
    assert_true(matches("a?c", "x/abc"));
    assert_false(matches("a.yaml", "ba.yaml"));
    assert_false(matches("a.yaml", "a.yamlx"));
    assert_false(matches("a?c", "a/c"));
    assert_false(matches("draft", "drafts/a.yaml"));
}

static void a_slash_ties_to_the_folder(void **state) {
    (void)state;
    assert_true(matches("/a.yaml", "a.yaml"));
    assert_true(matches("x/a.yaml", "x/a.yaml"));
    assert_true(matches("x/*", "x/y/a.yaml")); // the folder x/y
    assert_true(matches("x/*/z", "x/y/z"));
    assert_false(matches("/a.yaml", "x/a.yaml"));
    assert_false(matches("x/a.yaml", "w/x/a.yaml"));
    assert_false(matches("x/*.yaml", "x/y/a.yaml"));
}

static void double_stars_cross_folders(void **state) {
    (void)state;
    assert_true(matches("x/**", "x/a"));
    assert_true(matches("x/**", "x/y/z/a"));
    assert_true(matches("**/a", "a"));
    assert_true(matches("**/a", "x/y/a"));
    assert_true(matches("x/**/a", "x/a"));
    assert_true(matches("x/**/a", "x/y/z/a"));
    assert_true(matches("x**z", "xy/yz"));
    assert_false(matches("x/**", "x"));
    assert_false(matches("**/a", "x/ba"));
    assert_false(matches("x/**/a", "xa"));
    assert_false(matches("x/**/a", "x/ya"));
}

static void odd_patterns(void **state) {
    (void)state;
    assert_false(matches("", "a"));
    assert_false(matches("/", "a"));
    assert_false(matches("a", ""));
    assert_true(matches("*", "a"));
    assert_true(matches("**", "x/a"));
    assert_true(matches("***", "x/a"));
    char pattern[2001];
    memset(pattern, 'a', 2000);
    pattern[2000] = '\0';
    assert_false(matches(pattern, pattern));
}

// A pattern that a search by trial and error would not end with.
static void many_stars_are_quick(void **state) {
    (void)state;
    char pattern[801];
    char path[4001];
    for (int i = 0; i < 200; i++)
        memcpy(pattern + 4 * i, "**a*", 4);
    pattern[799] = 'b';
    pattern[800] = '\0';
    memset(path, 'a', 4000);
    path[4000] = '\0';
    assert_false(matches(pattern, path));
    path[3999] = 'b';
    assert_true(matches(pattern, path));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_match_at_any_depth),   cmocka_unit_test(a_slash_ties_to_the_folder),
        cmocka_unit_test(double_stars_cross_folders), cmocka_unit_test(odd_patterns),
        cmocka_unit_test(many_stars_are_quick),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
