#include "core/str_map.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum {
    PLENTY_BYTES = 64 * 1024 * 1024,
    MANY = 5000
};

static void keys_are_found_again(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, PLENTY_BYTES);
    struct str_map map;
    str_map_init(&map, &arena);
    assert_int_equal(str_map_find(&map, STR("nothing")), 0);
    static char texts[MANY][8];
    for (int round = 0; round < 3; round++) {
        for (uint32_t i = 0; i < MANY; i++) {
            snprintf(texts[i], sizeof texts[i], "n%u", i);
            assert_int_equal(*str_map_at(&map, str_from(texts[i])), 0);
            *str_map_at(&map, str_from(texts[i])) = i + 1;
        }
        for (uint32_t i = 0; i < MANY; i++)
            assert_int_equal(str_map_find(&map, str_from(texts[i])), i + 1);
        str_map_clear(&map);
        assert_int_equal(str_map_find(&map, STR("n5")), 0);
    }
    arena_finish(&arena);
}

// Without a NUL behind them, and one within: keys are their bytes.
static void keys_are_bytes(void **state) {
    (void)state;
    struct arena arena;
    struct str_map map;
    arena_init(&arena, PLENTY_BYTES);
    str_map_init(&map, &arena);
    *str_map_at(&map, (str){"a\0b", 3}) = 1;
    *str_map_at(&map, (str){"ab", 1}) = 2;
    *str_map_at(&map, STR("")) = 3;
    assert_int_equal(map.count, 3);
    assert_int_equal(str_map_find(&map, (str){"a\0b", 3}), 1);
    assert_int_equal(str_map_find(&map, STR("a")), 2);
    assert_int_equal(str_map_find(&map, (str){NULL, 0}), 3);
    assert_int_equal(str_map_find(&map, STR("ab")), 0);
    arena_finish(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_are_found_again),
        cmocka_unit_test(keys_are_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
