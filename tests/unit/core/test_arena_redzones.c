// The arena of the fuzz build: what lies behind each allocation is poisoned, and nothing else is.
#include "core/arena.h"

#include <sanitizer/asan_interface.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void check_edges(char *memory, size_t size) {
    assert_null(__asan_region_is_poisoned(memory, size));
    for (size_t i = size; i < size + 16; i++)
        assert_true(__asan_address_is_poisoned(memory + i));
}

static void overruns_are_seen(void **state) {
    (void)state;
    struct arena arena;
    char *all[300];
    arena_init(&arena, SIZE_MAX);
    for (size_t i = 0; i < 300; i++)
        all[i] = arena_alloc(&arena, i * 37 % 3000);
    for (size_t i = 0; i < 300; i++)
        check_edges(all[i], i * 37 % 3000);
    arena_finish(&arena);
}

static void what_a_reset_freed_is_poisoned_and_zeroed_when_used_again(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, SIZE_MAX);
    char *before = arena_alloc(&arena, 200);
    memset(before, 1, 200);
    arena_reset(&arena);
    assert_true(__asan_address_is_poisoned(before));
    char *again = arena_alloc(&arena, 100);
    assert_ptr_equal(again, before);
    check_edges(again, 100);
    for (int i = 0; i < 100; i++)
        assert_int_equal(again[i], 0);
    arena_finish(&arena);
}

static void an_array_that_moved_has_its_edge_again(void **state) {
    (void)state;
    struct arena arena;
    int *items = NULL;
    uint32_t capacity = 0;
    arena_init(&arena, SIZE_MAX);
    for (uint32_t i = 0; i < 50000; i++) {
        uint32_t had = capacity;
        items = arena_regrow(&arena, items, i, &capacity, sizeof *items);
        items[i] = (int)i;
        if (capacity != had)
            check_edges((char *)items, capacity * sizeof *items);
    }
    for (uint32_t i = 0; i < 50000; i++)
        assert_int_equal(items[i], i);
    arena_give_back(&arena, items, capacity, sizeof *items);
    assert_true(__asan_address_is_poisoned(items));
    arena_finish(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(overruns_are_seen),
        cmocka_unit_test(what_a_reset_freed_is_poisoned_and_zeroed_when_used_again),
        cmocka_unit_test(an_array_that_moved_has_its_edge_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
