// What shading asks about a body: its own coordinates for the checker, and its vertex normals.
#include "core/parallel.h"
#include "shaders/gpu_scene.h"
#include "tracer/flatten/flatten_parts.h"

#include <math.h>
#include <stdlib.h>

enum {
    PIECE = 8192
};

// ---- body records

// flat = (scene - origin) * factor, scene = linear * own + offset + origin; this is own as a map of flat.
static affine3 own_of_flat(const struct flattening *f, const mat3 *linear, vec3 offset) {
    const double(*m)[3] = linear->m;
    vec3 rows[3], columns[3]; // columns of the inverse, times the determinant
    for (int i = 0; i < 3; i++)
        rows[i] = (vec3){m[i][0], m[i][1], m[i][2]};
    for (int i = 0; i < 3; i++)
        columns[i] = vec3_cross(rows[(i + 1) % 3], rows[(i + 2) % 3]);
    double determinant = vec3_dot(rows[0], columns[0]);
    affine3 own;
    for (int i = 0; i < 3; i++) {
        own.linear.m[0][i] = columns[i].x / determinant;
        own.linear.m[1][i] = columns[i].y / determinant;
        own.linear.m[2][i] = columns[i].z / determinant;
    }
    own.offset = vec3_neg(mat3_apply(own.linear, offset));
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            own.linear.m[i][k] /= f->factor;
    return own;
}

static void put_row(const struct flattening *f, struct gpu_word *words, int row, vec3 v, double offset) {
    if (f->out->is_double)
        flat_put_real3(words + 1 + 2 * row, v, flat_double(offset));
    else
        words[1 + row] = flat_word(v, flat_bits(offset));
}

static void put_map(const struct flattening *f, struct gpu_word *words, affine3 map) {
    const double offset[3] = {map.offset.x, map.offset.y, map.offset.z};
    for (int i = 0; i < 3; i++)
        put_row(f, words, i, (vec3){map.linear.m[i][0], map.linear.m[i][1], map.linear.m[i][2]}, offset[i]);
}

static bool is_checker(const struct flattening *f, uint32_t material) {
    return f->input->assets->materials[material].diffuse_color.kind == IR_PAINT_CHECKER;
}

static bool has_checker(const struct flattening *f, uint32_t model) {
    const struct assets_model *asset = &f->input->assets->models[model];
    for (uint32_t i = 0; asset->mesh && i < asset->mesh->group_count; i++)
        if (is_checker(f, asset->group_material[i]))
            return true;
    return false;
}

enum flatten_fault flatten_body_records(struct flattening *f) {
    static const mat3 identity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const struct ir_scene *scene = f->input->scene;
    const uint32_t stride = f->out->strides.body;
    if (!flat_array_make(&f->out->bodies, (uint64_t)f->out->body_count * stride))
        return FLATTEN_NO_MEMORY;
    struct gpu_word *words = f->out->bodies.words;
    for (uint32_t body = 0; body < f->out->body_count; body++)
        words[(size_t)stride * body].x = f->first_triangle[body];
    for (uint32_t i = 0; i < scene->spheres.count; i++, words += stride)
        if (is_checker(f, assets_material(scene, &scene->spheres.items[i].material)))
            put_map(f, words,
                    own_of_flat(f, &identity, vec3_sub(scene->spheres.items[i].center, f->out->origin)));
    for (uint32_t i = 0; i < scene->rectangles.count; i++, words += stride) {
        const struct ir_rectangle *r = &scene->rectangles.items[i];
        if (is_checker(f, assets_material(scene, &r->material)))
            put_row(f, words, 0, (vec3){vec3_length(r->edge_u), vec3_length(r->edge_v), 0}, 0);
    }
    for (uint32_t i = 0; i < scene->models.count; i++, words += stride)
        if (has_checker(f, i)) {
            struct placing placing = flatten_placing(f, i);
            put_map(f, words, own_of_flat(f, &placing.linear, placing.offset));
        }
    return FLATTEN_DONE;
}

// ---- normals

struct smooth_use {
    const struct mesh *mesh;
    uint32_t model;
};

