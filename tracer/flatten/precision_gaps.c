// Gaps between bodies: pairs whose boxes come close, by a sweep along the axis in which they spread most.
#include "tracer/flatten/precision_parts.h"

#include "grammar/ir.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#define CLOSE 0x1p-12 // of a distance: larger gaps decide nothing

enum {
    MOST_PAIRS = 1 << 22,
};

static double component(vec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// ---- how far two bodies lie apart; NAN: unknown, or they meet

static double between_boxes(const struct precision_body *a, const struct precision_body *b) {
    vec3 gap = vec3_max(vec3_sub(a->lower, b->upper), vec3_sub(b->lower, a->upper));
    gap = vec3_max(gap, (vec3){0, 0, 0});
    double length = vec3_length(gap);
    return length > 0 ? length : NAN;
}

static double between_spheres(const struct ir_sphere *a, const struct ir_sphere *b) {
    double distance = vec3_length(vec3_sub(a->center, b->center));
    double inside = fabs(a->radius - b->radius) - distance; // of the smaller one in the larger
    double outside = distance - a->radius - b->radius;
    return outside > 0 ? outside : inside > 0 ? inside : NAN;
}

struct plane {
    vec3 corner, u, v, normal; // unit normal
};

static struct plane plane_of(const struct ir_rectangle *r) {
    return (struct plane){r->corner, r->edge_u, r->edge_v, vec3_unit(vec3_cross(r->edge_u, r->edge_v))};
}

// Coordinates s, t of a point's foot along the edges from the corner.
static void foot(const struct plane *p, vec3 point, double *s, double *t) {
    vec3 w = vec3_sub(point, p->corner);
    vec3 n = vec3_cross(p->u, p->v);
    double n2 = vec3_dot(n, n);
    *s = vec3_dot(vec3_cross(w, p->v), n) / n2;
    *t = vec3_dot(vec3_cross(p->u, w), n) / n2;
}

static double sphere_to_rectangle(const struct ir_sphere *sphere, const struct ir_rectangle *r) {
    struct plane p = plane_of(r);
    double s, t;
    foot(&p, sphere->center, &s, &t);
    if (s < 0 || s > 1 || t < 0 || t > 1)
        return NAN;
    double gap = fabs(vec3_dot(p.normal, vec3_sub(sphere->center, p.corner))) - sphere->radius;
    return gap > 0 ? gap : NAN;
}

// Of parallel ones that face each other.
static double between_rectangles(const struct ir_rectangle *a, const struct ir_rectangle *b) {
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

static double gap_of(const struct ir_scene *scene, const struct precision_body *a,
                     const struct precision_body *b) {
    const uint32_t spheres = scene->spheres.count, flats = spheres + scene->rectangles.count;
    if (a->body > b->body)
        return gap_of(scene, b, a);
    double exact = NAN;
    if (b->body < spheres)
        return between_spheres(&scene->spheres.items[a->body], &scene->spheres.items[b->body]);
    if (b->body < flats && a->body < spheres)
        exact =
            sphere_to_rectangle(&scene->spheres.items[a->body], &scene->rectangles.items[b->body - spheres]);
    else if (b->body < flats)
        exact = between_rectangles(&scene->rectangles.items[a->body - spheres],
                                   &scene->rectangles.items[b->body - spheres]);
    return isnan(exact) ? between_boxes(a, b) : exact;
}

// Of a rectangle: the error in t of a hit grows with its triangles. 0 for other bodies, which come close to a
// rectangle around a point alone.
static double longest_edge(const struct ir_scene *scene, uint32_t body) {
    const uint32_t spheres = scene->spheres.count;
    if (body < spheres || body - spheres >= scene->rectangles.count)
        return 0;
    const struct ir_rectangle *r = &scene->rectangles.items[body - spheres];
    return fmax(vec3_length(vec3_add(r->edge_u, r->edge_v)), vec3_length(vec3_sub(r->edge_u, r->edge_v)));
}

static void measure_pair(const struct flat_input *input, const struct precision_body *a,
                         const struct precision_body *b, struct precision_report *out) {
    const struct ir_scene *scene = input->scene;
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
    double edges[2] = {longest_edge(scene, a->body), longest_edge(scene, b->body)};
    double edge = fmax(edges[0], edges[1]);
    if (edges[0] > 0 && edges[1] > 0) {
        found.part = PRECISION_HEIGHT_PART;
        found.distance = edge;
        precision_note(&out->least[PRECISION_GAP], found);
    }
}

// ---- the sweep

struct swept {
    double begin, end; // along the axis, the end with what is close
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
            low = fmin(low, component(bodies[i].lower, axis));
            high = fmax(high, component(bodies[i].lower, axis));
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
    struct swept *order = malloc(((size_t)count + 1) * sizeof *order);
    if (!order)
        return false;
    const int axis = widest_axis(bodies, count);
    for (uint32_t i = 0; i < count; i++)
        order[i] = (struct swept){component(bodies[i].lower, axis),
                                  component(bodies[i].upper, axis) + CLOSE * bodies[i].reach, i};
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
