// Bodies that show the same mesh: its triangles once, in a tree of the mesh's own space, which rays enter
// through the inverse of the body's map.
//
// A ray must open each box of that tree whose triangles it might hit in scene space, where they are rounded.
// Let M p + c be a vertex, N the inverse as it is stored, and o + t d a place within the rounding of a
// triangle. In mesh space it is N (o - c) + t N d = p + (N M - 1) p + N e: e is the error of vertices, the
// ray's start and the operations here, a few units of the numbers that they are computed from, and N M - 1 is
// measured. The ray's origin is moved by the sum of these errors, to either side of each plane.
#include "reference/reference_internal.h"

#include "scene/mesh_use.h"
#include "scene/transform.h"

// Units of the largest numbers: 6 for a vertex, 16 by which the boxes of a tree in scene space are wider, 7
// for a ray's start and as many for the operations from there to mesh space and back; and as many again.
#define UNITS 64.0
// The largest error of the inverse, as a fraction of the mesh's size.
#define SHIFT_MOST 0x1p-20

enum {
    // The least number of triangles that sharing must save; each takes about 280 bytes, and its share of the
    // tree's time.
    SAVED_LEAST = 1 << 20,
    SAVED_LEAST_FEW_RAYS = 1 << 17,
    TRIANGLES_LEAST = 64, // of a mesh
    BOXES_DEPTH = 6       // levels of nodes by which an instance's box is found
};

static double row_size(const double row[3], vec3 v) {
    return fabs(row[0]) * v.x + fabs(row[1]) * v.y + fabs(row[2]) * v.z;
}

static vec3 rows_size(const mat3 *m, vec3 v) {
    return (vec3){row_size(m->m[0], v), row_size(m->m[1], v), row_size(m->m[2], v)};
}

// How far to_mesh times the body's map is from the identity, with the rounding of that product.
static mat3 lost(const mat3 *to_mesh, const mat3 *map) {
    mat3 off;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            double sum = i == k ? -1 : 0, size = 1;
            for (int j = 0; j < 3; j++) {
                sum += to_mesh->m[i][j] * map->m[j][k];
                size += fabs(to_mesh->m[i][j] * map->m[j][k]);
            }
            off.m[i][k] = fabs(sum) + REFERENCE_GAMMA(5) * size;
        }
    return off;
}

// false: the map has no inverse that is good enough.
static bool invert(const struct body *body, struct instance *out) {
    const struct mesh *mesh = body->is->mesh;
    const affine3 *map = &body->object_to_world;
    out->to_mesh = transform_inverse(*map).linear;
    const vec3 size = vec3_max(vec3_abs(mesh->lower), vec3_abs(mesh->upper));
    const mat3 off = lost(&out->to_mesh, &map->linear);
    out->shift = rows_size(&off, size);
    out->reach = vec3_add(rows_size(&map->linear, size), vec3_mul(vec3_abs(body->object_to_world.offset), 2));
    const double most = vec3_max_abs(size);
    return out->shift.x <= SHIFT_MOST * most && out->shift.y <= SHIFT_MOST * most &&
           out->shift.z <= SHIFT_MOST * most && isfinite(vec3_max_abs(out->reach));
}

// ---- which

static bool is_shared(const struct mesh_use *uses, uint32_t count, uint32_t i) {
    return (i > 0 && uses[i - 1].mesh == uses[i].mesh) || (i + 1 < count && uses[i + 1].mesh == uses[i].mesh);
}

static bool is_worth_it(const struct reference *r, const struct mesh_use *uses, uint32_t count) {
    uint64_t saved = 0;
    for (uint32_t i = 1; i < count; i++)
        saved += uses[i].mesh == uses[i - 1].mesh ? uses[i].mesh->triangle_count : 0;
    if (r->input.no_tree || r->input.sharing == REFERENCE_COPIES)
        return false;
    return r->input.sharing == REFERENCE_SHARED ||
           saved >= (r->input.few_rays ? SAVED_LEAST_FEW_RAYS : SAVED_LEAST);
}

