// Every allocation of flattening fails once: each time the sink says so and nothing is left behind
// (the sanitizer build looks for leaks). And what flattening takes at most, against what it gives.
#include "diag/codes/limit.h"
#include "flat_kit.h"

#include <malloc.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define PEAK_MOST 1.3

// The linker sends the program's calls here (--wrap).
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void __wrap_free(void *memory);

static atomic_int until_failure; // 0: none is to come

static bool fails(void) {
    int before = atomic_load(&until_failure);
    while (before > 0 && !atomic_compare_exchange_weak(&until_failure, &before, before - 1))
        ;
    return before == 1;
}

static atomic_size_t live, most;

static void *count(void *memory) {
    const size_t size = malloc_usable_size(memory);
    const size_t now = atomic_fetch_add(&live, size) + size;
    for (size_t seen = most; now > seen && !atomic_compare_exchange_weak(&most, &seen, now);)
        ;
    return memory;
}

void *__wrap_malloc(size_t size) {
    return fails() ? NULL : count(__real_malloc(size));
}
void *__wrap_calloc(size_t number, size_t size) {
    return fails() ? NULL : count(__real_calloc(number, size));
}
void *__wrap_realloc(void *memory, size_t size) {
    if (fails())
        return NULL;
    atomic_fetch_sub(&live, malloc_usable_size(memory));
    return count(__real_realloc(memory, size));
}
void __wrap_free(void *memory) {
    atomic_fetch_sub(&live, malloc_usable_size(memory));
    __real_free(memory);
}

static void build(struct kit *kit, struct picture *picture) {
    kit_init(kit);
    // Large enough for ranges that threads share.
    kit_model(kit, kit_icosphere(kit, 5, 0))->smooth = true;
    kit_sphere(kit);
    kit_rectangle(kit);
    kit_light(kit, (vec3){1, 2, 3});
    kit->assets.background = picture;
}

static void test_each_fails(void **state) {
    (void)state;
    struct kit kit;
    uint16_t pixels[3] = {1, 2, 3};
    struct picture picture = {1, 1, PICTURE_16, pixels, sizeof pixels, NULL, 0};
    build(&kit, &picture);
    kit_resolve(&kit);
    int failed = 0;
    for (int nth = 1;; nth++) {
        struct flat_scene flat;
        diag_sink_finish(&kit.sink);
        diag_sink_init(&kit.sink);
        atomic_store(&until_failure, nth);
        bool done = kit_flatten_resolved(&kit, &flat);
        bool was_reached = atomic_exchange(&until_failure, 0) == 0;
        if (done) {
            flat_finish(&flat);
            // A thread that could not be made is no failure.
            if (!was_reached)
                break;
            continue;
        }
        failed++;
        assert_true(was_reached);
        assert_int_equal(kit.sink.count, 1);
        assert_int_equal(kit.sink.items[0].code, DIAG_OUT_OF_MEMORY);
        assert_null(flat.triangles.words);
    }
    assert_true(failed > 25);
    kit_finish(&kit);
}

static void check_peak(bool is_double) {
    struct kit kit;
    struct flat_scene flat;
    kit_init(&kit);
    kit.is_double = is_double;
    kit_model(&kit, kit_icosphere(&kit, 6, 0));
    kit_resolve(&kit);
    const size_t before = live;
    most = before;
    assert_true(kit_flatten_resolved(&kit, &flat));
    const double peak = (double)(most - before);
    const double final =
        (double)(flat.triangle_nodes.count + flat.triangles.count) * sizeof *flat.triangles.words;
    if (peak > PEAK_MOST * final)
        fail_msg("%u triangles: %.1f bytes each at the peak, %.1f in the end", flat.triangle_count,
                 peak / flat.triangle_count, final / flat.triangle_count);
    flat_finish(&flat);
    kit_finish(&kit);
}

// Items and records of triangles are never in memory together.
static void test_peak(void **state) {
    (void)state;
    check_peak(false);
    check_peak(true);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_each_fails), cmocka_unit_test(test_peak)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
