// Bodies: transforms in double with the origin subtracted first, then scale, then rounding to float.
#include "core/heap.h"
#include "core/parallel.h"
#include "diag/codes/rule.h"
#include "scene/shape.h"
#include "shaders/frame.h"
#include "tracer/bvh/items.h"
#include "tracer/flatten/flatten_internal.h"

#include <assert.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

#define COORDINATE_MAX 1e18

enum {
    PIECE = 8192,
};

// Whether its record lies among the spheres; else it has triangles.
static bool is_round(const struct scene_body *body) {
    switch (shape_traits(body->shape).items) {
    case SHAPE_BALL:
    case SHAPE_CONE:
        return true;
    case SHAPE_TRIANGLES:
        break;
    }
    return false;
}

static bool is_cone(const struct scene_body *body) {
    return shape_traits(body->shape).items == SHAPE_CONE;
}

// ---- counting and measuring

enum flatten_fault flatten_count(struct flattening *f) {
    uint64_t total = 0;
    if (!scene_check_triangles(f->scene, f->input->limits, f->input->sink))
        return FLATTEN_REPORTED;
    for (uint32_t i = 0; i < f->scene->body_count; i++) {
        const struct scene_body *body = &f->scene->bodies[i];
        f->out->first_triangle[i] = (uint32_t)total;
        f->out->sphere_count += is_round(body) && !is_cone(body);
        f->out->cone_count += is_cone(body);
        total += is_cone(body) ? 1 : body->triangle_count;
    }
    // The limits of a fault's number, and of item numbers (flatten_instances.c).
    _Static_assert(SCENE_ITEMS_MAX < FAULT_NESTED, "");
    f->triangle_total = (uint32_t)total - f->out->cone_count;
    return FLATTEN_DONE;
}

struct measuring {
    const struct mesh *mesh;
    affine3 map;      // relative to the origin
    vec3 offset;      // with the origin still in it
    double *largest;  // by piece: of numbers relative to the origin
    double *farthest; // by piece: of scene coordinates
};

static void measure_positions(void *context, size_t begin, size_t end) {
    struct measuring *m = context;
    double largest = 0;
    double farthest = 0;
    for (size_t i = begin; i < end; i++) {
        vec3 turned = mat3_apply(m->map.linear, m->mesh->positions[i]);
        largest = fmax(largest, vec3_max_abs(vec3_add(turned, m->map.offset)));
        farthest = fmax(farthest, vec3_max_abs(vec3_add(turned, m->offset)));
    }
    m->largest[begin / PIECE] = largest;
    m->farthest[begin / PIECE] = farthest;
}

