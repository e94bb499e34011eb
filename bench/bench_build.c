// How fast trees are built and how good they are, against halving by the median and, where it is installed,
// Embree's builder, in turn in the same run.
//
//     bench_build [TRIANGLES | needles:TRIANGLES | MESH.ply]...
//
// A mesh is a PLY file, a closed knot of so many triangles, displaced, or so many long thin ones. For each
// mesh and builder: seconds on the wall and of all threads, the least of the rounds; the median over the
// rounds of its processor time as a multiple of Embree's; the tree's expected cost, nodes, levels, and the
// work of rays from around the mesh through its middle. Embree's time is that of rtcCommitScene: it makes its
// boxes from the triangles and copies these into the tree's leaves. The row `split` is not what glint does: a
// tree over triangles that were cut first, into at most 1.3 times as many boxes, without the time of cutting.
// glint's is that of bvh_build, and in the row `+ items` with the boxes made from the triangles and the
// triangles brought into the leaves' order.
#include "bench/clocks.h"
#include "bench/embree/peer_embree.h"
#include "bench/mesh/mesh.h"
#include "bench/presplit.h"
#include "core/parallel.h"
#include "core/vec3.h"
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
    ROUNDS = 7, // of `median` and `split`, which are only there to compare, the first
    PIECE = 16384,
    RAYS = 200000
};

#define SPLIT_EXTRA 0.3 // boxes besides those of whole triangles

enum row {
    ROW_SAH,
    ROW_WHOLE,
    ROW_MEDIAN,
    ROW_SPLIT,
    ROW_EMBREE,
    ROWS
};

static const char *const row_names[ROWS] = {"sah", "+ items", "median", "split", "embree"};

struct contest {
    const struct bench_mesh *mesh;
    struct gpu_word *words; // of the triangles, by number
    struct gpu_word *leaves;
    struct bvh_item *items;
    struct bvh bvh[ROWS];
    struct peer_embree *embree;
    double wall[ROWS][ROUNDS], processor[ROWS][ROUNDS];
};

static void make_words(struct contest *c) {
    for (uint32_t i = 0; i < c->mesh->triangle_count; i++)
        for (int k = 0; k < TRIANGLE_WORDS; k++) {
            uint32_t bits[3];
            memcpy(bits, c->mesh->positions + 3 * (size_t)c->mesh->corners[3 * (size_t)i + (size_t)k],
                   sizeof bits);
            c->words[(size_t)TRIANGLE_WORDS * i + (size_t)k] =
                (struct gpu_word){bits[0], bits[1], bits[2], k == 0 ? i : 0};
        }
}

static void make_items(void *context, size_t begin, size_t end) {
    const struct contest *c = context;
    for (size_t i = begin; i < end; i++) {
        vec3 corners[3];
        for (size_t k = 0; k < 3; k++) {
            const float *p = c->mesh->positions + 3 * (size_t)c->mesh->corners[3 * i + k];
            corners[k] = (vec3){(double)p[0], (double)p[1], (double)p[2]};
        }
        c->items[i] = bvh_triangle_item(corners, false, (uint32_t)i);
    }
}

static void gather_leaves(void *context, size_t begin, size_t end) {
    const struct contest *c = context;
    for (size_t i = begin; i < end; i++)
        memcpy(c->leaves + i * TRIANGLE_WORDS, c->words + (size_t)c->bvh[ROW_WHOLE].order[i] * TRIANGLE_WORDS,
               TRIANGLE_WORDS * sizeof *c->leaves);
}

struct sphere {
    double middle[3], radius;
};

static struct sphere around(const struct bench_mesh *mesh) {
    double lower[3] = {INFINITY, INFINITY, INFINITY}, upper[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
        lower[i % 3] = fmin(lower[i % 3], (double)mesh->positions[i]);
        upper[i % 3] = fmax(upper[i % 3], (double)mesh->positions[i]);
    }
    struct sphere sphere = {.radius = 0};
    for (int axis = 0; axis < 3; axis++) {
        sphere.middle[axis] = 0.5 * (lower[axis] + upper[axis]);
        sphere.radius = fmax(sphere.radius, 0.5 * (upper[axis] - lower[axis]));
    }
    return sphere;
}

// Average nodes and triangles that a ray reads.
static void trace(const struct bvh *bvh, const struct contest *c, double *nodes, double *items) {
    const struct gpu_word *words = c->words;
    const struct sphere box = around(c->mesh);
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
        const double from[3] = {3 * r * cos(a), 3 * y, 3 * r * sin(a)};
        const double aim[3] = {to, 0.3 * to, 0};
        struct traverse_ray ray = {.far = INFINITY};
        for (int axis = 0; axis < 3; axis++) {
            ray.origin[axis] = (float)(box.middle[axis] + box.radius * from[axis]);
            ray.direction[axis] = (float)(aim[axis] - from[axis]);
        }
        struct traverse_hit hit;
        traverse_closest(&scene, &ray, &hit);
        *nodes += hit.nodes_read;
        *items += hit.items_read;
    }
    free(leaves);
    *nodes /= RAYS;
    *items /= RAYS;
}

