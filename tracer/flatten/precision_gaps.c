// Gaps between bodies: pairs whose boxes come close, by a sweep along the axis in which they spread most.
#include "core/heap.h"
#include "tracer/flatten/precision_internal.h"

#include "grammar/ir.h"
#include "scene/shape.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#define CLOSE 0x1p-12 // relative to a distance: larger gaps decide nothing

enum {
    MOST_PAIRS = 1 << 22,
};

// ---- the distance between two bodies; NAN: unknown, or they touch

static double between_boxes(const struct precision_body *a, const struct precision_body *b) {
    vec3 gap = vec3_max(vec3_sub(a->lower, b->upper), vec3_sub(b->lower, a->upper));
    gap = vec3_max(gap, (vec3){0, 0, 0});
    double length = vec3_length(gap);
    return length > 0 ? length : NAN;
}

static double between_spheres(const struct scene_body *a, const struct scene_body *b) {
    double distance = vec3_length(vec3_sub(a->object_to_world.offset, b->object_to_world.offset));
    double inside = fabs(a->radius - b->radius) - distance; // of the smaller one in the larger
    double outside = distance - a->radius - b->radius;
    return outside > 0 ? outside : inside > 0 ? inside : NAN;
}

struct plane {
    vec3 corner, u, v, normal; // unit normal
};

static struct plane plane_of(const struct scene_body *body) {
    const affine3 *map = &body->object_to_world;
    struct plane p = {
        .corner = map->offset, .u = mat3_column(map->linear, 0), .v = mat3_column(map->linear, 1)};
    p.normal = vec3_unit(vec3_cross(p.u, p.v));
    return p;
}

// Coordinates s, t, along the edges from the corner, of a point's projection.
static void foot(const struct plane *p, vec3 point, double *s, double *t) {
    vec3 w = vec3_sub(point, p->corner);
    vec3 n = vec3_cross(p->u, p->v);
    double n2 = vec3_dot(n, n);
    *s = vec3_dot(vec3_cross(w, p->v), n) / n2;
    *t = vec3_dot(vec3_cross(p->u, w), n) / n2;
}

static double sphere_to_parallelogram(const struct scene_body *sphere, const struct scene_body *other) {
    const vec3 center = sphere->object_to_world.offset;
    struct plane p = plane_of(other);
    double s, t;
    foot(&p, center, &s, &t);
    if (s < 0 || s > 1 || t < 0 || t > 1)
        return NAN;
    double gap = fabs(vec3_dot(p.normal, vec3_sub(center, p.corner))) - sphere->radius;
    return gap > 0 ? gap : NAN;
}

// Between parallel parallelograms that face each other.
static double between_parallelograms(const struct scene_body *a, const struct scene_body *b) {
    struct plane p = plane_of(a), q = plane_of(b);
    if (vec3_length(vec3_cross(p.normal, q.normal)) > 1e-6)
        return NAN;
    const vec3 corners[4] = {q.corner, vec3_add(q.corner, q.u), vec3_add(q.corner, q.v),
                             vec3_add(vec3_add(q.corner, q.u), q.v)};
    double low[2] = {DBL_MAX, DBL_MAX}, high[2] = {-DBL_MAX, -DBL_MAX};
    for (int k = 0; k < 4; k++) {
        double at[2];
        foot(&p, corners[k], &at[0], &at[1]);
        for (int i = 0; i < 2; i++) {
            low[i] = fmin(low[i], at[i]);
            high[i] = fmax(high[i], at[i]);
        }
    }
    if (low[0] >= 1 || low[1] >= 1 || high[0] <= 0 || high[1] <= 0)
        return NAN;
    return fabs(vec3_dot(p.normal, vec3_sub(q.corner, p.corner)));
}

