// Bodies: transforms in double with the origin taken off first, then scale, then rounding to float.
#include "core/parallel.h"
#include "shaders/gpu_scene.h"
#include "tracer/bvh/items.h"
#include "tracer/flatten/flatten_parts.h"

#include <assert.h>
#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COORDINATE_MAX 1e18

enum {
    PIECE = 8192,
    RECTANGLE_TRIANGLES = 2,
};

struct placing flatten_placing(const struct flattening *f, uint32_t model) {
    affine3 map = view_model_transform(&f->input->scene->models.items[model]);
    return (struct placing){map.linear, vec3_sub(map.offset, f->out->origin),
                            mat3_determinant(map.linear) < 0};
}

static vec3 place(const struct placing *placing, vec3 point) {
    return vec3_add(mat3_apply(placing->linear, point), placing->offset);
}

// ---- counting and measuring

static enum flatten_fault report_limit(const struct flattening *f, const struct ir_head *head,
                                       uint64_t total) {
    const struct limit_info *info = limit_info(LIMIT_SCENE_TRIANGLES);
    span at = f->input->origin_places ? ir_place_label(f->input->origin_places, head) : SPAN_NONE;
    diag_add(f->input->sink, DIAG_LIMIT, at, "the scene has %" PRIu64 " triangles; the limit %s is %" PRIu64,
             total, info->name, f->input->limits->value[LIMIT_SCENE_TRIANGLES]);
    if (total <= info->greatest)
        diag_help(f->input->sink, "if this is intended, raise the limit: --limit %s=%" PRIu64, info->name,
                  total);
    return FLATTEN_REPORTED;
}

enum flatten_fault flatten_count(struct flattening *f) {
    const struct ir_scene *scene = f->input->scene;
    const struct assets *assets = f->input->assets;
    uint64_t limit = f->input->limits->value[LIMIT_SCENE_TRIANGLES];
    uint64_t total = 0;
    const struct ir_head *first_over = NULL;
    for (uint32_t i = 0; i < scene->rectangles.count; i++) {
        f->first_triangle[flatten_rectangle_body(scene, i)] = (uint32_t)total;
        total += RECTANGLE_TRIANGLES;
        if (total > limit && !first_over)
            first_over = &scene->rectangles.items[i].head;
    }
    for (uint32_t i = 0; i < scene->models.count; i++) {
        f->first_triangle[flatten_model_body(scene, i)] = (uint32_t)total;
        total += assets->models[i].mesh ? assets->models[i].mesh->triangle_count : 0;
        if (total > limit && !first_over)
            first_over = &scene->models.items[i].head;
    }
    if (first_over)
        return report_limit(f, first_over, total);
    f->triangle_total = (uint32_t)total;
    return FLATTEN_DONE;
}

struct measuring {
    const struct mesh *mesh;
    struct placing placing;
    vec3 offset;      // with the origin still in it
    double *largest;  // by piece: of what is relative to the origin
    double *farthest; // by piece: of scene coordinates
};

static void measure_positions(void *context, size_t begin, size_t end) {
    struct measuring *m = context;
    double largest = 0;
    double farthest = 0;
    for (size_t i = begin; i < end; i++) {
        vec3 turned = mat3_apply(m->placing.linear, m->mesh->positions[i]);
        largest = fmax(largest, vec3_max_abs(vec3_add(turned, m->placing.offset)));
        farthest = fmax(farthest, vec3_max_abs(vec3_add(turned, m->offset)));
    }
    m->largest[begin / PIECE] = largest;
    m->farthest[begin / PIECE] = farthest;
}

static enum flatten_fault measure_model(const struct flattening *f, uint32_t model, double *extent) {
    const struct mesh *mesh = f->input->assets->models[model].mesh;
    if (!mesh || !mesh->position_count)
        return FLATTEN_DONE;
    const struct ir_model *ir = &f->input->scene->models.items[model];
    size_t pieces = ((size_t)mesh->position_count + PIECE - 1) / PIECE;
    double *largest = malloc(2 * pieces * sizeof *largest);
    if (!largest)
        return FLATTEN_NO_MEMORY;
    struct measuring m = {mesh, flatten_placing(f, model), view_model_transform(ir).offset, largest,
                          largest + pieces};
    parallel_for(mesh->position_count, PIECE, measure_positions, &m);
    double farthest = 0;
    for (size_t i = 0; i < pieces; i++) {
        *extent = fmax(*extent, m.largest[i]);
        farthest = fmax(farthest, m.farthest[i]);
    }
    free(largest);
    if (farthest <= COORDINATE_MAX)
        return FLATTEN_DONE;
    span at = f->input->origin_places ? ir_place_label(f->input->origin_places, &ir->head) : SPAN_NONE;
    diag_add(
        f->input->sink, DIAG_TRANSFORM_OVERFLOW, at,
        "after scale, rotation and translation this model has coordinates of %.3g; at most 1e18 is allowed",
        farthest);
    return FLATTEN_REPORTED;
}

