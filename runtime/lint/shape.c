#include "runtime/lint/shape.h"

// Less of a triangle than this part of it reaches through nothing: rounded corners of neighbours do.
static const double SHALLOW = 0.001;
// Planes that meet at a smaller angle meet nowhere in particular.
static const double PARALLEL_SINE = 1e-6;

// ---- boxes

struct lint_box lint_box_empty(void) {
    return (struct lint_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

void lint_box_add(struct lint_box *box, vec3 point) {
    box->lower = vec3_min(box->lower, point);
    box->upper = vec3_max(box->upper, point);
}

struct lint_box lint_box_join(struct lint_box a, struct lint_box b) {
    return (struct lint_box){vec3_min(a.lower, b.lower), vec3_max(a.upper, b.upper)};
}

struct lint_box lint_box_grow(struct lint_box box, double by) {
    vec3 margin = {by, by, by};
    return (struct lint_box){vec3_sub(box.lower, margin), vec3_add(box.upper, margin)};
}

struct lint_box lint_box_of(const struct lint_triangle *triangle) {
    const vec3 *p = triangle->p;
    return (struct lint_box){vec3_min(vec3_min(p[0], p[1]), p[2]), vec3_max(vec3_max(p[0], p[1]), p[2])};
}

bool lint_box_meets(const struct lint_box *a, const struct lint_box *b) {
    return a->lower.x <= b->upper.x && b->lower.x <= a->upper.x && a->lower.y <= b->upper.y &&
           b->lower.y <= a->upper.y && a->lower.z <= b->upper.z && b->lower.z <= a->upper.z;
}

bool lint_box_holds(const struct lint_box *box, vec3 point) {
    return point.x >= box->lower.x && point.x <= box->upper.x && point.y >= box->lower.y &&
           point.y <= box->upper.y && point.z >= box->lower.z && point.z <= box->upper.z;
}

struct lint_box lint_box_place(struct lint_box box, const affine3 *place) {
    struct lint_box placed = lint_box_empty();
    for (int i = 0; i < 8; i++) {
        vec3 corner = {i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                       i & 4 ? box.upper.z : box.lower.z};
        lint_box_add(&placed, affine3_apply(*place, corner));
    }
    return placed;
}

// ---- crossing

static vec3 normal_of(const struct lint_triangle *t) {
    return vec3_cross(vec3_sub(t->p[1], t->p[0]), vec3_sub(t->p[2], t->p[0]));
}

static bool is_inside(const struct lint_triangle *t, vec3 unit_normal, vec3 point, double margin) {
    for (int k = 0; k < 3; k++) {
        vec3 edge = vec3_sub(t->p[(k + 1) % 3], t->p[k]);
        vec3 inward = vec3_cross(unit_normal, edge);
        if (!(vec3_dot(inward, vec3_sub(point, t->p[k])) > margin * sqrt(vec3_dot(edge, edge))))
            return false;
    }
    return true;
}

struct lint_face lint_face_of(struct lint_triangle triangle) {
    return (struct lint_face){triangle, vec3_unit(normal_of(&triangle))};
}

// What of a triangle lies in the plane of another: a part of the line where the planes meet.
struct cut {
    double least, greatest; // along the line
    double depth;           // of the part of the triangle on the shallower side
    double size;            // its longest edge
};

// false: the triangle does not reach through the plane.
static bool cut_by(const struct lint_triangle *t, const struct lint_face *plane, vec3 along, vec3 origin,
                   struct cut *out) {
    double d[3];
    for (int k = 0; k < 3; k++)
        d[k] = vec3_dot(plane->normal, vec3_sub(t->p[k], plane->t.p[0]));
    *out = (struct cut){INFINITY, -INFINITY, 0, 0};
    out->depth = fmin(fmax(fmax(d[0], d[1]), d[2]), -fmin(fmin(d[0], d[1]), d[2]));
    if (!(out->depth > 0))
        return false;
    for (int k = 0; k < 3; k++) {
        double from = d[k];
        double to = d[(k + 1) % 3];
        vec3 edge = vec3_sub(t->p[(k + 1) % 3], t->p[k]);
        out->size = fmax(out->size, vec3_dot(edge, edge));
        if ((from > 0 && to > 0) || (from < 0 && to < 0) || from == to)
            continue;
        vec3 at = vec3_add(t->p[k], vec3_mul(edge, from / (from - to)));
        double here = vec3_dot(along, vec3_sub(at, origin));
        out->least = fmin(out->least, here);
        out->greatest = fmax(out->greatest, here);
    }
    out->size = sqrt(out->size);
    return true;
}

bool lint_faces_cross(const struct lint_face *a, const struct lint_face *b, double tolerance) {
    vec3 along = vec3_cross(a->normal, b->normal);
    double sine = sqrt(vec3_dot(along, along));
    struct cut of_a, of_b;
    if (!(sine > PARALLEL_SINE) || !cut_by(&a->t, b, along, a->t.p[0], &of_a) || of_a.depth <= tolerance ||
        !cut_by(&b->t, a, along, a->t.p[0], &of_b))
        return false;
    if (of_a.depth <= fmax(tolerance, SHALLOW * of_a.size) ||
        of_b.depth <= fmax(tolerance, SHALLOW * of_b.size))
        return false;
    double common = fmin(of_a.greatest, of_b.greatest) - fmax(of_a.least, of_b.least);
    return common > sine * fmax(tolerance, SHALLOW * fmin(of_a.size, of_b.size));
}

// ---- lying in one plane

static bool lies_near(const struct lint_triangle *t, vec3 at, vec3 unit_normal, double near) {
    for (int k = 0; k < 3; k++)
        if (!(fabs(vec3_dot(unit_normal, vec3_sub(t->p[k], at))) <= near))
            return false;
    return true;
}

static void project(const struct lint_triangle *t, vec3 axis, vec3 origin, double *least, double *greatest) {
    *least = INFINITY;
    *greatest = -INFINITY;
    for (int k = 0; k < 3; k++) {
        double at = vec3_dot(axis, vec3_sub(t->p[k], origin));
        *least = fmin(*least, at);
        *greatest = fmax(*greatest, at);
    }
}

// Whether an edge of `a` parts them; an axis along which one of them is too narrow to tell parts them too.
static bool is_parted(const struct lint_triangle *a, const struct lint_triangle *b, vec3 unit_normal,
                      double tolerance) {
    for (int k = 0; k < 3; k++) {
        vec3 axis = vec3_unit(vec3_cross(unit_normal, vec3_sub(a->p[(k + 1) % 3], a->p[k])));
        double least_a, greatest_a, least_b, greatest_b;
        project(a, axis, a->p[0], &least_a, &greatest_a);
        project(b, axis, a->p[0], &least_b, &greatest_b);
        double common = fmin(greatest_a, greatest_b) - fmax(least_a, least_b);
        double narrower = fmin(greatest_a - least_a, greatest_b - least_b);
        if (!(common > fmax(tolerance, 0.01 * narrower)))
            return true;
    }
    return false;
}

bool lint_faces_coincide(const struct lint_face *a, const struct lint_face *b, double near,
                         double tolerance) {
    if (!lies_near(&b->t, a->t.p[0], a->normal, near) || !lies_near(&a->t, b->t.p[0], b->normal, near))
        return false;
    if (vec3_is_zero(a->normal) || vec3_is_zero(b->normal))
        return false;
    return !is_parted(&a->t, &b->t, a->normal, tolerance) && !is_parted(&b->t, &a->t, b->normal, tolerance);
}

// ---- points and rays

static double segment_distance(vec3 a, vec3 b, vec3 point) {
    vec3 along = vec3_sub(b, a);
    double square = vec3_dot(along, along);
    double t = square > 0 ? vec3_dot(vec3_sub(point, a), along) / square : 0;
    t = fmin(1, fmax(0, t));
    return vec3_length(vec3_sub(point, vec3_add(a, vec3_mul(along, t))));
}

double lint_triangle_distance(const struct lint_triangle *t, vec3 point) {
    vec3 normal = vec3_unit(normal_of(t));
    if (!vec3_is_zero(normal) && is_inside(t, normal, point, 0))
        return fabs(vec3_dot(normal, vec3_sub(point, t->p[0])));
    double least = INFINITY;
    for (int k = 0; k < 3; k++)
        least = fmin(least, segment_distance(t->p[k], t->p[(k + 1) % 3], point));
    return least;
}

bool lint_triangle_ray(const struct lint_triangle *triangle, vec3 origin, vec3 direction, double *t,
                       int *side) {
    vec3 a = vec3_sub(triangle->p[0], origin);
    vec3 b = vec3_sub(triangle->p[1], origin);
    vec3 c = vec3_sub(triangle->p[2], origin);
    double u = vec3_dot(direction, vec3_cross(b, c));
    double v = vec3_dot(direction, vec3_cross(c, a));
    double w = vec3_dot(direction, vec3_cross(a, b));
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0))
        return false;
    double sum = u + v + w;
    if (sum == 0)
        return false;
    *t = vec3_dot(a, vec3_cross(b, c)) / sum;
    *side = sum > 0 ? 1 : -1;
    return true;
}
