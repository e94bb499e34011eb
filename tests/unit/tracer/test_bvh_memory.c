// What building a tree takes of memory at most: items, tree and all that is in use for a while, against what
// a device holds in the end, the tree and its triangles.
#include "shaders/gpu_scene.h"
#include "shaders/records.h"
#include "tracer/bvh/bvh.h"

#include <malloc.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define SHARE_MOST 1.3

static atomic_size_t live, most;

static void *count(void *memory) {
    const size_t now = atomic_fetch_add(&live, malloc_usable_size(memory)) + malloc_usable_size(memory);
    for (size_t seen = most; now > seen && !atomic_compare_exchange_weak(&most, &seen, now);)
        ;
    return memory;
}

void *__real_malloc(size_t size);
void *__real_realloc(void *memory, size_t size);
void *__real_calloc(size_t number, size_t size);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_calloc(size_t number, size_t size);
void __wrap_free(void *memory);

void *__wrap_malloc(size_t size) {
    return count(__real_malloc(size));
}
void *__wrap_calloc(size_t number, size_t size) {
    return count(__real_calloc(number, size));
}
void *__wrap_realloc(void *memory, size_t size) {
    atomic_fetch_sub(&live, malloc_usable_size(memory));
    return count(__real_realloc(memory, size));
}
void __wrap_free(void *memory) {
    atomic_fetch_sub(&live, malloc_usable_size(memory));
    __real_free(memory);
}

// Small boxes along a curve that fills a cube unevenly.
static struct bvh_item *make_items(uint32_t number) {
    struct bvh_item *items = malloc(number * sizeof *items);
    for (uint32_t i = 0; i < number; i++) {
        const double t = (double)i / number;
        const double middle[3] = {sin(311 * t), t * cos(57 * t), sin(1013 * t) * t};
        for (int axis = 0; axis < 3; axis++) {
            items[i].lower[axis] = (float)(middle[axis] - 0.002);
            items[i].upper[axis] = (float)(middle[axis] + 0.002 + 0.003 * t);
        }
        items[i].index = i;
        items[i].spare = 0;
    }
    return items;
}

static void check_peak(uint32_t number, enum bvh_method method) {
    const size_t before = live;
    struct bvh_item *items = make_items(number);
    most = live;
    struct bvh bvh;
    assert_true(bvh_build(items, number, method, &bvh));
    const double peak = (double)(most - before);
    const double final = (double)bvh.node_count * NODE_WORDS * sizeof *bvh.nodes +
                         (double)number * (sizeof *bvh.order + TRIANGLE_WORDS * sizeof *bvh.nodes);
    if (peak > SHARE_MOST * final)
        fail_msg("%u items: %.1f bytes each at the peak, %.1f in the end", number, peak / number,
                 final / number);
    assert_true(peak > (double)number * sizeof *items);
    bvh_finish(&bvh);
    free(items);
    assert_int_equal(live, before);
}

static void test_peak(void **state) {
    (void)state;
    check_peak(6000, BVH_SAH);
    check_peak(50000, BVH_SAH);
    check_peak(400000, BVH_SAH);
    check_peak(50000, BVH_MEDIAN);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_peak)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
