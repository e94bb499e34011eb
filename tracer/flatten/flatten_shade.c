// What shading needs from a body: the coordinates of its checker, and its vertex normals.
#include "core/heap.h"
#include "core/parallel.h"
#include "grammar/schema.h"
#include "scene/shape.h"
#include "tracer/flatten/flatten_internal.h"

#include <math.h>
#include <stdlib.h>

enum {
    PIECE = 8192
};

// ---- body records

bool flatten_turns_spheres(const struct flattening *f) {
    const struct ir_scene *ir = f->scene->ir;
    for (uint32_t i = 0; i < ir->spheres.count; i++)
        if (!vec3_is_zero(ir->spheres.items[i].rotation) || scene_place(f->scene, &SCHEMA_SPHERE, i))
            return true;
    return false;
}

static bool has_checker(const struct scene *scene, const struct scene_body *body) {
    for (uint32_t i = 0; i < body->group_count; i++)
        if (scene->materials[body->materials[i]].checker)
            return true;
    return false;
}

// flat = (scene - origin) * factor; the coordinates of a checker as a map of flat.
static void put_map(const struct flattening *f, const struct scene_body *body, struct gpu_body *record) {
    affine3 own = transform_inverse(flatten_map(f, body));
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            own.linear.m[i][k] /= f->factor;
    record->row_x = vec3_mul(mat3_row(own.linear, 0), body->cells->scale.x);
    record->row_y = vec3_mul(mat3_row(own.linear, 1), body->cells->scale.y);
    record->row_z = vec3_mul(mat3_row(own.linear, 2), body->cells->scale.z);
    record->offset_x = own.offset.x * body->cells->scale.x + body->cells->offset.x;
    record->offset_y = own.offset.y * body->cells->scale.y + body->cells->offset.y;
    record->offset_z = own.offset.z * body->cells->scale.z + body->cells->offset.z;
}

static void put_edge_lengths(const struct scene_body *body, struct gpu_body *record) {
    const mat3 edges = body->object_to_world.linear;
    record->row_x = (vec3){vec3_length(mat3_column(edges, 0)) * body->cells->scale.x,
                           vec3_length(mat3_column(edges, 1)) * body->cells->scale.y, 0};
}

enum flatten_fault flatten_body_records(struct flattening *f) {
    const uint32_t stride = f->out->strides.body;
    const bool turns = flatten_turns_spheres(f);
    if (!flat_array_make(&f->out->bodies, (uint64_t)f->out->body_count * stride))
        return FLATTEN_NO_MEMORY;
    for (uint32_t i = 0; i < f->out->body_count; i++) {
        const struct scene_body *body = &f->scene->bodies[i];
        struct gpu_body record = {.first_triangle = f->out->first_triangle[i],
                                  .normal_base = f->out->normal_base[i],
                                  .instance = f->out->instance_of[i]};
        if (f->medium)
            record.medium = f->medium[i];
        // Its axes, for images.
        const bool is_round =
            body->shape == SCENE_SPHERE ? turns : shape_traits(body->shape).items == SHAPE_CONE;
        if (has_checker(f->scene, body) || is_round) {
            if (shape_traits(body->shape).is_flat)
                put_edge_lengths(body, &record);
            else
                put_map(f, body, &record);
        }
        gpu_pack_body(&record, f->out->is_double, f->out->bodies.words + (size_t)stride * i);
    }
    return FLATTEN_DONE;
}

// ---- normals

// A smooth body.
struct smooth_use {
    const struct mesh *mesh;
    double crease_angle;
    uint32_t body;
};

static bool has_same_normals(const struct smooth_use *a, const struct smooth_use *b) {
    return a->mesh == b->mesh && a->crease_angle == b->crease_angle;
}

static int compare_uses(const void *a, const void *b) {
    const struct smooth_use *x = a, *y = b;
    if (x->mesh != y->mesh)
        return (uintptr_t)x->mesh < (uintptr_t)y->mesh ? -1 : 1;
    if (x->crease_angle != y->crease_angle)
        return x->crease_angle < y->crease_angle ? -1 : 1;
    return x->body < y->body ? -1 : x->body > y->body;
}