static double gap_of(const struct scene *scene, const struct precision_body *a,
                     const struct precision_body *b) {
    if (a->body > b->body)
        return gap_of(scene, b, a);
    const struct scene_body *x = &scene->bodies[a->body], *y = &scene->bodies[b->body];
    double exact = NAN;
    if (x->shape == SCENE_SPHERE && y->shape == SCENE_SPHERE)
        return between_spheres(x, y);
    if (x->shape == SCENE_SPHERE && y->shape == SCENE_PARALLELOGRAM)
        exact = sphere_to_parallelogram(x, y);
    else if (x->shape == SCENE_PARALLELOGRAM && y->shape == SCENE_PARALLELOGRAM)
        exact = between_parallelograms(x, y);
    return isnan(exact) ? between_boxes(a, b) : exact;
}

// For a parallelogram: the error in t of a hit grows with its triangles. 0 for other bodies, which come close
// to another only around a point.
static double longest_diagonal(const struct scene_body *body) {
    if (!shape_traits(body->shape).is_flat)
        return 0;
    vec3 u = mat3_column(body->object_to_world.linear, 0), v = mat3_column(body->object_to_world.linear, 1);
    return fmax(vec3_length(vec3_add(u, v)), vec3_length(vec3_sub(u, v)));
}

static void measure_pair(const struct flat_input *input, const struct precision_body *a,
                         const struct precision_body *b, struct precision_report *out) {
    const struct scene *scene = input->scene;
    double gap = gap_of(scene, a, b);
    double distance = fmin(a->reach, b->reach);
    if (!(gap > precision_contact(input, distance)))
        return;
    struct precision_measure found = {.length = gap,
                                      .part = 1,
                                      .distance = distance,
                                      .body = a->body < b->body ? a->body : b->body,
                                      .other = a->body < b->body ? b->body : a->body};
    precision_note(&out->least[PRECISION_GAP], found);
    double edges[2] = {longest_diagonal(&scene->bodies[a->body]), longest_diagonal(&scene->bodies[b->body])};
    double edge = fmax(edges[0], edges[1]);
    if (edges[0] > 0 && edges[1] > 0) {
        found.part = PRECISION_HEIGHT_PART;
        found.distance = edge;
        precision_note(&out->least[PRECISION_GAP], found);
    }
}

// ---- the sweep

struct swept {
    double begin, end; // along the axis; the end includes what is close
    uint32_t index;
};

static int compare_swept(const void *a, const void *b) {
    const struct swept *x = a, *y = b;
    if (x->begin != y->begin)
        return x->begin < y->begin ? -1 : 1;
    return x->index < y->index ? -1 : x->index > y->index;
}

static int widest_axis(const struct precision_body *bodies, uint32_t count) {
    double widest = -1;
    int best = 0;
    for (int axis = 0; axis < 3; axis++) {
        double low = DBL_MAX, high = -DBL_MAX;
        for (uint32_t i = 0; i < count; i++) {
            low = fmin(low, vec3_along(bodies[i].lower, axis));
            high = fmax(high, vec3_along(bodies[i].lower, axis));
        }
        if (high - low > widest) {
            widest = high - low;
            best = axis;
        }
    }
    return best;
}

bool precision_gaps(const struct flat_input *input, const struct precision_body *bodies, uint32_t count,
                    struct precision_report *out) {
    struct swept *order = heap_array((size_t)count + 1, sizeof *order);
    if (!order)
        return false;
    const int axis = widest_axis(bodies, count);
    for (uint32_t i = 0; i < count; i++)
        order[i] = (struct swept){vec3_along(bodies[i].lower, axis),
                                  vec3_along(bodies[i].upper, axis) + CLOSE * bodies[i].reach, i};
    qsort(order, count, sizeof *order, compare_swept);
    uint32_t pairs = 0;
    for (uint32_t i = 0; i < count && out->all_pairs; i++)
        for (uint32_t k = i + 1; k < count && order[k].begin <= order[i].end; k++) {
            if (pairs++ == MOST_PAIRS) {
                out->all_pairs = false;
                break;
            }
            measure_pair(input, &bodies[order[i].index], &bodies[order[k].index], out);
        }
    free(order);
    return true;
}
