#include "tracer/flatten/precision.h"

#include "core/heap.h"
#include "core/parallel.h"
#include "grammar/ir.h"
#include "scene/transform.h"
#include "tracer/flatten/precision_parts.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum {
    PIECE = 8192,
};

// ---- triangles

// What one piece of a body's triangles has.
struct triangle_least {
    struct precision_measure edge, height;
};

// Whether the camera is above the triangle rather than beside it: roughly, by its box.
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
};

static void measure_piece(void *context, size_t begin, size_t end) {
    const struct measuring *m = context;
    struct triangle_least *least = &m->pieces[begin / PIECE];
    for (size_t i = begin; i < end; i++) {
        vec3 corners[3];
        scene_corners(m->body, &m->map, (uint32_t)i, corners);
        measure_triangle(m->input, corners, m->number, (uint32_t)i, least);
    }
}

static void keep_triangles(struct precision_report *out, const struct triangle_least *least) {
    precision_keep(&out->least[PRECISION_EDGE], &least->edge);
    precision_keep(&out->least[PRECISION_HEIGHT], &least->height);
}

// false: no memory.
static bool measure_triangles(const struct flat_input *input, const struct scene_body *body, uint32_t number,
                              const affine3 *map, struct precision_report *out) {
    size_t pieces = ((size_t)body->triangle_count + PIECE - 1) / PIECE;
    struct measuring m = {body, *map, input, number, heap_zeroed(pieces, sizeof *m.pieces)};
    if (!m.pieces)
        return false;
    parallel_for(body->triangle_count, PIECE, measure_piece, &m);
    for (size_t k = 0; k < pieces; k++)
        keep_triangles(out, &m.pieces[k]);
    free(m.pieces);
    return true;
}

// ---- bodies

// How large a body is, as far as its size represents details that nothing else measures.
static void note_size(const struct scene_body *body, const struct precision_body *measured,
                      struct precision_report *out) {
    struct precision_measure size = {.length = body->radius,
                                     .part = PRECISION_SPHERE_PART,
                                     .distance = measured->reach,
                                     .body = measured->body};
    if (body->mesh) {
        size.length = vec3_length(vec3_sub(measured->upper, measured->lower));
        size.part = PRECISION_MODEL_PART;
    }
    if (body->mesh || body->shape == SCENE_SPHERE)
        precision_note(&out->least[PRECISION_SIZE], size);
}

// false: no memory. *any: there is something of the body.
static bool measure_body(const struct flat_input *input, uint32_t number, struct precision_report *out,
                         struct precision_body *measured, bool *any) {
    const struct scene_body *body = &input->scene->bodies[number];
    const affine3 map = transform_relative(body->object_to_world, input->origin);
    *any = (body->triangle_count || body->shape == SCENE_SPHERE) &&
           scene_body_bounds(body, &map, &measured->lower, &measured->upper);
    if (!*any)
        return true;
    measured->body = number;
    measured->reach = fmax(vec3_max_abs(measured->lower), vec3_max_abs(measured->upper));
    if (body->triangle_count && !measure_triangles(input, body, number, &map, out))
        return false;
    note_size(body, measured, out);
    return true;
}

bool precision_measure(const struct flat_input *input, struct precision_report *out) {
    const uint32_t all = input->scene->body_count;
    *out = (struct precision_report){.suffices = true, .all_pairs = true};
    struct precision_body *bodies = heap_alloc(((size_t)all + 1) * sizeof *bodies);
    if (!bodies)
        return false;
    uint32_t count = 0;
    bool good = true;
    for (uint32_t i = 0; good && i < all; i++) {
        bool any;
        good = measure_body(input, i, out, &bodies[count], &any);
        count += any;
    }
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
