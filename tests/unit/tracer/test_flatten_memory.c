// Every allocation of flattening fails once: each time the sink says so and nothing is left behind
// (the sanitizer build looks for leaks).
#include "flat_kit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

// The linker sends the program's calls here (--wrap).
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);

static atomic_int until_failure; // 0: none is to come

static bool fails(void) {
    int before = atomic_load(&until_failure);
    while (before > 0 && !atomic_compare_exchange_weak(&until_failure, &before, before - 1))
        ;
    return before == 1;
}

void *__wrap_malloc(size_t size) {
    return fails() ? NULL : __real_malloc(size);
}
void *__wrap_calloc(size_t count, size_t size) {
    return fails() ? NULL : __real_calloc(count, size);
}
void *__wrap_realloc(void *memory, size_t size) {
    return fails() ? NULL : __real_realloc(memory, size);
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
    struct picture picture = {1, 1, PICTURE_16, pixels, sizeof pixels, NULL};
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

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_each_fails)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