static bool build(struct contest *c, enum row row, struct bench_clocks *taken) {
    uint32_t count = c->mesh->triangle_count;
    struct bvh_item *items = c->items;
    if (row == ROW_EMBREE)
        return peer_embree_build(c->embree, taken);
    if (row == ROW_SPLIT && !(items = presplit(c->mesh, SPLIT_EXTRA, &count)))
        return false;
    if (row != ROW_WHOLE && row != ROW_SPLIT)
        parallel_for(count, PIECE, make_items, c);
    bvh_finish(&c->bvh[row]);
    struct bench_clocks start = bench_clocks_now();
    if (row == ROW_WHOLE)
        parallel_for(count, PIECE, make_items, c);
    bool done = bvh_build(items, count, row == ROW_MEDIAN ? BVH_MEDIAN : BVH_SAH, &c->bvh[row]);
    if (done && row == ROW_WHOLE)
        parallel_for(count, PIECE, gather_leaves, c);
    *taken = bench_clocks_since(start);
    if (row == ROW_SPLIT)
        free(items);
    return done;
}

static void print_row(const struct contest *c, enum row row) {
    double ratios[ROUNDS];
    for (int i = 0; i < ROUNDS; i++)
        ratios[i] = c->processor[row][i] / c->processor[ROW_EMBREE][i];
    printf("%10u  %-8s %8.3f %8.3f", c->mesh->triangle_count, row_names[row],
           bench_least(c->wall[row], ROUNDS), bench_least(c->processor[row], ROUNDS));
    printf(c->embree ? " %8.2f" : "        -", bench_median(ratios, ROUNDS));
    if (row != ROW_WHOLE && row != ROW_EMBREE) {
        struct bvh_quality quality = bvh_measure(&c->bvh[row]);
        double nodes, tested;
        trace(&c->bvh[row], c, &nodes, &tested);
        printf(" %8.2f %9u %6u %7.2f %6.2f %9.1f %9.1f", quality.cost, quality.nodes, c->bvh[row].depth,
               quality.children_per_node, quality.items_per_leaf, nodes, tested);
    }
    printf("\n");
}

static bool measure(struct contest *c) {
    const size_t count = c->mesh->triangle_count;
    c->words = malloc(count * TRIANGLE_WORDS * sizeof *c->words);
    c->leaves = malloc(count * TRIANGLE_WORDS * sizeof *c->leaves);
    c->items = malloc(count * sizeof *c->items);
    if (!c->words || !c->leaves || !c->items)
        return false;
    make_words(c);
    const enum row last = c->embree ? ROW_EMBREE : ROW_SPLIT;
    for (int round = 0; round < ROUNDS; round++)
        for (enum row row = 0; row <= last; row++) {
            struct bench_clocks taken = {c->wall[row][0], c->processor[row][0]};
            if (((row != ROW_MEDIAN && row != ROW_SPLIT) || round == 0) && !build(c, row, &taken))
                return false;
            c->wall[row][round] = taken.wall;
            c->processor[row][round] = taken.processor;
        }
    for (enum row row = 0; row <= last; row++)
        print_row(c, row);
    if (!c->embree)
        printf("            embree   not measured: not installed when this program was built\n");
    return true;
}

static bool run(const char *word) {
    struct bench_mesh mesh;
    if (!bench_mesh_open("bench_build", word, &mesh))
        return false;
    struct contest c = {.mesh = &mesh, .embree = peer_embree_open(&mesh)};
    bool done = measure(&c);
    if (!done)
        fprintf(stderr, "bench_build: not enough memory for '%s'\n", word);
    for (enum row row = 0; row < ROWS; row++)
        bvh_finish(&c.bvh[row]);
    free(c.words);
    free(c.leaves);
    free(c.items);
    peer_embree_close(c.embree);
    bench_mesh_finish(&mesh);
    return done;
}

int main(int argc, char **argv) {
    static const char *const standard[] = {"100000", "1100000"};
    const int count = argc > 1 ? argc - 1 : 2;
    printf(
        " triangles  builder      wall  threads x embree     cost     nodes levels fan-out  items nodes/ray "
        "tests/ray\n");
    for (int i = 0; i < count; i++)
        if (!run(argc > 1 ? argv[i + 1] : standard[i]))
            return 1;
    return 0;
}
