#include "tracer/flatten/precision.h"

#include "core/heap.h"
#include "core/parallel.h"
#include "grammar/ir.h"
#include "scene/shape.h"
#include "scene/transform.h"
#include "tracer/flatten/precision_internal.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum {
    PIECE = 8192,
    PIECE_CHOSEN = 64, // pieces of PRECISION_PIECE triangles
};

// ---- triangles

// What is measured in one piece of a body's triangles.
struct triangle_least {
    struct precision_measure edge, height;
};

// Whether the camera is above the triangle rather than beside it: roughly, by the triangle's box.
static bool is_above(vec3 camera, const vec3 corners[3], double margin) {
    vec3 lower = vec3_min(corners[0], vec3_min(corners[1], corners[2]));
    vec3 upper = vec3_max(corners[0], vec3_max(corners[1], corners[2]));
    return camera.x >= lower.x - margin && camera.x <= upper.x + margin && camera.y >= lower.y - margin &&
           camera.y <= upper.y + margin && camera.z >= lower.z - margin && camera.z <= upper.z + margin;
}

// `corners` relative to the origin.
static void measure_triangle(const struct flat_input *input, const vec3 corners[3], uint32_t body,
                             uint32_t triangle, struct triangle_least *least) {
    const vec3 camera = vec3_sub(input->view->camera.position, input->origin);
    double shortest = DBL_MAX;
    double longest = 0;
    double reach = 0;
    for (int k = 0; k < 3; k++) {
        double length = vec3_length(vec3_sub(corners[(k + 1) % 3], corners[k]));
        shortest = fmin(shortest, length);
        longest = fmax(longest, length);
        reach = fmax(reach, vec3_max_abs(corners[k]));
    }
    vec3 normal = vec3_cross(vec3_sub(corners[1], corners[0]), vec3_sub(corners[2], corners[0]));
    if (vec3_is_zero(normal))
        return;
    precision_note(&least->edge,
                   (struct precision_measure){
                       .length = shortest, .part = 1, .distance = reach, .body = body, .triangle = triangle});
    double height = fabs(vec3_dot(vec3_unit(normal), vec3_sub(camera, corners[0])));
    if (height > precision_contact(input, reach) && is_above(camera, corners, height))
        precision_note(&least->height, (struct precision_measure){.length = height,
                                                                  .part = PRECISION_HEIGHT_PART,
                                                                  .distance = longest,
                                                                  .body = body,
                                                                  .triangle = triangle});
}

struct measuring {
    const struct scene_body *body;
    affine3 map; // relative to the origin
    const struct flat_input *input;
    uint32_t number;
    struct triangle_least *pieces;
    uint32_t *chosen; // numbers of pieces of PRECISION_PIECE triangles; NULL: all triangles
    uint32_t chosen_count;
};

static void measure_range(const struct measuring *m, size_t begin, size_t end, struct triangle_least *least) {
    for (size_t i = begin; i < end; i++) {
        vec3 corners[3];
        scene_corners(m->body, &m->map, (uint32_t)i, corners);
        measure_triangle(m->input, corners, m->number, (uint32_t)i, least);
    }
}

static void measure_piece(void *context, size_t begin, size_t end) {
    const struct measuring *m = context;
    measure_range(m, begin, end, &m->pieces[begin / PIECE]);
}

// Measures the pieces that bounds do not decide.
static void measure_chosen(void *context, size_t begin, size_t end) {
    const struct measuring *m = context;
    for (size_t i = begin; i < end; i++) {
        const size_t first = (size_t)m->chosen[i] * PRECISION_PIECE, left = m->body->triangle_count - first;
        measure_range(m, first, first + (left < PRECISION_PIECE ? left : PRECISION_PIECE),
                      &m->pieces[begin / PIECE_CHOSEN]);
    }
}

static void keep_triangles(struct precision_report *out, const struct triangle_least *least) {
    precision_keep(&out->least[PRECISION_EDGE], &least->edge);
    precision_keep(&out->least[PRECISION_HEIGHT], &least->height);
}

// Which pieces of a mesh seen before may have something that counts. false: no memory.
static bool choose(struct measuring *m, const struct precision_pieces *known,
                   const struct precision_report *found) {
    const struct precision_view view = precision_view_of(m->input, &m->map, m->body->mesh);
    if (precision_is_beyond(&view, &known->whole, found))
        return true;
    m->chosen = heap_array(known->count + (size_t)1, sizeof *m->chosen);
    for (uint32_t i = 0; m->chosen && i < known->count; i++)
        if (!precision_is_beyond(&view, &known->items[i], found))
            m->chosen[m->chosen_count++] = i;
    return m->chosen != NULL;
}

