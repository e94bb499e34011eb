#include "lint/tree.h"

#include "core/heap.h"
#include "core/parallel.h"

#include <stdlib.h>

enum {
    DEPTH_MAX = 64,
    PIECE = 1 << 14, // triangles or leaves of one piece of parallel work
    DIGIT_BITS = 11, // of the radix sort
    DIGITS = 6,      // enough for 63 bits
    CURVE_CELLS = 1 << 21,
    CROWDED_PART = 8, // if a larger part of the triangles is crowded, listing them saves nothing
};

struct curve_entry {
    uint64_t code;
    uint32_t triangle;
};

struct build {
    struct lint_tree *tree;
    struct curve_entry *entries;
    vec3 lower;
    double cells_per_unit;
};

// ---- the curve

static uint64_t spread(uint64_t x) {
    x &= 0x1FFFFF;
    x = (x | x << 32) & UINT64_C(0x1F00000000FFFF);
    x = (x | x << 16) & UINT64_C(0x1F0000FF0000FF);
    x = (x | x << 8) & UINT64_C(0x100F00F00F00F00F);
    x = (x | x << 4) & UINT64_C(0x10C30C30C30C30C3);
    return (x | x << 2) & UINT64_C(0x1249249249249249);
}

static uint64_t cell(double distance, double cells_per_unit) {
    double at = distance * cells_per_unit;
    return at > 0 ? at < CURVE_CELLS ? (uint64_t)at : CURVE_CELLS - 1 : 0;
}

static void code_piece(void *context, size_t begin, size_t end) {
    struct build *build = context;
    for (size_t i = begin; i < end; i++) {
        struct lint_triangle t = lint_mesh_triangle(build->tree->mesh, build->entries[i].triangle);
        struct lint_box box = lint_box_of(&t);
        vec3 middle = vec3_sub(vec3_mul(vec3_add(box.lower, box.upper), 0.5), build->lower);
        build->entries[i].code = spread(cell(middle.x, build->cells_per_unit)) |
                                 spread(cell(middle.y, build->cells_per_unit)) << 1 |
                                 spread(cell(middle.z, build->cells_per_unit)) << 2;
    }
}

// Least digit first; a digit that all entries share is skipped.
static struct curve_entry *sort_entries(struct curve_entry *entries, struct curve_entry *other,
                                        uint32_t count, struct arena *arena) {
    uint32_t *starts = ARENA_ARRAY(arena, uint32_t, (size_t)1 << DIGIT_BITS);
    for (unsigned digit = 0; digit < DIGITS; digit++) {
        unsigned shift = digit * DIGIT_BITS;
        for (uint32_t d = 0; d < 1u << DIGIT_BITS; d++)
            starts[d] = 0;
        for (uint32_t i = 0; i < count; i++)
            starts[entries[i].code >> shift & ((1u << DIGIT_BITS) - 1)]++;
        if (starts[entries[0].code >> shift & ((1u << DIGIT_BITS) - 1)] == count)
            continue;
        uint32_t sum = 0;
        for (uint32_t d = 0; d < 1u << DIGIT_BITS; d++) {
            uint32_t here = starts[d];
            starts[d] = sum;
            sum += here;
        }
        for (uint32_t i = 0; i < count; i++)
            other[starts[entries[i].code >> shift & ((1u << DIGIT_BITS) - 1)]++] = entries[i];
        struct curve_entry *swap = entries;
        entries = other;
        other = swap;
    }
    return entries;
}

static bool is_crowded(const struct curve_entry *entries, uint32_t count, uint32_t i) {
    return (i > 0 && entries[i].code == entries[i - 1].code) ||
           (i + 1 < count && entries[i].code == entries[i + 1].code);
}

static int compare_triangles(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return x < y ? -1 : x > y;
}

static void find_crowded(struct lint_tree *tree, const struct curve_entry *entries, struct arena *arena) {
    for (uint32_t i = 0; i < tree->count; i++)
        tree->crowded_count += is_crowded(entries, tree->count, i);
    if (tree->crowded_count > tree->count / CROWDED_PART)
        return;
    tree->crowded = ARENA_ARRAY(arena, uint32_t, tree->crowded_count);
    for (uint32_t i = 0, at = 0; i < tree->count && at < tree->crowded_count; i++)
        if (is_crowded(entries, tree->count, i))
            tree->crowded[at++] = entries[i].triangle;
    qsort(tree->crowded, tree->crowded_count, sizeof *tree->crowded, compare_triangles);
}

// ---- boxes

static void leaf_piece(void *context, size_t begin, size_t end) {
    struct build *build = context;
    const struct lint_tree *tree = build->tree;
    for (size_t leaf = begin; leaf < end; leaf++) {
        struct lint_box box = lint_box_empty();
        for (size_t i = leaf * LINT_LEAF; i < (leaf + 1) * LINT_LEAF && i < tree->count; i++) {
            struct lint_triangle t = lint_mesh_triangle(tree->mesh, tree->order[i]);
            box = lint_box_join(box, lint_box_of(&t));
        }
        tree->leaves[leaf] = box;
    }
}

static struct lint_box join_node(const struct build *build, uint32_t node, uint32_t begin, uint32_t end) {
    struct lint_box box;
    if (end - begin == 1) {
        box = build->tree->leaves[begin];
    } else {
        uint32_t middle = begin + (end - begin) / 2;
        box = join_node(build, node + 1, begin, middle);
        box = lint_box_join(box, join_node(build, node + 2 * (middle - begin), middle, end));
    }
    build->tree->nodes[node] = box;
    return box;
}