// The smooth bodies, those of one mesh and crease angle together, and the normal base of each in IR order.
static enum flatten_fault list_uses(struct flattening *f, struct smooth_use **uses, uint32_t *count) {
    *count = 0;
    *uses = heap_array((size_t)f->scene->body_count + 1, sizeof **uses);
    if (!*uses)
        return FLATTEN_NO_MEMORY;
    uint64_t normals = 0;
    for (uint32_t i = 0; i < f->scene->body_count; i++) {
        const struct scene_body *body = &f->scene->bodies[i];
        if (!body->smooth || !body->mesh)
            continue;
        // Instances have the normals of the first one, as in the mesh; those with other edges have their own.
        struct shared_mesh *shared = flatten_shared(f, i);
        const bool again = shared && shared->has_normals && shared->crease_angle == body->crease_angle;
        f->out->normal_base[i] = again ? shared->normal_base : (uint32_t)normals;
        if (again)
            continue;
        if (shared && !shared->has_normals) {
            shared->has_normals = true;
            shared->normal_base = (uint32_t)normals;
            shared->crease_angle = body->crease_angle;
        }
        (*uses)[(*count)++] = (struct smooth_use){body->mesh, body->crease_angle, i};
        normals += (uint64_t)body->triangle_count * 3;
    }
    qsort(*uses, *count, sizeof **uses, compare_uses);
    return flat_array_make(&f->out->normals, normals * f->out->strides.normal) ? FLATTEN_DONE
                                                                               : FLATTEN_NO_MEMORY;
}

struct turning {
    const struct flattening *f;
    const struct scene_body *body;
    const vec3 *normals; // of the mesh, three per triangle
    mat3 turn;
    size_t base;
    bool is_shared; // kernels turn them
};

static void turn_normals(void *context, size_t begin, size_t end) {
    const struct turning *t = context;
    const uint32_t stride = t->f->out->strides.normal;
    const bool is_double = stride == NORMAL64_WORDS;
    for (size_t i = 3 * begin; i < 3 * end; i++) {
        // Mirroring exchanges the second and third corner.
        const size_t k = i % 3, corner = t->body->mirrored && k ? 3 - k : k;
        const struct gpu_normal record = {
            t->is_shared ? t->normals[i] : vec3_unit(mat3_apply(t->turn, t->normals[i - k + corner]))};
        gpu_pack_normal(&record, is_double, t->f->out->normals.words + (t->base + i) * stride);
    }
}

struct mesh_turning {
    struct flattening *f;
    const struct smooth_use *uses; // with the same normals
    uint32_t count;
    struct arena arena;
};

// The normals of a mesh are made once, for all bodies that show it.
static void turn_mesh(void *context) {
    struct mesh_turning *m = context;
    const struct mesh *mesh = m->uses[0].mesh;
    const vec3 *normals = mesh_smooth_normals(mesh, m->uses[0].crease_angle, &m->arena);
    for (uint32_t i = 0; i < m->count; i++) {
        const uint32_t number = m->uses[i].body;
        const struct scene_body *body = &m->f->scene->bodies[number];
        struct turning turning = {.f = m->f,
                                  .body = body,
                                  .normals = normals,
                                  .turn = transform_for_normals(body->object_to_world.linear),
                                  .base = m->f->out->normal_base[number],
                                  .is_shared = flatten_shared(m->f, number) != NULL};
        parallel_for(mesh->triangle_count, PIECE, turn_normals, &turning);
    }
}

enum flatten_fault flatten_normals(struct flattening *f) {
    struct smooth_use *uses = NULL;
    uint32_t count;
    enum flatten_fault fault = list_uses(f, &uses, &count);
    for (uint32_t begin = 0, end; fault == FLATTEN_DONE && begin < count; begin = end) {
        for (end = begin + 1; end < count && has_same_normals(&uses[end], &uses[begin]);)
            end++;
        struct mesh_turning m = {.f = f, .uses = uses + begin, .count = end - begin};
        arena_init(&m.arena, SIZE_MAX);
        if (arena_guarded(&m.arena, turn_mesh, &m) != ARENA_FAULT_NONE)
            fault = FLATTEN_NO_MEMORY;
        arena_finish(&m.arena);
    }
    free(uses);
    return fault;
}