// `known`: NULL, or the pieces of the body's mesh. false: no memory.
static bool measure_triangles(const struct flat_input *input, const struct scene_body *body, uint32_t number,
                              const affine3 *map, const struct precision_pieces *known,
                              struct precision_report *out) {
    struct measuring m = {body, *map, input, number, NULL, NULL, 0};
    if (known && !choose(&m, known, out))
        return false;
    const size_t count = known ? m.chosen_count : body->triangle_count, piece = known ? PIECE_CHOSEN : PIECE;
    const size_t pieces = (count + piece - 1) / piece;
    m.pieces = heap_zeroed(pieces + 1, sizeof *m.pieces);
    const bool done = m.pieces != NULL;
    if (done)
        parallel_for(count, piece, known ? measure_chosen : measure_piece, &m);
    for (size_t k = 0; done && k < pieces; k++)
        keep_triangles(out, &m.pieces[k]);
    free(m.chosen);
    free(m.pieces);
    return done;
}

// ---- meshes that several bodies show

struct seen {
    struct precision_pieces *items; // without pieces: one body showed the mesh so far
    uint32_t count, capacity;
};

static void finish_seen(struct seen *seen) {
    for (uint32_t i = 0; i < seen->count; i++)
        precision_pieces_finish(&seen->items[i]);
    free(seen->items);
}

// *known: the pieces of the mesh, if another body showed it before; else NULL. Most bodies show the mesh of
// the one before. false: no memory.
static bool find_seen(struct seen *seen, const struct mesh *mesh, const struct precision_pieces **known) {
    *known = NULL;
    for (uint32_t i = seen->count; i > 0; i--) {
        struct precision_pieces *at = &seen->items[i - 1];
        if (at->mesh != mesh)
            continue;
        *known = at;
        return at->items || precision_pieces_make(mesh, at);
    }
    struct precision_pieces *grown = heap_grow(seen->items, seen->count, &seen->capacity, sizeof *grown);
    if (!grown)
        return false;
    seen->items = grown;
    seen->items[seen->count++] = (struct precision_pieces){.mesh = mesh};
    return true;
}

// ---- bodies

// How large a body is, if its size stands for details that nothing else measures.
static void note_size(const struct scene_body *body, const struct precision_body *measured,
                      struct precision_report *out) {
    struct precision_measure size = {.length = body->radius,
                                     .part = PRECISION_SPHERE_PART,
                                     .distance = measured->reach,
                                     .body = measured->body};
    if (shape_traits(body->shape).items == SHAPE_CONE)
        size.length = fmin(fmax(body->radius, body->radius_to), body->height);
    if (body->mesh) {
        size.length = vec3_length(vec3_sub(measured->upper, measured->lower));
        size.part = PRECISION_MODEL_PART;
    }
    if (!shape_traits(body->shape).is_flat)
        precision_note(&out->least[PRECISION_SIZE], size);
}

// false: no memory. *any: the body has something to measure.
static bool measure_body(const struct flat_input *input, uint32_t number, struct seen *seen,
                         struct precision_report *out, struct precision_body *measured, bool *any) {
    const struct precision_pieces *known = NULL;
    const struct scene_body *body = &input->scene->bodies[number];
    const affine3 map = transform_relative(body->object_to_world, input->origin);
    *any = shape_item_count(body) > 0 && scene_body_bounds(body, &map, &measured->lower, &measured->upper);
    if (!*any)
        return true;
    measured->body = number;
    measured->reach = fmax(vec3_max_abs(measured->lower), vec3_max_abs(measured->upper));
    if (body->mesh && !find_seen(seen, body->mesh, &known))
        return false;
    if (body->triangle_count && !measure_triangles(input, body, number, &map, known, out))
        return false;
    note_size(body, measured, out);
    return true;
}

bool precision_measure(const struct flat_input *input, struct precision_report *out) {
    const uint32_t all = input->scene->body_count;
    *out = (struct precision_report){.suffices = true, .all_pairs = true};
    struct precision_body *bodies = heap_array((size_t)all + 1, sizeof *bodies);
    if (!bodies)
        return false;
    uint32_t count = 0;
    struct seen seen = {0};
    bool good = true;
    for (uint32_t i = 0; good && i < all; i++) {
        bool any;
        good = measure_body(input, i, &seen, out, &bodies[count], &any);
        count += any;
    }
    finish_seen(&seen);
    good = good && precision_gaps(input, bodies, count, out);
    free(bodies);
    for (int kind = 0; kind < PRECISION_FEATURES; kind++) {
        const struct precision_measure *least = &out->least[kind];
        const struct precision_measure *before = &out->least[out->decides];
        if (least->any && (!before->any || least->steps < before->steps))
            out->decides = (enum precision_feature)kind;
        out->suffices = out->suffices && !(least->any && least->steps < PRECISION_STEPS);
    }
    return good;
}
