#include "tracer/flatten/precision.h"

#include "core/parallel.h"
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

// Whether the camera stands before the triangle rather than beside it: roughly, by its box.
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
    const struct mesh *mesh;
    affine3 map; // relative to the origin
    const struct flat_input *input;
    uint32_t body;
    struct triangle_least *pieces;
};

static void measure_piece(void *context, size_t begin, size_t end) {
    const struct measuring *m = context;
    struct triangle_least *least = &m->pieces[begin / PIECE];
    for (size_t i = begin; i < end; i++) {
        vec3 corners[3];
        for (int k = 0; k < 3; k++)
            corners[k] = affine3_apply(m->map, m->mesh->positions[m->mesh->triangles[i].corners[k]]);
        measure_triangle(m->input, corners, m->body, (uint32_t)i, least);
    }
}

static void keep_triangles(struct precision_report *out, const struct triangle_least *least) {
    precision_keep(&out->least[PRECISION_EDGE], &least->edge);
    precision_keep(&out->least[PRECISION_HEIGHT], &least->height);
}

// ---- bodies

static void grow(struct precision_body *body, vec3 point) {
    body->lower = vec3_min(body->lower, point);
    body->upper = vec3_max(body->upper, point);
    body->reach = fmax(body->reach, vec3_max_abs(point));
}

static struct precision_body empty_body(uint32_t number) {
    return (struct precision_body){{DBL_MAX, DBL_MAX, DBL_MAX}, {-DBL_MAX, -DBL_MAX, -DBL_MAX}, 0, number};
}

static struct precision_body measure_sphere(const struct flat_input *input, uint32_t i,
                                            struct precision_report *out) {
    const struct ir_sphere *sphere = &input->scene->spheres.items[i];
    struct precision_body body = empty_body(i);
    vec3 center = vec3_sub(sphere->center, input->origin);
    vec3 radius = {sphere->radius, sphere->radius, sphere->radius};
    grow(&body, vec3_sub(center, radius));
    grow(&body, vec3_add(center, radius));
    precision_note(&out->least[PRECISION_SIZE], (struct precision_measure){.length = sphere->radius,
                                                                           .part = PRECISION_SPHERE_PART,
                                                                           .distance = body.reach,
                                                                           .body = i});
    return body;
}

static struct precision_body measure_rectangle(const struct flat_input *input, uint32_t i,
                                               struct precision_report *out) {
    const struct ir_rectangle *r = &input->scene->rectangles.items[i];
    struct precision_body body = empty_body(input->scene->spheres.count + i);
    vec3 corner = vec3_sub(r->corner, input->origin);
    vec3 along_u = vec3_add(corner, r->edge_u);
    const vec3 halves[2][3] = {{corner, along_u, vec3_add(along_u, r->edge_v)},
                               {corner, vec3_add(along_u, r->edge_v), vec3_add(corner, r->edge_v)}};
    for (uint32_t half = 0; half < 2; half++) {
        struct triangle_least least = {0};
        measure_triangle(input, halves[half], body.body, half, &least);
        keep_triangles(out, &least);
        for (int k = 0; k < 3; k++)
            grow(&body, halves[half][k]);
    }
    return body;
}

// false: no memory.
static bool measure_model(const struct flat_input *input, uint32_t i, struct precision_report *out,
                          struct precision_body *body) {
    const struct mesh *mesh = input->assets->models[i].mesh;
    *body = empty_body(input->scene->spheres.count + input->scene->rectangles.count + i);
    if (!mesh || !mesh->triangle_count)
        return true;
    size_t pieces = ((size_t)mesh->triangle_count + PIECE - 1) / PIECE;
    struct measuring m = {.mesh = mesh,
                          .map = view_model_transform(&input->scene->models.items[i]),
                          .input = input,
                          .body = body->body,
                          .pieces = calloc(pieces, sizeof *m.pieces)};
    if (!m.pieces)
        return false;
    m.map.offset = vec3_sub(m.map.offset, input->origin);
    parallel_for(mesh->triangle_count, PIECE, measure_piece, &m);
    for (size_t k = 0; k < pieces; k++)
        keep_triangles(out, &m.pieces[k]);
    free(m.pieces);
    for (uint32_t k = 0; k < mesh->position_count; k++)
        grow(body, affine3_apply(m.map, mesh->positions[k]));
    precision_note(&out->least[PRECISION_SIZE],
                   (struct precision_measure){.length = vec3_length(vec3_sub(body->upper, body->lower)),
                                              .part = PRECISION_MODEL_PART,
                                              .distance = body->reach,
                                              .body = body->body});
    return true;
}

bool precision_measure(const struct flat_input *input, struct precision_report *out) {
    const struct ir_scene *scene = input->scene;
    *out = (struct precision_report){.suffices = true, .all_pairs = true};
    struct precision_body *bodies = malloc(((size_t)ir_body_count(scene) + 1) * sizeof *bodies);
    if (!bodies)
        return false;
    uint32_t count = 0;
    bool good = true;
    for (uint32_t i = 0; i < scene->spheres.count; i++)
        bodies[count++] = measure_sphere(input, i, out);
    for (uint32_t i = 0; i < scene->rectangles.count; i++)
        bodies[count++] = measure_rectangle(input, i, out);
    for (uint32_t i = 0; good && i < scene->models.count; i++) {
        good = measure_model(input, i, out, &bodies[count]);
        count += bodies[count].reach > 0; // a model without its mesh has no box
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