static void add_instances(struct reference *r, const struct mesh_use *uses, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        if (!is_shared(uses, count, i))
            continue;
        if (i == 0 || uses[i - 1].mesh != uses[i].mesh)
            r->shared_meshes[r->shared_mesh_count++].mesh = uses[i].mesh;
        struct body *body = &r->bodies[uses[i].body];
        struct instance *instance = &r->instances[r->instance_count];
        *instance = (struct instance){.body = uses[i].body, .mesh = r->shared_mesh_count - 1};
        if (!invert(body, instance))
            continue;
        body->instance = r->instance_count++;
        body->primitive_count = 1;
    }
}

void reference_share(struct reference *r) {
    struct mesh_use *uses = ARENA_ARRAY(&r->arena, struct mesh_use, r->input.scene->body_count);
    const uint32_t count = mesh_uses(r->input.scene, TRIANGLES_LEAST, uses);
    if (!is_worth_it(r, uses, count))
        return;
    r->shared_meshes = ARENA_ARRAY(&r->arena, struct shared_mesh, count);
    r->instances = ARENA_ARRAY(&r->arena, struct instance, count);
    add_instances(r, uses, count);
}

const struct instance *reference_instance(const struct reference *r, uint32_t index) {
    uint32_t low = 0, high = r->instance_count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (r->instances[middle].first <= index)
            low = middle;
        else
            high = middle;
    }
    return &r->instances[low];
}

// ---- where

// Grows the box around the image of a box of the mesh's tree.
static void join_node(const affine3 *map, const struct tree_node *node, struct instance *out) {
    const vec3 lower = {node->lower[0], node->lower[1], node->lower[2]};
    const vec3 upper = {node->upper[0], node->upper[1], node->upper[2]};
    const vec3 half = vec3_mul(vec3_sub(upper, lower), 0.5);
    const vec3 middle = affine3_apply(*map, vec3_add(lower, half)), reach = rows_size(&map->linear, half);
    const double at[3] = {middle.x, middle.y, middle.z}, to[3] = {reach.x, reach.y, reach.z};
    for (int a = 0; a < 3; a++) {
        out->lower[a] = reference_smaller(out->lower[a], at[a] - to[a]);
        out->upper[a] = reference_larger(out->upper[a], at[a] + to[a]);
    }
}

static void join_nodes(const affine3 *map, const struct tree_node *nodes, uint32_t at, int depth,
                       struct instance *out) {
    if (nodes[at].count || depth == BOXES_DEPTH) {
        join_node(map, &nodes[at], out);
        return;
    }
    join_nodes(map, nodes, at + 1, depth + 1, out);
    join_nodes(map, nodes, nodes[at].second, depth + 1, out);
}

void reference_place(const struct reference *r, struct instance *instance) {
    const double reach[3] = {instance->reach.x, instance->reach.y, instance->reach.z};
    for (int a = 0; a < 3; a++) {
        instance->lower[a] = INFINITY;
        instance->upper[a] = -INFINITY;
    }
    join_nodes(&r->bodies[instance->body].object_to_world, r->shared_meshes[instance->mesh].nodes, 0, 0,
               instance);
    for (int a = 0; a < 3; a++) {
        instance->lower[a] -= UNITS * reference_unit(r) * reach[a];
        instance->upper[a] += UNITS * reference_unit(r) * reach[a];
    }
}

// ---- rays

void reference_to_mesh(const struct reference *r, const struct instance *instance, const double origin[3],
                       const double direction[3], struct tree_ray *out) {
    const vec3 from = {origin[0], origin[1], origin[2]};
    const mat3 *to_mesh = &instance->to_mesh;
    const vec3 at = mat3_apply(*to_mesh, vec3_sub(from, r->bodies[instance->body].object_to_world.offset));
    const vec3 along = mat3_apply(*to_mesh, (vec3){direction[0], direction[1], direction[2]});
    const vec3 sizes = vec3_mul(vec3_add(vec3_abs(from), instance->reach), UNITS * reference_unit(r));
    const vec3 slack = vec3_add(rows_size(to_mesh, sizes), instance->shift);
    const vec3 lower = vec3_add(at, slack), upper = vec3_sub(at, slack);
    *out = (struct tree_ray){.instance = instance,
                             .nodes = r->shared_meshes[instance->mesh].nodes,
                             .at_lower = {lower.x, lower.y, lower.z},
                             .at_upper = {upper.x, upper.y, upper.z},
                             .inverse = {1 / along.x, 1 / along.y, 1 / along.z}};
}
