#include "core/arena.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct numbers {
    int *items;
    uint32_t count;
    uint32_t capacity;
};

static void memory_is_zeroed_aligned_and_apart(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, SIZE_MAX);
    unsigned char *all[400];
    for (size_t i = 0; i < 400; i++) {
        size_t size = i * 7 % 300;
        all[i] = arena_alloc(&arena, size);
        assert_non_null(all[i]);
        assert_int_equal((uintptr_t)all[i] % 16, 0);
        for (size_t b = 0; b < size; b++)
            assert_int_equal(all[i][b], 0);
        memset(all[i], (int)i, size);
    }
    for (size_t i = 0; i < 400; i++)
        for (size_t b = 0; b < i * 7 % 300; b++)
            assert_int_equal(all[i][b], i & 0xFF);
    arena_finish(&arena);
}

static void size_zero_gives_a_pointer_of_its_own(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, SIZE_MAX);
    void *a = arena_alloc(&arena, 0);
    void *b = arena_alloc(&arena, 0);
    assert_non_null(a);
    assert_ptr_not_equal(a, b);
    arena_finish(&arena);
}

static void large_and_small_in_turns(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, SIZE_MAX);
    char *small[50];
    for (int i = 0; i < 50; i++) {
        small[i] = arena_alloc(&arena, 16);
        memset(small[i], i, 16);
        memset(arena_alloc(&arena, 70000), 0xFF, 70000);
    }
    for (int i = 0; i < 50; i++)
        assert_int_equal(small[i][15], i);
#ifndef GLINT_ARENA_EXACT
    // What is left of a block is used on, whatever large ones come between.
    for (int i = 1; i < 50; i++)
        assert_ptr_equal(small[i], small[i - 1] + 16);
#endif
    arena_finish(&arena);
}

static void cap_is_kept_and_jumps_to_the_guard(void **state) {
    (void)state;
    struct arena arena;
    struct arena_guard guard;
    arena_init(&arena, 1000);
    arena_set_guard(&arena, &guard);
    volatile int got = 0;
    if (setjmp(guard.jump) == 0) {
        for (;;) {
            arena_alloc(&arena, 96);
            got++;
        }
    }
    assert_int_equal(guard.fault, ARENA_FAULT_CAP);
    assert_int_equal(got, 10);
    assert_true(arena.used_bytes <= 1000);
    // The arena still works for what fits.
    assert_non_null(arena_try_alloc(&arena, 16));
    assert_null(arena_try_alloc(&arena, 96));
    arena_finish(&arena);
    assert_int_equal(arena.used_bytes, 0);
    assert_ptr_equal(arena.guard, &guard);
    assert_non_null(arena_try_alloc(&arena, 96));
    arena_finish(&arena);
}

static void setting_a_guard_clears_its_fault(void **state) {
    (void)state;
    struct arena arena;
    struct arena_guard guard;
    memset(&guard, 0xFF, sizeof guard);
    arena_init(&arena, 1000);
    arena_set_guard(&arena, &guard);
    assert_int_equal(guard.fault, ARENA_FAULT_NONE);
    arena_set_guard(&arena, NULL);
    assert_null(arena.guard);
}

static enum arena_fault fault_of(size_t cap, size_t count, size_t size) {
    struct arena arena;
    struct arena_guard guard;
    arena_init(&arena, cap);
    arena_set_guard(&arena, &guard);
    if (setjmp(guard.jump) == 0)
        arena_alloc_array(&arena, count, size);
    arena_finish(&arena);
    return guard.fault;
}

static void sizes_that_overflow_fault(void **state) {
    (void)state;
    assert_int_equal(fault_of(SIZE_MAX, SIZE_MAX, 1), ARENA_FAULT_SYSTEM);
    assert_int_equal(fault_of(SIZE_MAX, SIZE_MAX - 7, 1), ARENA_FAULT_SYSTEM);
    assert_int_equal(fault_of(SIZE_MAX, SIZE_MAX / 2 + 1, 2), ARENA_FAULT_SYSTEM);
    assert_int_equal(fault_of(SIZE_MAX, (size_t)1 << 40, (size_t)1 << 40), ARENA_FAULT_SYSTEM);
    assert_int_equal(fault_of(1 << 20, SIZE_MAX / 2 + 1, 2), ARENA_FAULT_CAP);
    assert_int_equal(fault_of(1 << 20, SIZE_MAX, 0), ARENA_FAULT_NONE);
    assert_int_equal(fault_of(1 << 20, 0, SIZE_MAX), ARENA_FAULT_NONE);
}

static void copies_and_formats_end_with_nul(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, SIZE_MAX);
    str copy = arena_copy(&arena, (str){"abcdef", 3});
    assert_int_equal(copy.len, 3);
    assert_string_equal(copy.ptr, "abc");
    str empty = arena_copy(&arena, (str){0});
    assert_int_equal(empty.len, 0);
    assert_string_equal(empty.ptr, "");
    str text = arena_format(&arena, "%s-%05d|%*s", "x", 42, 3000, "");
    assert_int_equal(text.len, 3008);
    assert_memory_equal(text.ptr, "x-00042|", 8);
    assert_int_equal(strlen(text.ptr), text.len);
    arena_finish(&arena);
}

static void format_jumps_at_the_cap(void **state) {
    (void)state;
    struct arena arena;
    struct arena_guard guard;
    arena_init(&arena, 64);
    arena_set_guard(&arena, &guard);
    if (setjmp(guard.jump) == 0) {
        arena_format(&arena, "%100s", "");
        fail();
    }
    assert_int_equal(guard.fault, ARENA_FAULT_CAP);
    arena_finish(&arena);
}

