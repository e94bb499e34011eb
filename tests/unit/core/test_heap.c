#include "core/heap.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/unit/huge_pages.h"

static void keeps_items_and_doubles(void **state) {
    (void)state;
    int *items = NULL;
    uint32_t capacity = 0;
    int moves = 0;
    for (int i = 0; i < 1000; i++) {
        uint32_t before = capacity;
        items = heap_grow(items, (size_t)i, &capacity, sizeof *items);
        assert_non_null(items);
        moves += capacity != before;
        items[i] = i;
    }
    assert_int_equal(capacity, 1024);
    assert_int_equal(moves, 8);
    for (int i = 0; i < 1000; i++)
        assert_int_equal(items[i], i);
    free(items);
}

static void leaves_the_array_where_it_cannot_grow(void **state) {
    (void)state;
    char item = 'a';
    uint32_t capacity = UINT32_MAX / 2 + 1;
    assert_ptr_equal(heap_grow(&item, 0, &capacity, 1), &item);
    assert_null(heap_grow(&item, capacity, &capacity, 1));
    assert_int_equal(capacity, UINT32_MAX / 2 + 1);
    assert_int_equal(item, 'a');
}

// Whether huge pages come is the system's decision, so what is looked at is what it was asked for.
static void what_is_large_asks_for_huge_pages(void **state) {
    (void)state;
    enum {
        BYTES = 16 << 20
    };
    if (!huge_pages_exist())
        skip();
    unsigned char *made[] = {heap_alloc(BYTES), heap_zeroed(BYTES, 1), heap_resize(NULL, BYTES)};
    for (size_t i = 0; i < sizeof made / sizeof *made; i++) {
        assert_non_null(made[i]);
        assert_true(huge_pages_asked(made[i] + BYTES / 2));
        memset(made[i], 1, BYTES);
        free(made[i]);
    }
    unsigned char *small = heap_zeroed(1, 1 << 20);
    assert_non_null(small);
    heap_expect(small, 1); // holds no page
    heap_expect(small, 0);
    free(small);
}

static void products_do_not_wrap(void **state) {
    (void)state;
    assert_int_equal(heap_times(3, 7), 21);
    assert_int_equal(heap_times(0, UINT64_MAX), 0);
    assert_int_equal(heap_times(UINT64_MAX, 0), 0);
    assert_int_equal(heap_times(1, HEAP_TOO_MUCH - 1), HEAP_TOO_MUCH - 1);
    assert_int_equal(heap_times(HEAP_TOO_MUCH / 2, 2), HEAP_TOO_MUCH);
    // What a product in size_t would make zero, and a product of products.
    assert_int_equal(heap_times(UINT64_C(1) << 63, 2), HEAP_TOO_MUCH);
    assert_int_equal(heap_times(heap_times(UINT32_MAX, UINT32_MAX), 16), HEAP_TOO_MUCH);
    assert_true(heap_times(UINT64_MAX, UINT64_MAX) + 1 > HEAP_TOO_MUCH);
}

static void what_cannot_be_held_is_refused(void **state) {
    (void)state;
    const uint64_t count = UINT64_C(1) << 61; // times 16 it is twice 2^64
    int *kept = heap_array(4, sizeof *kept);
    assert_non_null(kept);
    kept[3] = 7;
    assert_null(heap_array(count, 16));
    assert_null(heap_zeroed(count, 16));
    assert_null(heap_resize_array(kept, count, 16));
    assert_int_equal(kept[3], 7);
    kept = heap_resize_array(kept, 8, sizeof *kept);
    assert_non_null(kept);
    assert_int_equal(kept[3], 7);
    free(kept);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keeps_items_and_doubles),
        cmocka_unit_test(leaves_the_array_where_it_cannot_grow),
        cmocka_unit_test(products_do_not_wrap),
        cmocka_unit_test(what_cannot_be_held_is_refused),
        cmocka_unit_test(what_is_large_asks_for_huge_pages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
