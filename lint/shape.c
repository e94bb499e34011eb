#include "lint/shape.h"

// A triangle that reaches through another by less than this fraction of its size does not cross it: rounded
// corners of neighbours reach that far.
static const double SHALLOW = 0.001;
// Planes at a smaller angle count as parallel: rounding alone would decide where they intersect.
static const double PARALLEL_SINE = 1e-6;

// ---- boxes and places

bool lint_box_holds(const struct lint_box *box, vec3 point) {
    return point.x >= box->lower.x && point.x <= box->upper.x && point.y >= box->lower.y &&
           point.y <= box->upper.y && point.z >= box->lower.z && point.z <= box->upper.z;
}

struct lint_box lint_box_place(struct lint_box box, const affine3 *place) {
    struct lint_box placed = lint_box_empty();
    for (int i = 0; i < 8; i++) {
        vec3 corner = {i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                       i & 4 ? box.upper.z : box.lower.z};
        vec3 at = affine3_apply(*place, corner);
        placed = lint_box_join(placed, (struct lint_box){at, at});
    }
    return placed;
}

struct lint_triangle lint_triangle_place(struct lint_triangle triangle, const affine3 *place) {
    for (int k = 0; k < 3; k++)
        triangle.p[k] = affine3_apply(*place, triangle.p[k]);
    return triangle;
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

// The corners' distances from the plane, and how far the triangle reaches through it: the smaller of its two
// sides, not above 0 if it does not.
static double reach(const struct lint_triangle *t, const struct lint_face *plane, double d[3]) {
    for (int k = 0; k < 3; k++)
        d[k] = vec3_dot(plane->normal, vec3_sub(t->p[k], plane->t.p[0]));
    double most = d[0] > d[1] ? d[0] : d[1];
    double least = d[0] < d[1] ? d[0] : d[1];
    most = d[2] > most ? d[2] : most;
    least = d[2] < least ? d[2] : least;
    return most < -least ? most : -least;
}

bool lint_reaches_through(const struct lint_triangle *triangle, const struct lint_face *plane,
                          double tolerance) {
    double d[3];
    return reach(triangle, plane, d) > tolerance;
}

static double longest_edge(const struct lint_triangle *t) {
    double square = 0;
    for (int k = 0; k < 3; k++) {
        vec3 edge = vec3_sub(t->p[(k + 1) % 3], t->p[k]);
        square = fmax(square, vec3_dot(edge, edge));
    }
    return sqrt(square);
}

// The part of the two planes' intersection line that lies inside the triangle.
static void cut(const struct lint_triangle *t, const double d[3], vec3 along, vec3 origin, double *least,
                double *greatest) {
    *least = INFINITY;
    *greatest = -INFINITY;
    for (int k = 0; k < 3; k++) {
        double from = d[k];
        double to = d[(k + 1) % 3];
        if ((from > 0 && to > 0) || (from < 0 && to < 0) || from == to)
            continue;
        vec3 edge = vec3_sub(t->p[(k + 1) % 3], t->p[k]);
        vec3 at = vec3_add(t->p[k], vec3_mul(edge, from / (from - to)));
        double here = vec3_dot(along, vec3_sub(at, origin));
        *least = fmin(*least, here);
        *greatest = fmax(*greatest, here);
    }
}

bool lint_faces_cross(const struct lint_face *a, const struct lint_face *b, double tolerance) {
    double da[3];
    double db[3];
    double reach_a = reach(&a->t, b, da);
    if (!(reach_a > tolerance))
        return false;
    double reach_b = reach(&b->t, a, db);
    if (!(reach_b > tolerance))
        return false;
    double size_a = longest_edge(&a->t);
    double size_b = longest_edge(&b->t);
    vec3 along = vec3_cross(a->normal, b->normal);
    double sine = sqrt(vec3_dot(along, along));
    if (reach_a <= SHALLOW * size_a || reach_b <= SHALLOW * size_b || !(sine > PARALLEL_SINE))
        return false;
    double least_a, greatest_a, least_b, greatest_b;
    cut(&a->t, da, along, a->t.p[0], &least_a, &greatest_a);
    cut(&b->t, db, along, a->t.p[0], &least_b, &greatest_b);
    double common = fmin(greatest_a, greatest_b) - fmax(least_a, least_b);
    return common > sine * fmax(tolerance, SHALLOW * fmin(size_a, size_b));
}

// ---- lying in the same plane

static bool lies_near(const struct lint_triangle *t, vec3 at, vec3 unit_normal, double near) {
    for (int k = 0; k < 3; k++)
        if (!(fabs(vec3_dot(unit_normal, vec3_sub(t->p[k], at))) <= near))
            return false;
    return true;
}

static void project(const struct lint_triangle *t, vec3 axis, vec3 origin, double *least, double *greatest) {
    double a = vec3_dot(axis, vec3_sub(t->p[0], origin));
    double b = vec3_dot(axis, vec3_sub(t->p[1], origin));
    double c = vec3_dot(axis, vec3_sub(t->p[2], origin));
    *least = a < b ? a < c ? a : c : b < c ? b : c;
    *greatest = a > b ? a > c ? a : c : b > c ? b : c;
}

// Whether an edge of `a` separates them; an axis along which one is too narrow to decide counts as
// separating.
static bool is_parted(const struct lint_triangle *a, const struct lint_triangle *b, vec3 unit_normal,
                      double tolerance) {
    for (int k = 0; k < 3; k++) {
        vec3 axis = vec3_cross(unit_normal, vec3_sub(a->p[(k + 1) % 3], a->p[k]));
        double least_a, greatest_a, least_b, greatest_b;
        project(a, axis, a->p[0], &least_a, &greatest_a);
        project(b, axis, a->p[0], &least_b, &greatest_b);
        double end = greatest_a < greatest_b ? greatest_a : greatest_b;
        double common = end - (least_a > least_b ? least_a : least_b);
        double narrower = fmin(greatest_a - least_a, greatest_b - least_b);
        if (!(common > 0.01 * narrower) || !(common > tolerance * sqrt(vec3_dot(axis, axis))))
            return true;
    }
    return false;
}

bool lint_lies_near(const struct lint_triangle *triangle, const struct lint_face *plane, double near) {
    return lies_near(triangle, plane->t.p[0], plane->normal, near);
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