static enum flatten_fault measure_mesh(const struct flattening *f, const struct scene_body *body,
                                       double *extent) {
    const struct mesh *mesh = body->mesh;
    size_t pieces = ((size_t)mesh->position_count + PIECE - 1) / PIECE;
    double *largest = heap_array(heap_times(2, pieces + 1), sizeof *largest);
    if (!largest)
        return FLATTEN_NO_MEMORY;
    struct measuring m = {mesh, flatten_map(f, body), body->object_to_world.offset, largest,
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
    diag_add(
        f->input->sink, DIAG_TRANSFORM_OVERFLOW, scene_body_label(f->scene, body),
        "after scale, rotation and translation this model has coordinates of %.3g; at most 1e18 is allowed",
        farthest);
    return FLATTEN_REPORTED;
}

static double measure_body(const struct flattening *f, const struct scene_body *body) {
    affine3 map = flatten_map(f, body);
    if (is_round(body) && !is_cone(body))
        return vec3_max_abs(map.offset) + body->radius;
    if (is_cone(body)) {
        vec3 lower, upper;
        scene_body_bounds(body, &map, &lower, &upper);
        return fmax(vec3_max_abs(lower), vec3_max_abs(upper));
    }
    double extent = 0;
    for (uint32_t i = 0; i < body->triangle_count; i++) {
        vec3 corners[3];
        scene_corners(body, &map, i, corners);
        for (int k = 0; k < 3; k++)
            extent = fmax(extent, vec3_max_abs(corners[k]));
    }
    return extent;
}

// Whether a mesh's vertices can neither leave the allowed range nor raise the extent's power of two.
static bool is_bounded(const struct flattening *f, const struct scene_body *body, double extent) {
    const double farthest = fmax(vec3_max_abs(body->lower), vec3_max_abs(body->upper)) * FLATTEN_BOUND;
    const double reach = flatten_reach(f, body);
    return farthest <= COORDINATE_MAX && extent > 0 && (reach == 0 || ilogb(reach) <= ilogb(extent));
}

enum flatten_fault flatten_extent(const struct flattening *f, double *extent) {
    enum flatten_fault worst = FLATTEN_DONE;
    *extent = 0;
    for (uint32_t i = 0; i < f->scene->body_count; i++)
        if (!f->scene->bodies[i].mesh)
            *extent = fmax(*extent, measure_body(f, &f->scene->bodies[i]));
    for (uint32_t i = 0; i < f->scene->body_count; i++) {
        const struct scene_body *body = &f->scene->bodies[i];
        if (!body->mesh || is_bounded(f, body, *extent))
            continue;
        enum flatten_fault fault = measure_mesh(f, body, extent);
        if (fault > worst)
            worst = fault;
    }
    return worst;
}

// ---- filling

static uint32_t material_flags(struct flattening *f, uint32_t material) {
    assert(material < f->scene->material_count && material <= TRIANGLE_MATERIAL);
    f->material_used[material] = true;
    return material | (f->scene->materials[material].checker ? TRIANGLE_CHECKER : 0);
}

void flatten_use_materials(struct flattening *f, const struct scene_body *body) {
    if (shape_item_count(body) == 0)
        return;
    for (uint32_t i = 0; i < body->group_count; i++)
        material_flags(f, body->materials[i]);
}

static struct bvh_item put_sphere(struct flattening *f, const struct scene_body *body,
                                  struct gpu_sphere record, uint32_t place, struct gpu_word *words) {
    record.center = flatten_rounded3(f, vec3_mul(flatten_map(f, body).offset, f->factor));
    record.radius = flatten_rounded(f, body->radius * f->factor);
    gpu_pack_sphere(&record, f->out->is_double, words);
    return bvh_sphere_item(record.center, record.radius, f->out->is_double, place);
}

static struct bvh_item put_cone(struct flattening *f, const struct scene_body *body,
                                struct gpu_frustum record, uint32_t place, struct gpu_word *words) {
    const affine3 map = flatten_map(f, body);
    const bool turned = body->radius_to < body->radius;
    const vec3 axis = mat3_column(map.linear, 1);
    const vec3 to = vec3_add(map.offset, vec3_mul(axis, body->height));
    record.base = flatten_rounded3(f, vec3_mul(turned ? to : map.offset, f->factor));
    record.axis = flatten_rounded3(f, turned ? vec3_neg(axis) : axis);
    record.height = flatten_rounded(f, body->height * f->factor);
    record.radius = flatten_rounded(f, fmin(body->radius, body->radius_to) * f->factor);
    record.slope = flatten_rounded(f, fabs(body->radius_to - body->radius) / body->height);
    record.shade |= FRUSTUM_SHADE | (turned ? FRUSTUM_TURNED : 0);
    gpu_pack_frustum(&record, f->out->is_double, words);
    const struct scene_body as_stored = {.shape = SCENE_CONE,
                                         .radius = record.radius,
                                         .radius_to = record.radius + record.slope * record.height,
                                         .height = record.height};
    const affine3 place_of = {{{{0, record.axis.x, 0}, {0, record.axis.y, 0}, {0, record.axis.z, 0}}},
                              record.base};
    vec3 lower, upper;
    scene_body_bounds(&as_stored, &place_of, &lower, &upper);
    return bvh_box_item(lower, upper, f->out->is_double, place);
}

void flatten_spheres(struct flattening *f, struct gpu_word *words, struct bvh_item *items) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < f->scene->body_count; i++) {
        const struct scene_body *body = &f->scene->bodies[i];
        if (!is_round(body))
            continue;
        const uint32_t shade = material_flags(f, scene_body_material(body, 0)) | TRIANGLE_SOLID;
        struct gpu_word *to = words + f->out->strides.sphere * (size_t)count;
        if (is_cone(body))
            items[count] = put_cone(
                f, body,
                (struct gpu_frustum){
                    .body = i, .shade = shade, .number = f->out->sphere_count + f->out->first_triangle[i]},
                count, to);
        else
            items[count] = put_sphere(f, body, (struct gpu_sphere){.body = i, .shade = shade}, count, to);
        count++;
    }
}

static void pack_triangle(const struct flattening *f, const struct gpu_triangle *from, struct gpu_word *to) {
    if (!f->sharing.instance_count) {
        gpu_pack_triangle(from, f->out->is_double, to);
        return;
    }
    const struct gpu_placed record = {.v0_x = from->v0.x,
                                      .v0_y = from->v0.y,
                                      .v0_z = from->v0.z,
                                      .v1_x = from->v1.x,
                                      .v1_y = from->v1.y,
                                      .v1_z = from->v1.z,
                                      .v2_x = from->v2.x,
                                      .v2_y = from->v2.y,
                                      .v2_z = from->v2.z,
                                      .number = from->number,
                                      .shade = from->shade & ~(3u << TRIANGLE_CORNER_SHIFT),
                                      .body = from->body};
    gpu_pack_placed(&record, to);
}