void lint_tree_build(struct lint_tree *tree, const struct mesh *mesh, struct arena *arena) {
    *tree = (struct lint_tree){.mesh = mesh};
    struct curve_entry *entries = ARENA_ARRAY(arena, struct curve_entry, mesh->triangle_count);
    for (uint32_t i = 0; i < mesh->triangle_count; i++)
        if (mesh->zero_area == 0 || mesh_has_area(mesh, i))
            entries[tree->count++].triangle = i;
    if (tree->count == 0)
        return;
    double extent = vec3_max_abs(vec3_sub(mesh->upper, mesh->lower));
    struct build build = {tree, entries, mesh->lower, extent > 0 ? CURVE_CELLS / extent : 0};
    parallel_for(tree->count, PIECE, code_piece, &build);
    entries = sort_entries(entries, ARENA_ARRAY(arena, struct curve_entry, tree->count), tree->count, arena);
    tree->order = ARENA_ARRAY(arena, uint32_t, tree->count);
    for (uint32_t i = 0; i < tree->count; i++)
        tree->order[i] = entries[i].triangle;
    find_crowded(tree, entries, arena);
    tree->leaf_count = (tree->count + LINT_LEAF - 1) / LINT_LEAF;
    tree->nodes = ARENA_ARRAY(arena, struct lint_box, heap_times(2, tree->leaf_count) - 1);
    tree->leaves = ARENA_ARRAY(arena, struct lint_box, tree->leaf_count);
    parallel_for(tree->leaf_count, PIECE, leaf_piece, &build);
    join_node(&build, 0, 0, tree->leaf_count);
}

// ---- walking

struct stop {
    uint32_t node, begin, end;
};

struct ray {
    vec3 origin, direction;
};

// Clips [*enter, *leave] to where the ray is between two planes; widened by what the division rounds (Ize
// 2013).
static void cut(double origin, double direction, double lower, double upper, double *enter, double *leave) {
    if (direction == 0) {
        if (origin < lower || origin > upper)
            *leave = -1;
        return;
    }
    double a = (lower - origin) / direction;
    double b = (upper - origin) / direction;
    double first = (a < b ? a : b) * (1 - 1e-12);
    double last = (a < b ? b : a) * (1 + 1e-12);
    *enter = first > *enter ? first : *enter;
    *leave = last < *leave ? last : *leave;
}

bool lint_box_on_ray(const struct lint_box *box, vec3 origin, vec3 direction) {
    double enter = 0;
    double leave = INFINITY;
    cut(origin.x, direction.x, box->lower.x, box->upper.x, &enter, &leave);
    cut(origin.y, direction.y, box->lower.y, box->upper.y, &enter, &leave);
    cut(origin.z, direction.z, box->lower.z, box->upper.z, &enter, &leave);
    return enter <= leave;
}

static void walk(const struct lint_tree *tree, const struct lint_box *box, const struct ray *ray,
                 uint32_t from, lint_tree_visit *visit, void *context) {
    struct stop stack[DEPTH_MAX];
    uint32_t waiting = 0;
    if (tree->count == 0)
        return;
    stack[waiting++] = (struct stop){0, 0, tree->leaf_count};
    while (waiting > 0) {
        struct stop at = stack[--waiting];
        const struct lint_box *node = &tree->nodes[at.node];
        if (at.end <= from)
            continue;
        if (box ? !lint_boxes_overlap(node, box) : !lint_box_on_ray(node, ray->origin, ray->direction))
            continue;
        if (at.end - at.begin == 1) {
            uint32_t first = at.begin * LINT_LEAF;
            uint32_t count = tree->count - first < LINT_LEAF ? tree->count - first : LINT_LEAF;
            if (!visit(context, first, count))
                return;
            continue;
        }
        uint32_t middle = at.begin + (at.end - at.begin) / 2;
        stack[waiting++] = (struct stop){at.node + 2 * (middle - at.begin), middle, at.end};
        stack[waiting++] = (struct stop){at.node + 1, at.begin, middle};
    }
}

void lint_tree_in_box(const struct lint_tree *tree, const struct lint_box *box, lint_tree_visit *visit,
                      void *context) {
    walk(tree, box, NULL, 0, visit, context);
}

void lint_tree_in_box_from(const struct lint_tree *tree, const struct lint_box *box, uint32_t from,
                           lint_tree_visit *visit, void *context) {
    walk(tree, box, NULL, from, visit, context);
}

void lint_tree_on_ray(const struct lint_tree *tree, vec3 origin, vec3 direction, lint_tree_visit *visit,
                      void *context) {
    struct ray ray = {origin, direction};
    walk(tree, NULL, &ray, 0, visit, context);
}

// ---- inside

struct winding {
    const struct lint_tree *tree;
    vec3 origin, direction;
    int sum;
};

static bool wind(void *context, uint32_t first, uint32_t count) {
    struct winding *w = context;
    for (uint32_t i = first; i < first + count; i++) {
        struct lint_triangle t = lint_mesh_triangle(w->tree->mesh, w->tree->order[i]);
        double at;
        int side;
        if (lint_triangle_ray(&t, w->origin, w->direction, &at, &side) && at > 0)
            w->sum += side;
    }
    return true;
}

int lint_tree_winding(const struct lint_tree *tree, vec3 point) {
    // Directions unrelated to those that people model in, so a ray hardly ever hits an edge.
    static const vec3 directions[3] = {{0.5403023058681398, 0.8414709848078965, 0.2955202066613396},
                                       {-0.6536436208636119, 0.4546487134128409, 0.7568024953079282},
                                       {0.2836621854632263, -0.6794193416919838, -0.9589242746631385}};
    int found[3];
    for (int k = 0; k < 3; k++) {
        struct winding w = {tree, point, directions[k], 0};
        lint_tree_on_ray(tree, w.origin, w.direction, wind, &w);
        found[k] = w.sum;
    }
    return found[1] == found[2] ? found[1] : found[0];
}
