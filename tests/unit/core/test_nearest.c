#include "core/nearest.h"

#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static unsigned distance(const char *a, const char *b) {
    assert_int_equal(nearest_distance(str_from(a), str_from(b)), nearest_distance(str_from(b), str_from(a)));
    return nearest_distance(str_from(a), str_from(b));
}

static void distances(void **state) {
    (void)state;
    assert_int_equal(distance("", ""), 0);
    assert_int_equal(distance("", "abc"), 3);
    assert_int_equal(distance("abc", "abc"), 0);
    assert_int_equal(distance("abc", "abd"), 1);
    assert_int_equal(distance("abc", "ab"), 1);
    assert_int_equal(distance("abc", "xabc"), 1);
    assert_int_equal(distance("kitten", "sitting"), 3);
    assert_int_equal(distance("ab", "ba"), 1);
    assert_int_equal(distance("postiion", "position"), 1);
    // Restricted: a transposed pair is not edited again.
    assert_int_equal(distance("ca", "abc"), 3);
    assert_int_equal(distance("Width", "width"), 0);
    assert_int_equal(distance("look-at", "look_at"), 0);
    assert_int_equal(distance("look at", "look_at"), 0);
    assert_int_equal((nearest_distance((str){0}, STR("a"))), 1);
}

static void long_words_are_far_apart(void **state) {
    (void)state;
    char text[129];
    memset(text, 'a', sizeof text);
    str most = {text, 128};
    str more = {text, 129};
    assert_int_equal(nearest_distance(most, most), 0);
    assert_int_equal(nearest_distance(most, more), UINT_MAX);
    assert_int_equal(nearest_distance(more, STR("a")), UINT_MAX);
}

static const char *choose(const char *word, const char *const *candidates) {
    static char found[64];
    struct nearest search = nearest_begin(str_from(word));
    for (; *candidates; candidates++)
        nearest_offer(&search, str_from(*candidates));
    str best = nearest_best(&search);
    memcpy(found, best.ptr ? best.ptr : "", best.len);
    found[best.len] = '\0';
    return found;
}

static void chooses_what_was_meant(void **state) {
    (void)state;
    const char *const keys[] = {"position", "rotation", "translation", "radius", "name", "up", "fov", NULL};
    assert_string_equal(choose("postion", keys), "position");
    assert_string_equal(choose("Radius", keys), "radius");
    assert_string_equal(choose("rotate", keys), "rotation");
    assert_string_equal(choose("rotatoin", keys), "rotation");
    assert_string_equal(choose("names", keys), "name");
    assert_string_equal(choose("fvo", keys), "fov");
    assert_string_equal(choose("UP", keys), "up");
    // Two letters are too few to guess from.
    assert_string_equal(choose("op", keys), "");
    assert_string_equal(choose("sky", keys), "");
    assert_string_equal(choose("", keys), "");
    const char *const none[] = {NULL};
    assert_string_equal(choose("position", none), "");
}

static void the_first_of_equals_wins(void **state) {
    (void)state;
    const char *const keys[] = {"glass_a", "glass_b", NULL};
    assert_string_equal(choose("glass_c", keys), "glass_a");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances),
        cmocka_unit_test(long_words_are_far_apart),
        cmocka_unit_test(chooses_what_was_meant),
        cmocka_unit_test(the_first_of_equals_wins),
    };
    return cmocka_run_group_tests_name("nearest", tests, NULL, NULL);
}