// Shared corners are computed once, so that both halves hold the same bits.
static void rectangle_corners(const struct flattening *f, const struct ir_rectangle *r, vec3 corners[4]) {
    corners[0] = vec3_sub(r->corner, f->out->origin);
    corners[1] = vec3_add(corners[0], r->edge_u);
    corners[3] = vec3_add(corners[0], r->edge_v);
    corners[2] = vec3_add(corners[1], r->edge_v);
}

enum flatten_fault flatten_extent(const struct flattening *f, double *extent) {
    const struct ir_scene *scene = f->input->scene;
    *extent = 0;
    for (uint32_t i = 0; i < scene->spheres.count; i++) {
        const struct ir_sphere *sphere = &scene->spheres.items[i];
        vec3 center = vec3_sub(sphere->center, f->out->origin);
        *extent = fmax(*extent, vec3_max_abs(center) + sphere->radius);
    }
    for (uint32_t i = 0; i < scene->rectangles.count; i++) {
        vec3 corners[4];
        rectangle_corners(f, &scene->rectangles.items[i], corners);
        for (int k = 0; k < 4; k++)
            *extent = fmax(*extent, vec3_max_abs(corners[k]));
    }
    enum flatten_fault worst = FLATTEN_DONE;
    for (uint32_t i = 0; i < scene->models.count; i++) {
        enum flatten_fault fault = measure_model(f, i, extent);
        if (fault > worst)
            worst = fault;
    }
    return worst;
}

// ---- filling

static uint32_t material_flags(struct flattening *f, uint32_t material) {
    const struct assets *assets = f->input->assets;
    assert(material < assets->material_count && material <= TRIANGLE_MATERIAL);
    f->material_used[material] = true;
    bool is_checker = assets->materials[material].diffuse_color.kind == IR_PAINT_CHECKER;
    return material | (is_checker ? TRIANGLE_CHECKER : 0);
}

void flatten_spheres(struct flattening *f, struct gpu_word *words, struct bvh_item *items) {
    const struct ir_scene *scene = f->input->scene;
    for (uint32_t i = 0; i < scene->spheres.count; i++) {
        const struct ir_sphere *sphere = &scene->spheres.items[i];
        vec3 center = vec3_mul(vec3_sub(sphere->center, f->out->origin), f->factor);
        uint32_t material = assets_material(scene, &sphere->material);
        struct gpu_word *record = words + f->out->strides.sphere * (size_t)i;
        struct gpu_word *last = record + f->out->strides.sphere - 1;
        double radius = sphere->radius * f->factor;
        if (f->out->is_double)
            flat_put_real3(record, center, flat_double(radius));
        else
            record[0] = flat_word(center, flat_bits(radius));
        *last = (struct gpu_word){i, material_flags(f, material) | TRIANGLE_SOLID, 0, 0};
        items[i] = f->out->is_double ? bvh_sphere64_item(record, i) : bvh_sphere_item(record, i);
    }
}

// Whether the tracer finds a normal: the cross product of the rounded vertices' edges as it takes it, in
// single precision, the edges divided by a power of two first.
static bool has_area(const struct gpu_word *words) {
    float v[3][3], edge[2][3];
    float largest = 0;
    for (int i = 0; i < 3; i++) {
        const uint32_t bits[3] = {words[i].x, words[i].y, words[i].z};
        memcpy(v[i], bits, sizeof bits);
    }
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) {
            edge[i][k] = v[i + 1][k] - v[0][k];
            largest = fmaxf(largest, fabsf(edge[i][k]));
        }
    if (largest < FLT_MIN)
        return false;
    float scale = ldexpf(1, -ilogbf(largest));
    for (int k = 0; k < 3; k++) {
        int next = (k + 1) % 3;
        int last = (k + 2) % 3;
        float cross =
            edge[0][next] * scale * (edge[1][last] * scale) - edge[0][last] * scale * (edge[1][next] * scale);
        if (cross != 0)
            return true;
    }
    return false;
}

// The same in double precision.
static bool has_area64(const vec3 corners[3]) {
    vec3 u = vec3_sub(corners[1], corners[0]), v = vec3_sub(corners[2], corners[0]);
    double largest = fmax(vec3_max_abs(u), vec3_max_abs(v));
    if (largest < DBL_MIN)
        return false;
    double scale = ldexp(1, -ilogb(largest));
    return vec3_max_abs(vec3_cross(vec3_mul(u, scale), vec3_mul(v, scale))) != 0;
}

