// For sched_setaffinity.
#define _GNU_SOURCE

// The compressed tree: whole, conservative, repeatable, and its traversal equal to testing every triangle.
#include "core/parallel.h"
#include "shaders/gpu_scene.h"
#include "shaders/records.h"
#include "tests/traverse/quality.h"
#include "tests/traverse/traverse.h"
#include "tracer/bvh/bvh.h"
#include "tracer/bvh/items.h"

#include <math.h>
#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static uint64_t random_state = 1;
static uint32_t random_bits(void) {
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(random_state >> 32);
}
static float random_unit(void) {
    return (float)(random_bits() >> 8) * 0x1p-24f;
}
static float random_sign(void) {
    return random_unit() * 2 - 1;
}

// ---- the tree's shape

struct bounds {
    float lower[3], upper[3];
};

static struct bounds bounds_empty(void) {
    return (struct bounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static void bounds_grow(struct bounds *bounds, const float lower[3], const float upper[3]) {
    for (int axis = 0; axis < 3; axis++) {
        bounds->lower[axis] = fminf(bounds->lower[axis], lower[axis]);
        bounds->upper[axis] = fmaxf(bounds->upper[axis], upper[axis]);
    }
}

struct walk {
    const struct bvh *bvh;
    const struct bvh_item *items; // in the caller's order
    uint8_t *seen;                // a count for each item
    uint32_t nodes, depth;
};

// All items below a child lie in its box.
static void walk_node(struct walk *walk, uint32_t node, uint32_t level, struct bounds *bounds);

static void walk_child(struct walk *walk, const struct decoded_child *child, uint32_t level,
                       struct bounds *bounds) {
    struct bounds box = bounds_empty();
    if (child->is_node)
        walk_node(walk, child->first, level + 1, &box);
    else
        assert_in_range(child->count, 1, BVH_LEAF_ITEMS);
    for (uint32_t i = child->first; !child->is_node && i < child->first + child->count; i++) {
        assert_true(i < walk->bvh->item_count);
        uint32_t index = walk->bvh->order[i];
        walk->seen[index]++;
        bounds_grow(&box, walk->items[index].lower, walk->items[index].upper);
    }
    for (int axis = 0; axis < 3; axis++) {
        assert_true(child->lower[axis] < box.lower[axis]);
        assert_true(child->upper[axis] > box.upper[axis]);
    }
    bounds_grow(bounds, box.lower, box.upper);
}

static void walk_node(struct walk *walk, uint32_t node, uint32_t level, struct bounds *bounds) {
    assert_true(node < walk->bvh->node_count);
    assert_true(level <= BVH_DEPTH_MAX);
    walk->nodes++;
    if (level > walk->depth)
        walk->depth = level;
    for (int slot = 0; slot < BVH_WIDTH; slot++) {
        struct decoded_child child;
        if (decode_child(walk->bvh->nodes + (size_t)NODE_WORDS * node, slot, &child))
            walk_child(walk, &child, level, bounds);
    }
}

static void check_tree(const struct bvh_item *items, uint32_t count, enum bvh_method method) {
    struct bvh_item *work = malloc((count + 1) * sizeof *work);
    if (count)
        memcpy(work, items, count * sizeof *work);
    struct bvh bvh;
    assert_true(bvh_build(work, count, method, &bvh));
    assert_int_equal(bvh.item_count, count);
    struct walk walk = {.bvh = &bvh, .items = items, .seen = calloc(count + 1, 1)};
    struct bounds bounds = bounds_empty();
    walk_node(&walk, 0, 1, &bounds);
    assert_int_equal(walk.nodes, bvh.node_count);
    assert_int_equal(walk.depth, bvh.depth);
    for (uint32_t i = 0; i < count; i++)
        assert_int_equal(walk.seen[i], 1);
    free(walk.seen);
    bvh_finish(&bvh);
    free(work);
}

static struct bvh_item item_at(uint32_t index, const float middle[3], const float half[3]) {
    struct bvh_item item = {.index = index};
    for (int axis = 0; axis < 3; axis++) {
        item.lower[axis] = middle[axis] - half[axis];
        item.upper[axis] = middle[axis] + half[axis];
    }
    return item;
}

static struct bvh_item *random_items(uint32_t count, float spread, float size) {
    struct bvh_item *items = malloc((count + 1) * sizeof *items);
    for (uint32_t i = 0; i < count; i++) {
        float middle[3] = {random_sign() * spread, random_sign() * spread, random_sign() * spread};
        float half[3] = {random_unit() * size, random_unit() * size, random_unit() * size};
        items[i] = item_at(i, middle, half);
    }
    return items;
}

static void test_empty(void **state) {
    (void)state;
    struct bvh bvh;
    assert_true(bvh_build(NULL, 0, BVH_SAH, &bvh));
    assert_int_equal(bvh.node_count, 1);
    assert_int_equal(bvh.depth, 1);
    struct decoded_child child;
    for (int slot = 0; slot < BVH_WIDTH; slot++)
        assert_false(decode_child(bvh.nodes, slot, &child));
    struct traverse_scene scene = {bvh.nodes, NULL};
    struct traverse_ray ray = {{0, 0, 0}, {0, 0, 1}, INFINITY};
    struct traverse_hit hit;
    assert_false(traverse_closest(&scene, &ray, &hit));
    assert_false(traverse_any(&scene, &ray));
    bvh_finish(&bvh);
    bvh_finish(NULL);
}

static void test_small_counts(void **state) {
    (void)state;
    for (uint32_t count = 1; count <= 80; count++) {
        struct bvh_item *items = random_items(count, 1, 0.1f);
        check_tree(items, count, BVH_SAH);
        check_tree(items, count, BVH_MEDIAN);
        free(items);
    }
}

static void test_many(void **state) {
    (void)state;
    struct bvh_item *items = random_items(60000, 1, 0.01f);
    check_tree(items, 60000, BVH_SAH);
    check_tree(items, 60000, BVH_MEDIAN);
    free(items);
}

// Sizes from the smallest numbers to the largest that are allowed.
static void test_extremes(void **state) {
    (void)state;
    static const float scales[] = {0x1p-149f, 0x1p-140f, 0x1p-126f, 0x1p-60f, 1, 0x1p60f, 0x1p119f};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++)
        for (size_t k = 0; k < sizeof scales / sizeof *scales; k++) {
            struct bvh_item *items = random_items(200, scales[i] * 0.5f, scales[k] * 0.5f);
            check_tree(items, 200, BVH_SAH);
            free(items);
        }
}

// Points, one point many times, boxes within boxes, a line of boxes each half as far as the one before.
static void test_degenerate(void **state) {
    (void)state;
    enum {
        COUNT = 30000
    };
    struct bvh_item *items = random_items(COUNT, 1, 0);
    check_tree(items, COUNT, BVH_SAH);
    for (uint32_t i = 1; i < COUNT; i++) {
        items[i] = items[0];
        items[i].index = i;
    }
    check_tree(items, COUNT, BVH_SAH);
    check_tree(items, COUNT, BVH_MEDIAN);
    for (uint32_t i = 0; i < COUNT; i++) {
        float half = (float)(i + 1);
        items[i] = item_at(i, (float[3]){0, 0, 0}, (float[3]){half, half, half});
    }
    check_tree(items, COUNT, BVH_SAH);
    for (uint32_t i = 0; i < 2000; i++) {
        float at = ldexpf(1, (int)(i % 240) - 120);
        items[i] = item_at(i, (float[3]){at, i % 3 ? at : 0, i % 2 ? at : 0}, (float[3]){0, 0, 0});
    }
    check_tree(items, 2000, BVH_SAH);
    free(items);
}

// Threads take pieces in another order every time, and there is one of them or several; the bytes stay.
static void test_repeatable(void **state) {
    (void)state;
    enum {
        COUNT = 150000
    };
    cpu_set_t all, one;
    assert_int_equal(sched_getaffinity(0, sizeof all, &all), 0);
    CPU_ZERO(&one);
    for (int cpu = 0; cpu < CPU_SETSIZE && !CPU_COUNT(&one); cpu++)
        if (CPU_ISSET(cpu, &all))
            CPU_SET(cpu, &one);
    struct bvh_item *items = random_items(COUNT, 1, 0.005f);
    struct bvh_item *work = malloc(COUNT * sizeof *work);
    struct bvh first, again;
    memcpy(work, items, COUNT * sizeof *work);
    assert_true(bvh_build(work, COUNT, BVH_SAH, &first));
    for (int i = 0; i < 3; i++) {
        memcpy(work, items, COUNT * sizeof *work);
        assert_int_equal(sched_setaffinity(0, sizeof all, i == 0 ? &one : &all), 0);
        assert_true(bvh_build(work, COUNT, BVH_SAH, &again));
        assert_int_equal(first.node_count, again.node_count);
        assert_memory_equal(first.nodes, again.nodes,
                            (size_t)NODE_WORDS * first.node_count * sizeof *first.nodes);
        assert_memory_equal(first.order, again.order, COUNT * sizeof *first.order);
        bvh_finish(&again);
    }
    bvh_finish(&first);
    free(work);
    free(items);
}

static void test_quality(void **state) {
    (void)state;
    enum {
        COUNT = 20000
    };
    double cost[2];
    for (int method = BVH_SAH; method <= BVH_MEDIAN; method++) {
        random_state = 7;
        struct bvh_item *items = random_items(COUNT, 1, 0.02f);
        struct bvh bvh;
        assert_true(bvh_build(items, COUNT, (enum bvh_method)method, &bvh));
        struct bvh_quality quality = bvh_measure(&bvh);
        assert_true(quality.children_per_node > 5);
        assert_true(quality.items_per_leaf > 1 && quality.items_per_leaf <= BVH_LEAF_ITEMS);
        assert_true(bvh.depth <= 8);
        cost[method] = quality.cost;
        bvh_finish(&bvh);
        free(items);
    }
    assert_true(cost[BVH_SAH] < cost[BVH_MEDIAN]);
}

// ---- traversal

static uint32_t bits_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

struct triangles {
    struct gpu_word *words; // in order of number
    struct gpu_word *leaves;
    struct bvh bvh;
    uint32_t count;
};

static void triangles_build(struct triangles *t) {
    struct bvh_item *items = malloc(t->count * sizeof *items);
    for (uint32_t i = 0; i < t->count; i++)
        items[i] = traverse_item(t->words + (size_t)TRIANGLE_WORDS * i, i);
    assert_true(bvh_build(items, t->count, BVH_SAH, &t->bvh));
    free(items);
    t->leaves = malloc((size_t)TRIANGLE_WORDS * t->count * sizeof *t->leaves);
    for (uint32_t i = 0; i < t->count; i++)
        memcpy(t->leaves + (size_t)TRIANGLE_WORDS * i, t->words + (size_t)TRIANGLE_WORDS * t->bvh.order[i],
               TRIANGLE_WORDS * sizeof *t->leaves);
}

static void triangles_finish(struct triangles *t) {
    bvh_finish(&t->bvh);
    free(t->leaves);
    free(t->words);
}

static void random_triangles(struct triangles *t, uint32_t count, float size) {
    t->count = count;
    t->words = malloc((size_t)TRIANGLE_WORDS * count * sizeof *t->words);
    for (uint32_t i = 0; i < count; i++) {
        float middle[3] = {random_sign(), random_sign(), random_sign()};
        for (int k = 0; k < TRIANGLE_WORDS; k++)
            t->words[(size_t)TRIANGLE_WORDS * i + k] = (struct gpu_word){
                bits_of(middle[0] + random_sign() * size), bits_of(middle[1] + random_sign() * size),
                bits_of(middle[2] + random_sign() * size), k == 0 ? i : 0};
    }
}

// From around the cube at a point in it, now and then parallel to a plane or an axis.
static struct traverse_ray random_ray(void) {
    struct traverse_ray ray = {.far = INFINITY};
    for (int axis = 0; axis < 3; axis++) {
        ray.origin[axis] = random_sign() * 2;
        ray.direction[axis] = random_sign() - ray.origin[axis];
    }
    uint32_t kind = random_bits() % 8;
    for (uint32_t axis = 0; axis < 3; axis++)
        if (kind == axis || (kind == 3 && axis > 0)) {
            ray.origin[axis] *= 0.5f;
            ray.direction[axis] = random_bits() & 1 ? 0.0f : -0.0f;
        }
    return ray;
}

// Every triangle in a tree of its own.
static bool closest_of_all(const struct triangles *t, const struct bvh *singles,
                           const struct traverse_ray *ray, struct traverse_hit *best) {
    bool found = false;
    for (uint32_t i = 0; i < t->count; i++) {
        struct traverse_scene scene = {singles[i].nodes, t->words + (size_t)TRIANGLE_WORDS * i};
        struct traverse_hit hit;
        if (traverse_closest(&scene, ray, &hit) && (!found || hit.distance < best->distance)) {
            *best = hit;
            found = true;
        }
    }
    return found;
}

static void test_closest(void **state) {
    (void)state;
    enum {
        COUNT = 300,
        RAYS = 3000
    };
    struct triangles t;
    random_triangles(&t, COUNT, 0.4f);
    triangles_build(&t);
    struct bvh singles[COUNT];
    for (uint32_t i = 0; i < COUNT; i++) {
        struct bvh_item item = traverse_item(t.words + (size_t)TRIANGLE_WORDS * i, i);
        assert_true(bvh_build(&item, 1, BVH_SAH, &singles[i]));
    }
    struct traverse_scene scene = {t.bvh.nodes, t.leaves};
    uint32_t hits = 0;
    for (int i = 0; i < RAYS; i++) {
        struct traverse_ray ray = random_ray();
        struct traverse_hit hit, best;
        bool found = traverse_closest(&scene, &ray, &hit);
        assert_int_equal(found, closest_of_all(&t, singles, &ray, &best));
        assert_int_equal(found, traverse_any(&scene, &ray));
        if (!found)
            continue;
        hits++;
        assert_int_equal(hit.triangle, best.triangle);
        assert_true(hit.distance == best.distance);
        assert_int_equal(t.bvh.order[hit.item], hit.triangle);
        ray.far = hit.distance;
        assert_false(traverse_any(&scene, &ray));
    }
    assert_true(hits > RAYS / 4);
    for (uint32_t i = 0; i < COUNT; i++)
        bvh_finish(&singles[i]);
    triangles_finish(&t);
}

// Copies of the same triangles: the lowest number wins, wherever it lies in the tree.
static void test_ties(void **state) {
    (void)state;
    enum {
        COPIES = 40,
        COUNT = 50
    };
    struct triangles one, t;
    random_triangles(&one, COUNT, 0.4f);
    t.count = COUNT * COPIES;
    t.words = malloc((size_t)TRIANGLE_WORDS * t.count * sizeof *t.words);
    for (uint32_t i = 0; i < t.count; i++) {
        memcpy(t.words + (size_t)TRIANGLE_WORDS * i, one.words + (size_t)TRIANGLE_WORDS * (i % COUNT),
               TRIANGLE_WORDS * sizeof *t.words);
        t.words[(size_t)TRIANGLE_WORDS * i].w = i;
    }
    triangles_build(&one);
    triangles_build(&t);
    struct traverse_scene few = {one.bvh.nodes, one.leaves};
    struct traverse_scene many = {t.bvh.nodes, t.leaves};
    for (int i = 0; i < 2000; i++) {
        struct traverse_ray ray = random_ray();
        struct traverse_hit a, b;
        assert_int_equal(traverse_closest(&few, &ray, &a), traverse_closest(&many, &ray, &b));
        assert_int_equal(a.triangle, b.triangle);
    }
    triangles_finish(&one);
    triangles_finish(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_empty),      cmocka_unit_test(test_small_counts),
        cmocka_unit_test(test_many),       cmocka_unit_test(test_extremes),
        cmocka_unit_test(test_degenerate), cmocka_unit_test(test_repeatable),
        cmocka_unit_test(test_quality),    cmocka_unit_test(test_closest),
        cmocka_unit_test(test_ties),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
