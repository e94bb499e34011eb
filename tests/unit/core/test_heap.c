#include "core/heap.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keeps_items_and_doubles),
        cmocka_unit_test(leaves_the_array_where_it_cannot_grow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