// What a triangle's record holds besides its vertices.
struct triangle_head {
    uint32_t number, body, shade;
};

// `corners` in flat units. A triangle without area gets an item that flatten_triangles leaves out.
static void put_triangle(const struct flattening *f, const vec3 corners[3], struct triangle_head head) {
    struct gpu_word *words = f->records + (size_t)f->out->strides.triangle * head.number;
    struct bvh_item *item = &f->items[head.number];
    if (f->out->is_double) {
        const struct flat_pair more[3] = {{head.number, head.body}, {head.shade, 0}, {0, 0}};
        for (int k = 0; k < 3; k++)
            flat_put_real3(words + 2 * k, corners[k], more[k]);
        *item = bvh_triangle64_item(words, head.number);
        item->spare = !has_area64(corners);
        return;
    }
    const uint32_t more[3] = {head.number, head.body, head.shade};
    for (int k = 0; k < 3; k++)
        words[k] = flat_word(corners[k], more[k]);
    *item = bvh_triangle_item(words, head.number);
    item->spare = !has_area(words);
}

static void fill_rectangle(struct flattening *f, uint32_t rectangle) {
    const struct ir_rectangle *r = &f->input->scene->rectangles.items[rectangle];
    static const int corner_of[RECTANGLE_TRIANGLES][3] = {{0, 1, 2}, {0, 2, 3}};
    uint32_t body = flatten_rectangle_body(f->input->scene, rectangle);
    uint32_t shade = material_flags(f, assets_material(f->input->scene, &r->material)) | TRIANGLE_RECT;
    vec3 corners[4];
    rectangle_corners(f, r, corners);
    for (uint32_t half = 0; half < RECTANGLE_TRIANGLES; half++) {
        uint32_t number = f->first_triangle[body] + half;
        vec3 flat[3];
        for (int k = 0; k < 3; k++)
            flat[k] = vec3_mul(corners[corner_of[half][k]], f->factor);
        put_triangle(f, flat, (struct triangle_head){number, body, shade | (half ? TRIANGLE_RECT_TOP : 0)});
    }
}

struct filling {
    const struct flattening *f;
    const struct mesh *mesh;
    struct placing placing;
    const uint32_t *group_shade; // material and flags by group
    uint32_t first, body;
};

static void fill_mesh(void *context, size_t begin, size_t end) {
    const struct filling *fill = context;
    for (size_t i = begin; i < end; i++) {
        const struct mesh_triangle *triangle = &fill->mesh->triangles[i];
        uint32_t number = fill->first + (uint32_t)i;
        vec3 flat[3];
        for (int k = 0; k < 3; k++) {
            uint32_t corner = triangle->corners[flatten_corner(&fill->placing, k)];
            vec3 point = place(&fill->placing, fill->mesh->positions[corner]);
            flat[k] = vec3_mul(point, fill->f->factor);
        }
        put_triangle(fill->f, flat,
                     (struct triangle_head){number, fill->body, fill->group_shade[triangle->group]});
    }
}

static enum flatten_fault fill_model(struct flattening *f, uint32_t model) {
    const struct ir_model *ir = &f->input->scene->models.items[model];
    const struct assets_model *asset = &f->input->assets->models[model];
    if (!asset->mesh)
        return FLATTEN_DONE;
    const struct mesh *mesh = asset->mesh;
    uint32_t *shade = malloc((mesh->group_count + (size_t)1) * sizeof *shade);
    if (!shade)
        return FLATTEN_NO_MEMORY;
    uint32_t body = flatten_model_body(f->input->scene, model);
    struct filling fill = {f, mesh, flatten_placing(f, model), shade, f->first_triangle[body], body};
    uint32_t flags = (ir->smooth ? TRIANGLE_SMOOTH : 0) | (mesh->closed ? TRIANGLE_SOLID : 0) |
                     (mesh->turned != fill.placing.mirrors ? TRIANGLE_TURNED : 0);
    for (uint32_t i = 0; i < mesh->group_count; i++)
        shade[i] = material_flags(f, asset->group_material[i]) | flags;
    parallel_for(mesh->triangle_count, PIECE, fill_mesh, &fill);
    free(shade);
    return FLATTEN_DONE;
}

enum flatten_fault flatten_triangles(struct flattening *f) {
    const struct ir_scene *scene = f->input->scene;
    for (uint32_t i = 0; i < scene->rectangles.count; i++)
        fill_rectangle(f, i);
    for (uint32_t i = 0; i < scene->models.count; i++) {
        enum flatten_fault fault = fill_model(f, i);
        if (fault != FLATTEN_DONE)
            return fault;
    }
    for (uint32_t i = 0; i < f->triangle_total; i++)
        if (!f->items[i].spare)
            f->items[f->item_count++] = f->items[i];
    return FLATTEN_DONE;
}
