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

struct job {
    struct arena *arena;
    size_t count, size;
    int done;
};

static void take(void *context) {
    struct job *job = context;
    arena_alloc_array(job->arena, job->count, job->size);
    job->done++;
}

static void take_all(void *context) {
    for (;;)
        take(context);
}

static void cap_is_kept_and_ends_the_work(void **state) {
    (void)state;
    struct arena arena;
    struct job job = {&arena, 1, 96, 0};
    arena_init(&arena, 1000);
    assert_int_equal(arena_guarded(&arena, take_all, &job), ARENA_FAULT_CAP);
    assert_int_equal(job.done, 10);
    assert_true(arena.used_bytes <= 1000);
    // The arena still works for what fits.
    assert_non_null(arena_try_alloc(&arena, 16));
    assert_null(arena_try_alloc(&arena, 96));
    arena_finish(&arena);
    assert_int_equal(arena.used_bytes, 0);
    assert_non_null(arena_try_alloc(&arena, 96));
    arena_finish(&arena);
}

static void work_that_ends_has_no_fault(void **state) {
    (void)state;
    struct arena arena;
    struct job job = {&arena, 1, 96, 0};
    arena_init(&arena, 1000);
    assert_int_equal(arena_guarded(&arena, take, &job), ARENA_FAULT_NONE);
    assert_int_equal(job.done, 1);
    assert_null(arena.guard);
    arena_finish(&arena);
}

