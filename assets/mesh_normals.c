// Vertex normals of smooth models.
#include "assets/mesh.h"

#include "core/heap.h"

#include <math.h>

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

static bool needs_computed(const struct mesh *mesh) {
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            if (mesh->triangles[t].normals[k] == IR_NO_INDEX)
                return true;
    return false;
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

vec3 *mesh_smooth_normals(const struct mesh *mesh, struct arena *arena) {
    vec3 *normals = ARENA_ARRAY(arena, vec3, heap_times(3, mesh->triangle_count));
    struct sums s = {0};
    if (needs_computed(mesh)) {
        s = sum_at_positions(mesh, arena);
        for (uint32_t i = 0; i < mesh->position_count; i++)
            s.sum[i] = unit_or_zero(s.sum[i], s.weight[i]);
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        const struct mesh_triangle *triangle = &mesh->triangles[t];
        for (int k = 0; k < 3; k++) {
            bool given = triangle->normals[k] != IR_NO_INDEX;
            normals[3 * (size_t)t + (size_t)k] =
                given ? mesh->normals[triangle->normals[k]] : s.sum[mesh->merged[triangle->corners[k]]];
        }
    }
    return normals;
}