static void lists_grow_and_keep_their_items(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, SIZE_MAX);
    struct numbers list = {0};
    for (int i = 0; i < 5000; i++) {
        int *item = ARENA_PUSH(&arena, &list);
        assert_int_equal(*item, 0);
        *item = i;
    }
    assert_int_equal(list.count, 5000);
    for (int i = 0; i < 5000; i++)
        assert_int_equal(list.items[i], i);
    arena_finish(&arena);
}

static void a_full_list_faults_instead_of_wrapping(void **state) {
    (void)state;
    struct arena arena;
    struct arena_guard guard;
    arena_init(&arena, SIZE_MAX);
    arena_set_guard(&arena, &guard);
    uint32_t capacity = UINT32_MAX;
    if (setjmp(guard.jump) == 0) {
        arena_grow(&arena, NULL, UINT32_MAX, &capacity, 1);
        fail();
    }
    assert_int_equal(guard.fault, ARENA_FAULT_SYSTEM);
    assert_int_equal(capacity, UINT32_MAX);
    arena_finish(&arena);
}

static void a_fault_is_passed_on(void **state) {
    (void)state;
    struct arena arena;
    struct arena_guard outer;
    struct arena_guard inner;
    arena_init(&arena, 10);
    arena_set_guard(&arena, &outer);
    if (setjmp(outer.jump) == 0) {
        arena_set_guard(&arena, &inner);
        if (setjmp(inner.jump) == 0)
            arena_alloc(&arena, 100);
        arena_set_guard(&arena, &outer);
        arena_raise(&arena, inner.fault);
    }
    assert_int_equal(outer.fault, ARENA_FAULT_CAP);
    arena_finish(&arena);
}

static void finish_takes_null_and_twice(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, 100);
    arena_finish(NULL);
    arena_finish(&arena);
    arena_finish(&arena);
    assert_int_equal(arena.cap_bytes, 100);
}

// Larger than a shared block by far: the array moves by itself, others stay.
static void arrays_regrow_and_are_given_back(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, (size_t)1 << 30);
    uint64_t *items = NULL;
    uint32_t capacity = 0;
    char *before = arena_alloc(&arena, 100), *between = NULL;
    memset(before, 'b', 100);
    for (uint32_t i = 0; i < 200000; i++) {
        items = arena_regrow(&arena, items, i, &capacity, sizeof *items);
        items[i] = i;
        if (i == 100000)
            between = arena_alloc(&arena, 100000);
    }
    for (uint32_t i = 0; i < 200000; i++)
        assert_int_equal(items[i], i);
    assert_int_equal(before[99], 'b');
    for (uint32_t i = 0; i < 100000; i++)
        assert_int_equal(between[i], 0);
    size_t used = arena.used_bytes;
    assert_true(used >= 200000 * sizeof *items && used < 4 * 200000 * sizeof *items);
    arena_give_back(&arena, items, capacity, sizeof *items);
    assert_true(arena.used_bytes <= used - capacity * sizeof *items);
    arena_give_back(&arena, NULL, 0, 8);
    assert_int_equal(*(char *)arena_alloc(&arena, 1000), 0);
    arena_finish(&arena);
}

static void regrowing_keeps_to_the_cap(void **state) {
    (void)state;
    struct arena arena;
    struct arena_guard guard;
    arena_init(&arena, 1 << 20);
    arena_set_guard(&arena, &guard);
    struct {
        uint64_t *items;
        uint32_t count, capacity;
    } volatile list = {0};
    if (setjmp(guard.jump) == 0)
        for (;;) {
            uint32_t capacity = list.capacity;
            list.items = arena_regrow(&arena, list.items, list.count, &capacity, sizeof *list.items);
            list.capacity = capacity;
            list.items[list.count++] = 1;
        }
    assert_int_equal(guard.fault, ARENA_FAULT_CAP);
    assert_true(arena.used_bytes <= arena.cap_bytes);
    assert_int_equal(list.items[list.count - 1], 1);
    arena_finish(&arena);
}

static void reset_gives_zeroed_memory_again(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, 1 << 20);
    arena_reset(&arena);
    for (int round = 0; round < 3; round++) {
        for (int i = 0; i < 20; i++) {
            char *memory = arena_alloc(&arena, 5000);
            for (int k = 0; k < 5000; k++)
                assert_int_equal(memory[k], 0);
            memset(memory, 'x', 5000);
        }
        arena_reset(&arena);
        assert_int_equal(arena.used_bytes, 0);
    }
    arena_finish(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_zeroed_aligned_and_apart),
        cmocka_unit_test(size_zero_gives_a_pointer_of_its_own),
        cmocka_unit_test(large_and_small_in_turns),
        cmocka_unit_test(cap_is_kept_and_jumps_to_the_guard),
        cmocka_unit_test(setting_a_guard_clears_its_fault),
        cmocka_unit_test(sizes_that_overflow_fault),
        cmocka_unit_test(copies_and_formats_end_with_nul),
        cmocka_unit_test(format_jumps_at_the_cap),
        cmocka_unit_test(lists_grow_and_keep_their_items),
        cmocka_unit_test(a_full_list_faults_instead_of_wrapping),
        cmocka_unit_test(a_fault_is_passed_on),
        cmocka_unit_test(finish_takes_null_and_twice),
        cmocka_unit_test(arrays_regrow_and_are_given_back),
        cmocka_unit_test(regrowing_keeps_to_the_cap),
        cmocka_unit_test(reset_gives_zeroed_memory_again),
    };
    return cmocka_run_group_tests_name("arena", tests, NULL, NULL);
}