static int compare_uses(const void *a, const void *b) {
    const struct smooth_use *x = a;
    const struct smooth_use *y = b;
    if (x->mesh != y->mesh)
        return (uintptr_t)x->mesh < (uintptr_t)y->mesh ? -1 : 1;
    return x->model < y->model ? -1 : x->model > y->model;
}

// The smooth models, those of one mesh together, and the normal base of each body in model order.
static enum flatten_fault list_uses(struct flattening *f, struct smooth_use **uses, uint32_t *count) {
    const struct ir_scene *scene = f->input->scene;
    *count = 0;
    *uses = malloc(((size_t)scene->models.count + 1) * sizeof **uses);
    if (!*uses)
        return FLATTEN_NO_MEMORY;
    uint64_t normals = 0;
    for (uint32_t i = 0; i < scene->models.count; i++) {
        const struct mesh *mesh = f->input->assets->models[i].mesh;
        if (!scene->models.items[i].smooth || !mesh)
            continue;
        f->out->bodies.words[(size_t)f->out->strides.body * flatten_model_body(scene, i)].y =
            (uint32_t)normals;
        normals += (uint64_t)mesh->triangle_count * 3;
        (*uses)[(*count)++] = (struct smooth_use){mesh, i};
    }
    qsort(*uses, *count, sizeof **uses, compare_uses);
    return flat_array_make(&f->out->normals, normals * f->out->strides.normal) ? FLATTEN_DONE
                                                                               : FLATTEN_NO_MEMORY;
}

struct turning {
    const vec3 *normals; // of the mesh, three a triangle
    struct placing placing;
    mat3 turn; // the inverse transpose, times a positive number
    bool is_double;
    struct gpu_word *words;
};

// The matrix of cofactors is the inverse transpose times the determinant; its sign is taken back.
static mat3 normal_map(const struct placing *placing) {
    const double(*m)[3] = placing->linear.m;
    double sign = placing->mirrors ? -1 : 1;
    mat3 turn;
    for (int i = 0; i < 3; i++) {
        const double *p = m[(i + 1) % 3];
        const double *q = m[(i + 2) % 3];
        for (int k = 0; k < 3; k++)
            turn.m[i][k] = sign * (p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3]);
    }
    return turn;
}

static void turn_normals(void *context, size_t begin, size_t end) {
    const struct turning *t = context;
    for (size_t i = begin; i < end; i++)
        for (int k = 0; k < 3; k++) {
            vec3 normal = t->normals[3 * i + (size_t)flatten_corner(&t->placing, k)];
            vec3 unit = vec3_unit(mat3_apply(t->turn, normal));
            if (t->is_double)
                flat_put_real3(t->words + NORMAL64_WORDS * (3 * i + (size_t)k), unit,
                               (struct flat_pair){0, 0});
            else
                t->words[3 * i + (size_t)k] = flat_word(unit, 0);
        }
}

struct mesh_turning {
    struct flattening *f;
    const struct smooth_use *uses; // of one mesh
    uint32_t count;
    struct arena arena;
};

// The normals of one mesh are made once, for all models that show it.
static void turn_mesh(void *context) {
    struct mesh_turning *m = context;
    struct flattening *f = m->f;
    const struct smooth_use *uses = m->uses;
    const struct mesh *mesh = uses[0].mesh;
    const vec3 *normals = mesh_smooth_normals(mesh, &m->arena);
    for (uint32_t i = 0; i < m->count; i++) {
        uint32_t body = flatten_model_body(f->input->scene, uses[i].model);
        struct turning turning = {.normals = normals, .placing = flatten_placing(f, uses[i].model)};
        turning.turn = normal_map(&turning.placing);
        size_t base = f->out->bodies.words[(size_t)f->out->strides.body * body].y;
        turning.is_double = f->out->is_double;
        turning.words = f->out->normals.words + base * f->out->strides.normal;
        parallel_for(mesh->triangle_count, PIECE, turn_normals, &turning);
    }
}

enum flatten_fault flatten_normals(struct flattening *f) {
    struct smooth_use *uses = NULL;
    uint32_t count;
    enum flatten_fault fault = list_uses(f, &uses, &count);
    for (uint32_t begin = 0, end; fault == FLATTEN_DONE && begin < count; begin = end) {
        for (end = begin + 1; end < count && uses[end].mesh == uses[begin].mesh;)
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
