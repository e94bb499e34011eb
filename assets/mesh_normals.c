// Vertex normals of smooth models.
#include "assets/mesh.h"

#include "core/angle.h"
#include "core/forest.h"
#include "core/heap.h"

#include <math.h>
#include <stdlib.h>

// How much sharper than the crease angle an edge may be, in degrees: what positions of seven digits leave
// open.
#define CREASE_SLACK 1e-3

// Unit normal of a face times its angle at each corner (Thürmer and Wüthrich 1998, "Computing Vertex Normals
// from Polygonal Facets"). Zero for faces without area.
static void corner_normals(const struct mesh *mesh, uint32_t triangle, vec3 out[3]) {
    const uint32_t *c = mesh->triangles[triangle].corners;
    vec3 p[3] = {mesh->positions[c[0]], mesh->positions[c[1]], mesh->positions[c[2]]};
    // Unit edges first: their products neither underflow nor overflow.
    vec3 edge[3];
    for (int k = 0; k < 3; k++)
        edge[k] = vec3_unit(vec3_sub(p[(k + 1) % 3], p[k]));
    double angle[3];
    vec3 longest = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        vec3 back = vec3_neg(edge[(k + 2) % 3]);
        vec3 cross = vec3_cross(edge[k], back);
        angle[k] = atan2(vec3_length(cross), vec3_dot(edge[k], back));
        // The corner nearest to a right angle has the most exact normal.
        if (vec3_dot(cross, cross) > vec3_dot(longest, longest))
            longest = cross;
    }
    for (int k = 0; k < 3; k++)
        out[k] = vec3_mul(vec3_unit(longest), angle[k]);
}

// Sums at merged positions, and the sum of the lengths that went into each.
struct sums {
    vec3 *sum;
    double *weight;
};

static struct sums sum_at_positions(const struct mesh *mesh, struct arena *arena) {
    struct sums s = {ARENA_ARRAY(arena, vec3, mesh->position_count),
                     ARENA_ARRAY(arena, double, mesh->position_count)};
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        if (!mesh_has_area(mesh, t))
            continue;
        vec3 normals[3];
        corner_normals(mesh, t, normals);
        for (int k = 0; k < 3; k++) {
            uint32_t at = mesh->merged[mesh->triangles[t].corners[k]];
            s.sum[at] = vec3_add(s.sum[at], normals[k]);
            s.weight[at] += vec3_length(normals[k]);
        }
    }
    return s;
}

// The remainder of normals that cancel is rounding, at most 2^-40 of the added lengths.
static vec3 unit_or_zero(vec3 sum, double weight) {
    if (!(vec3_length(sum) > scalbn(weight, -40)))
        return (vec3){0, 0, 0};
    return vec3_unit(sum);
}

// ---- faces that meet at an edge which is not sharp

// An edge of a face at a vertex: the other end, and the corner.
struct spoke {
    uint32_t vertex, end, corner; // corner: 3 * triangle + k
};

static int compare_spokes(const void *a, const void *b) {
    const struct spoke *x = a, *y = b;
    if (x->vertex != y->vertex)
        return x->vertex < y->vertex ? -1 : 1;
    if (x->end != y->end)
        return x->end < y->end ? -1 : 1;
    return x->corner < y->corner ? -1 : x->corner > y->corner;
}

static size_t list_spokes(const struct mesh *mesh, struct spoke *spokes) {
    size_t count = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        if (!mesh_has_area(mesh, t))
            continue;
        const uint32_t *c = mesh->triangles[t].corners;
        for (uint32_t k = 0; k < 3; k++)
            for (uint32_t step = 1; step < 3; step++)
                spokes[count++] =
                    (struct spoke){mesh->merged[c[k]], mesh->merged[c[(k + step) % 3]], 3 * t + k};
    }
    qsort(spokes, count, sizeof *spokes, compare_spokes);
    return count;
}

static bool is_sharp(vec3 a, vec3 b, double crease_angle) {
    return atan2(vec3_length(vec3_cross(a, b)), vec3_dot(a, b)) > (crease_angle + CREASE_SLACK) * RADIANS;
}

// Normals of all corners: of the faces around a position that edges which are not sharp join, one after the
// other.
static vec3 *creased(const struct mesh *mesh, double crease_angle, struct arena *arena) {
    const size_t corners = (size_t)heap_times(3, mesh->triangle_count);
    vec3 *own = ARENA_ARRAY(arena, vec3, corners), *sum = ARENA_ARRAY(arena, vec3, corners);
    double *weight = ARENA_ARRAY(arena, double, corners);
    uint32_t *parent = ARENA_ARRAY(arena, uint32_t, corners);
    struct spoke *spokes = ARENA_ARRAY(arena, struct spoke, heap_times(2, corners));
    const size_t count = list_spokes(mesh, spokes);
    forest_init(parent, corners);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        if (mesh_has_area(mesh, t))
            corner_normals(mesh, t, own + 3 * (size_t)t);
    for (size_t i = 1; i < count; i++) {
        const struct spoke *a = &spokes[i - 1], *b = &spokes[i];
        if (a->vertex == b->vertex && a->end == b->end &&
            !is_sharp(own[a->corner], own[b->corner], crease_angle))
            forest_join(parent, a->corner, b->corner);
    }
    for (size_t i = 0; i < corners; i++) {
        const uint32_t root = forest_root(parent, (uint32_t)i);
        sum[root] = vec3_add(sum[root], own[i]);
        weight[root] += vec3_length(own[i]);
    }
    for (size_t i = 0; i < corners; i++) {
        const uint32_t root = forest_root(parent, (uint32_t)i);
        own[i] = unit_or_zero(sum[root], weight[root]);
    }
    return own;
}

static vec3 *summed(const struct mesh *mesh, struct arena *arena) {
    struct sums s = sum_at_positions(mesh, arena);
    for (uint32_t i = 0; i < mesh->position_count; i++)
        s.sum[i] = unit_or_zero(s.sum[i], s.weight[i]);
    vec3 *normals = ARENA_ARRAY(arena, vec3, heap_times(3, mesh->triangle_count));
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            normals[3 * (size_t)t + (size_t)k] = s.sum[mesh->merged[mesh->triangles[t].corners[k]]];
    return normals;
}

bool mesh_lacks_normals(const struct mesh *mesh) {
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            if (mesh->triangles[t].normals[k] == IR_NO_INDEX)
                return true;
    return false;
}

vec3 *mesh_smooth_normals(const struct mesh *mesh, double crease_angle, struct arena *arena) {
    vec3 *normals = !mesh_lacks_normals(mesh) ? ARENA_ARRAY(arena, vec3, heap_times(3, mesh->triangle_count))
                    : crease_angle < 180      ? creased(mesh, crease_angle, arena)
                                              : summed(mesh, arena);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            if (mesh->triangles[t].normals[k] != IR_NO_INDEX)
                normals[3 * (size_t)t + (size_t)k] = mesh->normals[mesh->triangles[t].normals[k]];
    return normals;
}
