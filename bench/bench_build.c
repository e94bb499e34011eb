// How fast trees are built and how good they are, against halving by the median in the same run.
//
//     bench_build [TRIANGLES]...
//
// The mesh is a closed knot, displaced, as a displaced scan is: many small triangles, all over its box.
// For each size and method: seconds and seconds per million triangles (best of three), the tree's
// expected cost, nodes, levels, and the work of rays from around the mesh through its middle.
#include "bench/mesh/knot.h"
#include "core/clock.h"
#include "shaders/gpu_scene.h"
#include "shaders/records.h"
#include "tests/traverse/quality.h"
#include "tests/traverse/traverse.h"
#include "tracer/bvh/bvh.h"
#include "tracer/bvh/items.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    REPEATS = 3,
    RAYS = 200000
};

static uint32_t bits_of(double value) {
    float rounded = (float)value;
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    return bits;
}

static struct gpu_word corner_of(struct knot_grid grid, uint32_t row, uint32_t column) {
    const vec3 p = knot_point(grid, row, column);
    return (struct gpu_word){bits_of(p.x), bits_of(p.y), bits_of(p.z), 0};
}

static uint32_t make_knot(uint32_t wanted, struct gpu_word **words) {
    const struct knot_grid grid = knot_grid(wanted);
    const uint32_t rows = grid.rows, columns = grid.columns, count = rows * columns * 2;
    *words = malloc((size_t)count * TRIANGLE_WORDS * sizeof **words);
    if (!*words)
        return 0;
    struct gpu_word *next = *words;
    for (uint32_t i = 0; i < rows; i++)
        for (uint32_t k = 0; k < columns; k++) {
            struct gpu_word a = corner_of(grid, i, k);
            struct gpu_word b = corner_of(grid, i + 1, k);
            struct gpu_word c = corner_of(grid, i + 1, k + 1);
            struct gpu_word d = corner_of(grid, i, k + 1);
            const struct gpu_word six[6] = {a, b, c, a, c, d};
            memcpy(next, six, sizeof six);
            next[0].w = (uint32_t)((next - *words) / TRIANGLE_WORDS);
            next[3].w = next[0].w + 1;
            next += 6;
        }
    return count;
}

// Average nodes and triangles that a ray reads.
static void trace(const struct bvh *bvh, const struct gpu_word *words, double *nodes, double *items) {
    struct gpu_word *leaves = malloc((size_t)bvh->item_count * TRIANGLE_WORDS * sizeof *leaves);
    *nodes = *items = 0;
    if (!leaves)
        return;
    for (uint32_t i = 0; i < bvh->item_count; i++)
        memcpy(leaves + (size_t)TRIANGLE_WORDS * i, words + (size_t)TRIANGLE_WORDS * bvh->order[i],
               TRIANGLE_WORDS * sizeof *leaves);
    struct traverse_scene scene = {bvh->nodes, leaves};
    for (uint32_t i = 0; i < RAYS; i++) {
        double a = i * 2.399963229728653; // golden angle
        double y = 1 - 2 * (i + 0.5) / RAYS;
        double r = sqrt(1 - y * y);
        double to = (i % 97) / 97.0 - 0.5;
        struct traverse_ray ray = {
            {(float)(3 * r * cos(a)), (float)(3 * y), (float)(3 * r * sin(a))},
            {(float)(to - 3 * r * cos(a)), (float)(0.3 * to - 3 * y), (float)(-3 * r * sin(a))},
            INFINITY};
        struct traverse_hit hit;
        traverse_closest(&scene, &ray, &hit);
        *nodes += hit.nodes_read;
        *items += hit.items_read;
    }
    free(leaves);
    *nodes /= RAYS;
    *items /= RAYS;
}

static bool measure(const struct gpu_word *words, uint32_t count, enum bvh_method method) {
    struct bvh_item *items = malloc((size_t)count * sizeof *items);
    struct bvh bvh = {0};
    double best = INFINITY;
    for (int repeat = 0; repeat < REPEATS && items; repeat++) {
        for (uint32_t i = 0; i < count; i++)
            items[i] = traverse_item(words + (size_t)TRIANGLE_WORDS * i, i);
        bvh_finish(&bvh);
        double start = clock_seconds();
        if (!bvh_build(items, count, method, &bvh))
            break;
        best = fmin(best, clock_seconds() - start);
    }
    free(items);
    if (!bvh.nodes)
        return false;
    struct bvh_quality quality = bvh_measure(&bvh);
    double nodes, tested;
    trace(&bvh, words, &nodes, &tested);
    printf("%10u  %-6s %8.3f %8.3f %8.2f %9u %6u %6.2f %6.2f %8.1f %8.1f\n", count,
           method == BVH_SAH ? "sah" : "median", best, best * 1e6 / count, quality.cost, quality.nodes,
           bvh.depth, quality.children_per_node, quality.items_per_leaf, nodes, tested);
    bvh_finish(&bvh);
    return true;
}

int main(int argc, char **argv) {
    static const char *const standard[] = {"100000", "1100000"};
    int sizes = argc > 1 ? argc - 1 : 2;
    printf(" triangles  method  seconds    per M     cost     nodes levels  fan-out items  nodes/ray "
           "tests/ray\n");
    for (int i = 0; i < sizes; i++) {
        struct gpu_word *words;
        uint32_t wanted = (uint32_t)strtoul(argc > 1 ? argv[i + 1] : standard[i], NULL, 10);
        uint32_t count = make_knot(wanted, &words);
        bool done = count && measure(words, count, BVH_SAH) && measure(words, count, BVH_MEDIAN);
        free(words);
        if (!done) {
            fprintf(stderr, "bench_build: not enough memory for %u triangles\n", wanted);
            return 1;
        }
    }
    return 0;
}