static enum arena_fault fault_of(size_t cap, size_t count, size_t size) {
    struct arena arena;
    struct job job = {&arena, count, size, 0};
    arena_init(&arena, cap);
    enum arena_fault fault = arena_guarded(&arena, take, &job);
    assert_int_equal(job.done, fault == ARENA_FAULT_NONE);
    arena_finish(&arena);
    return fault;
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

static void format_too_much(void *context) {
    arena_format(context, "%100s", "");
}

static void format_jumps_at_the_cap(void **state) {
    (void)state;
    struct arena arena;
    arena_init(&arena, 64);
    assert_int_equal(arena_guarded(&arena, format_too_much, &arena), ARENA_FAULT_CAP);
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

struct full_list {
    struct arena arena;
    uint32_t capacity;
};

static void grow_full(void *context) {
    struct full_list *list = context;
    arena_grow(&list->arena, NULL, UINT32_MAX, &list->capacity, 1);
}

static void a_full_list_faults_instead_of_wrapping(void **state) {
    (void)state;
    struct full_list list = {.capacity = UINT32_MAX};
    arena_init(&list.arena, SIZE_MAX);
    assert_int_equal(arena_guarded(&list.arena, grow_full, &list), ARENA_FAULT_SYSTEM);
    assert_int_equal(list.capacity, UINT32_MAX);
    arena_finish(&list.arena);
}

// ---- several guards, several arenas

struct nest {
    struct arena arenas[2];
    enum arena_fault inner;
    bool raises, returned;
};

static void take_second(void *context) {
    struct nest *nest = context;
    arena_alloc(&nest->arenas[1], 100);
}

static void take_first(void *context) {
    struct nest *nest = context;
    arena_alloc(&nest->arenas[0], 100);
}

static void guard_within(void *context) {
    struct nest *nest = context;
    nest->inner = arena_guarded(&nest->arenas[0], take_first, nest);
    if (nest->raises)
        arena_raise(&nest->arenas[0], nest->inner);
    nest->returned = true;
}

static struct nest nest_of(size_t first, size_t second) {
    struct nest nest = {.raises = false};
    arena_init(&nest.arenas[0], first);
    arena_init(&nest.arenas[1], second);
    return nest;
}

static void end(struct nest *nest) {
    for (int i = 0; i < 2; i++) {
        assert_null(nest->arenas[i].guard);
        arena_finish(&nest->arenas[i]);
    }
}

static void a_fault_ends_the_innermost_work(void **state) {
    (void)state;
    struct nest nest = nest_of(10, 10);
    assert_int_equal(arena_guarded(&nest.arenas[0], guard_within, &nest), ARENA_FAULT_NONE);
    assert_int_equal(nest.inner, ARENA_FAULT_CAP);
    assert_true(nest.returned);
    end(&nest);
}

static void a_fault_is_passed_on(void **state) {
    (void)state;
    struct nest nest = nest_of(10, 10);
    nest.raises = true;
    assert_int_equal(arena_guarded(&nest.arenas[0], guard_within, &nest), ARENA_FAULT_CAP);
    assert_int_equal(nest.inner, ARENA_FAULT_CAP);
    assert_false(nest.returned);
    end(&nest);
}

static void guard_then_take(void *context) {
    guard_within(context);
    take_first(context);
}

// The guard of before is in force again, after a work that ended by itself and after one that did not.
static void the_guard_of_before_is_put_back(void **state) {
    (void)state;
    for (size_t room = 10; room <= 110; room += 100) {
        struct nest nest = nest_of(room, 10);
        assert_int_equal(arena_guarded(&nest.arenas[0], guard_then_take, &nest), ARENA_FAULT_CAP);
        assert_int_equal(nest.inner, room < 100 ? ARENA_FAULT_CAP : ARENA_FAULT_NONE);
        end(&nest);
    }
}

static void each_of_several_arenas_ends_the_work(void **state) {
    (void)state;
    struct nest nest = nest_of(10, SIZE_MAX);
    struct arena *arenas[] = {&nest.arenas[0], &nest.arenas[1], NULL};
    struct job too_large = {&nest.arenas[1], SIZE_MAX, 1, 0};
    assert_int_equal(arena_guarded_all(arenas, take_first, &nest), ARENA_FAULT_CAP);
    assert_int_equal(arena_guarded_all(arenas, take, &too_large), ARENA_FAULT_SYSTEM);
    assert_int_equal(arena_guarded_all(arenas, take_second, &nest), ARENA_FAULT_NONE);
    end(&nest);
}

// One of them is guarded further out already, and listed twice.
static void guard_all_within(void *context) {
    struct nest *nest = context;
    struct arena *arenas[] = {&nest->arenas[0], &nest->arenas[1], &nest->arenas[0], NULL};
    nest->inner = arena_guarded_all(arenas, take_second, nest);
    assert_null(nest->arenas[1].guard);
    take_first(nest);
}

static void each_arena_has_its_own_guard_of_before(void **state) {
    (void)state;
    struct nest nest = nest_of(10, 20);
    assert_int_equal(arena_guarded(&nest.arenas[0], guard_all_within, &nest), ARENA_FAULT_CAP);
    assert_int_equal(nest.inner, ARENA_FAULT_CAP);
    end(&nest);
}

struct keeper {
    struct arena arena;
    char *small, *large;
};

static void take_until_full(void *context) {
    struct keeper *keeper = context;
    keeper->small = arena_alloc(&keeper->arena, 100);
    keeper->large = arena_alloc(&keeper->arena, 500000);
    memset(keeper->small, 's', 100);
    memset(keeper->large, 'l', 500000);
    arena_alloc(&keeper->arena, 600000);
}

// The sanitizer sees what would not be given back.
static void memory_stays_until_the_arena_is_finished(void **state) {
    (void)state;
    struct keeper keeper = {.small = NULL};
    arena_init(&keeper.arena, 1 << 20);
    assert_int_equal(arena_guarded(&keeper.arena, take_until_full, &keeper), ARENA_FAULT_CAP);
    assert_true(keeper.small[99] == 's' && keeper.large[499999] == 'l');
    assert_true(keeper.arena.used_bytes >= 500100);
    arena_finish(&keeper.arena);
    assert_int_equal(keeper.arena.used_bytes, 0);
    assert_int_equal(arena_guarded(&keeper.arena, take_until_full, &keeper), ARENA_FAULT_CAP);
    arena_finish(&keeper.arena);
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

// A large array changes its owner where it is; a small one does not, nor one that its new owner may not have.
static void arrays_are_handed_over(void **state) {
    (void)state;
    struct arena from, to;
    arena_init(&from, (size_t)1 << 30);
    arena_init(&to, 2000000);
    uint64_t *large = arena_alloc_array(&from, 200000, sizeof *large);
    uint64_t *other = arena_alloc_array(&from, 200000, sizeof *other);
    uint64_t *small = arena_alloc_array(&from, 10, sizeof *small);
    large[199999] = 7;
    other[0] = 8;
    const size_t used = from.used_bytes;
    assert_true(arena_hand_over(&from, &to, large, 200000, sizeof *large));
    assert_true(from.used_bytes <= used - 200000 * sizeof *large);
    assert_true(to.used_bytes >= 200000 * sizeof *large);
    assert_false(arena_hand_over(&from, &to, other, 200000, sizeof *other));
    assert_false(arena_hand_over(&from, &to, NULL, 200000, sizeof *other));
#ifndef GLINT_ARENA_EXACT
    assert_false(arena_hand_over(&from, &to, small, 10, sizeof *small));
#endif
    assert_int_equal(other[0], 8);
    arena_finish(&from);
    assert_int_equal(large[199999], 7);
    assert_int_equal(*(char *)arena_alloc(&to, 100), 0);
    arena_finish(&to);
}

struct regrown {
    struct arena arena;
    uint64_t *items;
    uint32_t count, capacity;
};

static void regrow_without_end(void *context) {
    struct regrown *list = context;
    for (;;) {
        list->items =
            arena_regrow(&list->arena, list->items, list->count, &list->capacity, sizeof *list->items);
        list->items[list->count++] = 1;
    }
}

static void regrowing_keeps_to_the_cap(void **state) {
    (void)state;
    struct regrown list = {.items = NULL};
    arena_init(&list.arena, 1 << 20);
    assert_int_equal(arena_guarded(&list.arena, regrow_without_end, &list), ARENA_FAULT_CAP);
    assert_true(list.arena.used_bytes <= list.arena.cap_bytes);
    assert_int_equal(list.items[list.count - 1], 1);
    arena_finish(&list.arena);
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
        cmocka_unit_test(cap_is_kept_and_ends_the_work),
        cmocka_unit_test(work_that_ends_has_no_fault),
        cmocka_unit_test(sizes_that_overflow_fault),
        cmocka_unit_test(copies_and_formats_end_with_nul),
        cmocka_unit_test(format_jumps_at_the_cap),
        cmocka_unit_test(lists_grow_and_keep_their_items),
        cmocka_unit_test(a_full_list_faults_instead_of_wrapping),
        cmocka_unit_test(a_fault_ends_the_innermost_work),
        cmocka_unit_test(a_fault_is_passed_on),
        cmocka_unit_test(the_guard_of_before_is_put_back),
        cmocka_unit_test(each_of_several_arenas_ends_the_work),
        cmocka_unit_test(each_arena_has_its_own_guard_of_before),
        cmocka_unit_test(memory_stays_until_the_arena_is_finished),
        cmocka_unit_test(finish_takes_null_and_twice),
        cmocka_unit_test(arrays_regrow_and_are_given_back),
        cmocka_unit_test(arrays_are_handed_over),
        cmocka_unit_test(regrowing_keeps_to_the_cap),
        cmocka_unit_test(reset_gives_zeroed_memory_again),
    };
    return cmocka_run_group_tests_name("arena", tests, NULL, NULL);
}