// Writes the record of a triangle if there is a tree; else its item, which flatten_triangles drops if the
// triangle has no area.
static void put_triangle(const struct flattening *f, const struct flat_corners *flat, uint32_t place,
                         uint32_t number, uint32_t body, uint32_t shade) {
    struct gpu_triangle record = {.v0 = flat->at[0],
                                  .v1 = flat->at[1],
                                  .v2 = flat->at[2],
                                  .number = number,
                                  .body = body,
                                  .shade = shade | flat->best << TRIANGLE_CORNER_SHIFT};
    if (f->leaf_of) {
        if (f->leaf_of[place] != FLATTEN_NO_LEAF)
            pack_triangle(f, &record,
                          f->out->triangles.words + (size_t)f->out->strides.triangle * f->leaf_of[place]);
        return;
    }
    struct bvh_item *item = &f->items[place];
    *item = bvh_triangle_item(flat->at, f->out->is_double, place);
    item->spare = !flat->has_area;
}

struct filling {
    const struct flattening *f;
    const struct scene_body *body;
    affine3 map;
    const uint32_t *group_shade; // material and flags by group; NULL: `shade` for all
    uint32_t shade;
    uint32_t number;        // of the body
    uint32_t first;         // its first record
    const uint32_t *copied; // its triangles that are copied; NULL: all
};

static uint32_t shade_of(const struct filling *fill, uint32_t triangle) {
    if (fill->group_shade)
        return fill->group_shade[fill->body->mesh->triangles[triangle].group];
    return fill->shade | (triangle ? TRIANGLE_SECOND_HALF : 0);
}

static void fill_triangles(void *context, size_t begin, size_t end) {
    const struct filling *fill = context;
    for (size_t i = begin; i < end; i++) {
        const uint32_t triangle = fill->copied ? fill->copied[i] : (uint32_t)i;
        const struct flat_corners flat = flatten_corners(fill->f, fill->body, &fill->map, triangle);
        put_triangle(fill->f, &flat, fill->first + (uint32_t)i,
                     fill->f->out->first_triangle[fill->number] + triangle, fill->number,
                     shade_of(fill, triangle));
    }
}

uint32_t flatten_group_shade(struct flattening *f, const struct scene_body *body, uint32_t group) {
    return material_flags(f, body->materials[group]) | (body->smooth ? TRIANGLE_SMOOTH : 0) |
           (body->closed ? TRIANGLE_SOLID : 0) | (body->mesh->turned != body->mirrored ? TRIANGLE_TURNED : 0);
}

// The first `count` of the body's triangles, or those of `copied`, from record `first` on.
static enum flatten_fault fill_body(struct flattening *f, uint32_t number, uint32_t first,
                                    const uint32_t *copied, uint32_t count) {
    const struct scene_body *body = &f->scene->bodies[number];
    struct filling fill = {.f = f,
                           .body = body,
                           .map = flatten_map(f, body),
                           .number = number,
                           .first = first,
                           .copied = copied};
    if (!body->mesh) {
        fill.shade = material_flags(f, body->materials[0]) | TRIANGLE_HALF;
        fill_triangles(&fill, 0, count);
        return FLATTEN_DONE;
    }
    uint32_t *shade = heap_array(body->group_count + (size_t)1, sizeof *shade);
    if (!shade)
        return FLATTEN_NO_MEMORY;
    for (uint32_t i = 0; i < body->group_count; i++)
        shade[i] = flatten_group_shade(f, body, i);
    fill.group_shade = shade;
    parallel_for(count, PIECE, fill_triangles, &fill);
    free(shade);
    return FLATTEN_DONE;
}

static enum flatten_fault fill_bodies(struct flattening *f) {
    uint32_t place = 0;
    for (uint32_t i = 0; i < f->scene->body_count; i++) {
        const struct shared_mesh *shared = flatten_shared(f, i);
        const uint32_t count = shared ? shared->copied_count : f->scene->bodies[i].triangle_count;
        enum flatten_fault fault =
            count ? fill_body(f, i, place, shared ? shared->copied : NULL, count) : FLATTEN_DONE;
        if (fault != FLATTEN_DONE)
            return fault;
        place += count;
    }
    return FLATTEN_DONE;
}

enum flatten_fault flatten_triangles(struct flattening *f) {
    enum flatten_fault fault = fill_bodies(f);
    for (uint32_t i = 0; i < f->record_total && fault == FLATTEN_DONE; i++)
        if (!f->items[i].spare)
            f->items[f->item_count++] = f->items[i];
    return fault;
}

enum flatten_fault flatten_records(struct flattening *f) {
    return fill_bodies(f);
}
