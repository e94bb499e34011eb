// A kept tree is found by what it is over, is the same as one that is built, and goes when nobody asks for
// it.
#include "tracer/bvh/keep.h"

#include "shaders/records.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum {
    COUNT = 500
};

static void make_items(struct bvh_item items[COUNT], float moved) {
    for (uint32_t i = 0; i < COUNT; i++) {
        const float at = sinf((float)i) * 3 + (i == COUNT / 2 ? moved : 0);
        items[i] = (struct bvh_item){.lower = {at, at * at, (float)i},
                                     .index = i,
                                     .upper = {at + 0.1f, at * at + 0.1f, (float)i + 0.1f}};
    }
}

static struct bvh build(struct bvh_keep *keep, float moved, enum bvh_method method) {
    struct bvh_item items[COUNT];
    struct bvh bvh;
    make_items(items, moved);
    assert_true(bvh_build_kept(keep, items, COUNT, method, &bvh));
    return bvh;
}

static void check_counts(const struct bvh_keep *keep, uint32_t built, uint32_t found) {
    assert_int_equal(built, bvh_keep_built(keep));
    assert_int_equal(found, bvh_keep_found(keep));
}

static void drop(struct bvh bvh) {
    bvh_finish(&bvh);
}

static void check_equal(struct bvh a, struct bvh b) {
    assert_int_equal(a.node_count, b.node_count);
    assert_int_equal(a.item_count, b.item_count);
    assert_int_equal(a.depth, b.depth);
    assert_memory_equal(a.nodes, b.nodes, a.node_count * NODE_WORDS * sizeof *a.nodes);
    assert_memory_equal(a.order, b.order, a.item_count * sizeof *a.order);
    bvh_finish(&a);
    bvh_finish(&b);
}

static void test_found(void **state) {
    (void)state;
    struct bvh_keep *keep = bvh_keep_create();
    assert_non_null(keep);
    drop(build(keep, 0, BVH_SAH));
    check_counts(keep, 1, 0);
    check_equal(build(keep, 0, BVH_SAH), build(NULL, 0, BVH_SAH));
    check_counts(keep, 1, 1);
    // The caller may change what it got.
    struct bvh mine = build(keep, 0, BVH_SAH);
    memset(mine.nodes, 0xAB, mine.node_count * NODE_WORDS * sizeof *mine.nodes);
    bvh_finish(&mine);
    check_equal(build(keep, 0, BVH_SAH), build(NULL, 0, BVH_SAH));
    bvh_keep_destroy(keep);
}

static void test_another(void **state) {
    (void)state;
    struct bvh_keep *keep = bvh_keep_create();
    drop(build(keep, 0, BVH_SAH));
    check_equal(build(keep, 0.01f, BVH_SAH), build(NULL, 0.01f, BVH_SAH));
    check_equal(build(keep, 0, BVH_SAH_SINGLES), build(NULL, 0, BVH_SAH_SINGLES));
    check_counts(keep, 3, 0);
    struct bvh empty;
    assert_true(bvh_build_kept(keep, NULL, 0, BVH_SAH, &empty));
    drop(empty);
    check_counts(keep, 3, 0);
    bvh_keep_destroy(keep);
}

static void test_sweep(void **state) {
    (void)state;
    struct bvh_keep *keep = bvh_keep_create();
    drop(build(keep, 0, BVH_SAH));
    drop(build(keep, 1, BVH_SAH));
    bvh_keep_sweep(keep);
    drop(build(keep, 1, BVH_SAH));
    bvh_keep_sweep(keep);
    check_counts(keep, 2, 1);
    drop(build(keep, 1, BVH_SAH));
    check_counts(keep, 2, 2);
    drop(build(keep, 0, BVH_SAH));
    check_counts(keep, 3, 2);
    bvh_keep_destroy(keep);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_found),
        cmocka_unit_test(test_another),
        cmocka_unit_test(test_sweep),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
