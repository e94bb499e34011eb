// What a ray hits: boxes, triangles, spheres, cones.
#include "reference/exact.h"
#include "reference/reference_internal.h"
#include "scene/shape.h"

#include <assert.h>

// A box is entered a little earlier and left a little later than its planes say: by more than the rounding of
// (plane - origin) / direction, as in Ize 2013, "Robust BVH Ray Traversal", but wider, because it costs
// nothing.
#define BOX_SLACK 0x1p-48
// Error of a start on a triangle, as a fraction of its coordinates: the rounding of the place and the
// distance that the start is moved from it (ray_offset.c).
#define START_ERROR 0x1p-47

// ---- triangles

struct sheared {
    int kx, ky, kz; // kz: the largest component of the direction
    double sx, sy, sz;
    double origin[3];
    double direction[3];
    double slack; // bound of the origin's error, by component
};

static struct sheared shear(const struct ray *ray, double unit) {
    struct sheared s = {.origin = {ray->start.at.x, ray->start.at.y, ray->start.at.z},
                        .direction = {ray->direction.x, ray->direction.y, ray->direction.z}};
    const double *d = s.direction;
    s.kz = fabs(d[0]) > fabs(d[1]) ? (fabs(d[0]) > fabs(d[2]) ? 0 : 2) : (fabs(d[1]) > fabs(d[2]) ? 1 : 2);
    s.kx = (s.kz + 1) % 3;
    s.ky = (s.kz + 2) % 3;
    s.sz = 1 / d[s.kz];
    s.sx = d[s.kx] * s.sz;
    s.sy = d[s.ky] * s.sz;
    if (ray->start.left != NO_PRIMITIVE)
        s.slack = START_ERROR * unit * vec3_max_abs(ray->start.at);
    return s;
}

static double largest_of(double a, double b, double c) {
    return reference_larger(fabs(a), reference_larger(fabs(b), fabs(c)));
}

// Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection"; the bound of t: Pharr, Jakob, Humphreys
// 2023, section 6.8.7, without its factor for the ray's length, which double does not need. *open: double
// precision cannot decide whether the hit lies in front of the ray's start or behind it, or where on the ray.
static bool intersect_watertight(const struct sheared *s, const struct primitive *p, struct intersection *out,
                                 bool *open) {
    double x[3], y[3], z[3];
    for (int k = 0; k < 3; k++) {
        double depth = p->v[k][s->kz] - s->origin[s->kz];
        x[k] = p->v[k][s->kx] - s->origin[s->kx] - s->sx * depth;
        y[k] = p->v[k][s->ky] - s->origin[s->ky] - s->sy * depth;
        z[k] = depth * s->sz;
    }
    double u = x[2] * y[1] - y[2] * x[1];
    double v = x[0] * y[2] - y[0] * x[2];
    double w = x[1] * y[0] - y[1] * x[0];
    double x_most = largest_of(x[0], x[1], x[2]);
    double y_most = largest_of(y[0], y[1], y[2]);
    double z_most = largest_of(z[0], z[1], z[2]) * fabs(s->direction[s->kz]);
    double x_error = REFERENCE_GAMMA(5) * (x_most + z_most) + 2 * s->slack;
    double y_error = REFERENCE_GAMMA(5) * (y_most + z_most) + 2 * s->slack;
    double edge_error = 2 * (REFERENCE_GAMMA(2) * x_most * y_most + y_error * x_most + x_error * y_most);
    *open = false;
    if ((u < -edge_error || v < -edge_error || w < -edge_error) &&
        (u > edge_error || v > edge_error || w > edge_error))
        return false;
    bool inside = !((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0));
    double det = u + v + w;
    double first = reference_smaller(z[0], reference_smaller(z[1], z[2]));
    double last = reference_larger(z[0], reference_larger(z[1], z[2]));
    double depth_error = (6 * REFERENCE_GAMMA(3) * z_most + s->slack) * fabs(s->sz);
    bool edge_on = !(fabs(det) > 3 * edge_error);
    if (edge_on) {
        *open = last + depth_error >= 0;
        return false;
    }
    // An error of the weights moves t by at most the spread of the corners.
    out->t = (u * z[0] + v * z[1] + w * z[2]) / det;
    out->b1 = v / det;
    out->b2 = w / det;
    out->t_error = depth_error + (last - first) * (3 * edge_error / fabs(det));
    *open = fabs(out->t) <= out->t_error;
    return inside && out->t > out->t_error;
}

// Möller, Trumbore 1997, "Fast, Minimum Storage Ray-Triangle Intersection".
static bool intersect_moeller_trumbore(const struct ray *ray, const struct primitive *p,
                                       struct intersection *out) {
    vec3 v0 = {p->v[0][0], p->v[0][1], p->v[0][2]};
    vec3 e1 = vec3_sub((vec3){p->v[1][0], p->v[1][1], p->v[1][2]}, v0);
    vec3 e2 = vec3_sub((vec3){p->v[2][0], p->v[2][1], p->v[2][2]}, v0);
    vec3 h = vec3_cross(ray->direction, e2);
    double det = vec3_dot(e1, h);
    if (det == 0)
        return false;
    vec3 s = vec3_sub(ray->start.at, v0);
    vec3 q = vec3_cross(s, e1);
    out->b1 = vec3_dot(s, h) / det;
    out->b2 = vec3_dot(ray->direction, q) / det;
    out->t = vec3_dot(e2, q) / det;
    out->t_error = 0;
    return out->b1 >= 0 && out->b2 >= 0 && out->b1 + out->b2 <= 1 && out->t > 0;
}

// ---- spheres

// Haines, Günther, Akenine-Möller 2019, "Precision Improvements for Ray/Sphere Intersection" (Ray Tracing
// Gems, chapter 7). A root within its own error of 0 is where the ray left the sphere.
static bool intersect_sphere(const struct reference *r, const struct ray *ray, const struct primitive *p,
                             struct intersection *out) {
    vec3 f = vec3_sub(ray->start.at, (vec3){p->v[0][0], p->v[0][1], p->v[0][2]});
    vec3 d = ray->direction;
    double radius = p->v[1][0];
    double a = vec3_dot(d, d);
    double b = -vec3_dot(f, d);
    vec3 nearest = vec3_add(f, vec3_mul(d, b / a));
    double distance2 = vec3_dot(nearest, nearest);
    double discriminant = (radius - sqrt(distance2)) * (radius + sqrt(distance2));
    if (discriminant < 0)
        return false;
    double root = sqrt(a * discriminant);
    double q = b < 0 ? b - root : b + root;
    if (q == 0)
        return false;
    double length2 = vec3_dot(f, f);
    double c = length2 - radius * radius;
    double c_error = reference_gamma(r, 6) * length2 + reference_gamma(r, 2) * radius * radius;
    double b_error = reference_gamma(r, 4) * (fabs(f.x * d.x) + fabs(f.y * d.y) + fabs(f.z * d.z));
    double t[2] = {c / q, q / a};
    double error[2] = {c_error / fabs(q), b_error / a};
    int order = t[0] <= t[1] ? 0 : 1;
    for (int i = 0; i < 2; i++, order = 1 - order) {
        if (!(t[order] > error[order]))
            continue;
        *out = (struct intersection){.t = t[order], .t_error = error[order]};
        return true;
    }
    return false;
}

// ---- cones

// A ray that left the cone outward never meets it again, because it is convex, and one that left it inward
// always does.
static bool intersect_cone(const struct reference *r, const struct ray *ray, const struct primitive *p,
                           uint32_t index, struct intersection *out) {
    const struct shape_cone cone = reference_cone_of(p);
    const bool is_left = ray->start.cone == index, inward = is_left && ray->start.inward;
    double t[2] = {0, 0};
    bool side[2] = {true, true};
    if (is_left && !inward)
        return false;
    if (!shape_cone_crossing(&cone, ray->start.at, ray->direction, t, side)) {
        if (!inward)
            return false;
        t[1] = 0;
        side[1] = true;
    }
    const int k = inward || !(t[0] > 0);
    const bool along = vec3_dot(ray->direction, cone.axis) > 0;
    if (!inward && !(t[k] > 0))
        return false;
    const double numbers = vec3_length(vec3_sub(ray->start.at, cone.from));
    *out = (struct intersection){.t = fmax(t[k], 0),
                                 .t_error = reference_gamma(r, 6) * numbers / vec3_length(ray->direction),
                                 .b1 = side[k]             ? REFERENCE_SIDE
                                       : along == (k == 1) ? REFERENCE_TO
                                                           : REFERENCE_FROM,
                                 .b2 = k == 0};
    return true;
}

// ---- the tree

enum {
    TIES_MOST = 8
};

struct search {
    const struct reference *r;
    const struct ray *ray;
    struct sheared sheared;
    struct exact_ray exact;
    bool exact_begun;
    bool any;
    struct intersection nearest;
    double end; // nothing farther away matters
    // Intersections that rounding cannot distinguish from the nearest: faces in the same plane, edges that
    // touch.
    struct intersection ties[TIES_MOST];
    int tie_count;
};

static bool is_lower(const struct search *s, uint32_t x, uint32_t y) {
    struct primitive rooms[2];
    const struct primitive *a = reference_primitive(s->r, x, &rooms[0]);
    const struct primitive *b = reference_primitive(s->r, y, &rooms[1]);
    return a->body != b->body ? a->body < b->body : a->triangle < b->triangle;
}

static bool is_tie(const struct search *s, const struct intersection *hit) {
    return hit->t - hit->t_error <= s->nearest.t + s->nearest.t_error;
}

// Adds a hit to the ties, in order of (body, triangle), and drops hits that are no longer ties.
static void take(struct search *s, const struct intersection *hit) {
    if (s->nearest.primitive == NO_PRIMITIVE || hit->t < s->nearest.t) {
        s->nearest = *hit;
        s->end = hit->t + hit->t_error;
    } else if (!is_tie(s, hit)) {
        return;
    }
    struct intersection kept[TIES_MOST + 1];
    int count = 0;
    bool placed = false;
    for (int i = 0; i < s->tie_count; i++) {
        if (!is_tie(s, &s->ties[i]))
            continue;
        if (!placed && is_lower(s, hit->primitive, s->ties[i].primitive)) {
            kept[count++] = *hit;
            placed = true;
        }
        kept[count++] = s->ties[i];
    }
    if (!placed)
        kept[count++] = *hit;
    s->tie_count = count < TIES_MOST ? count : TIES_MOST;
    for (int i = 0; i < s->tie_count; i++)
        s->ties[i] = kept[i];
}

static bool intersect_triangle(struct search *s, const struct primitive *p, struct intersection *hit) {
    bool open;
    const bool is_hit = intersect_watertight(&s->sheared, p, hit, &open);
    if (is_hit && s->r->input.as_single)
        open = hit->t <= 2 * exact_blur(p, s->ray->direction, REFERENCE_SINGLE);
    if (!open)
        return is_hit;
    if (!s->exact_begun)
        exact_begin(s->r, s->ray, (const int[3]){s->sheared.kx, s->sheared.ky, s->sheared.kz}, &s->exact);
    s->exact_begun = true;
    return exact_intersect(&s->exact, p, hit);
}

static void test_primitive(struct search *s, uint32_t index, const struct primitive *p) {
    struct intersection hit = {0};
    bool is_hit = p->is_sphere ? intersect_sphere(s->r, s->ray, p, &hit)
                  : p->is_cone ? intersect_cone(s->r, s->ray, p, index, &hit)
                  : s->r->input.test == REFERENCE_MOELLER_TRUMBORE
                      ? intersect_moeller_trumbore(s->ray, p, &hit)
                      : index != s->ray->start.left && intersect_triangle(s, p, &hit);
    // A hit that may lie at t_max itself is not strictly before it.
    if (!is_hit || hit.t + hit.t_error >= s->ray->t_max)
        return;
    hit.primitive = index;
    if (s->r->input.as_single && !p->is_sphere && !p->is_cone)
        hit.t_error = fmax(hit.t_error, exact_blur(p, s->ray->direction, REFERENCE_SINGLE));
    take(s, &hit);
}

// Comparisons let NaN pass: 0 times infinity, where the ray lies in a face of the box.
static bool enters(const struct search *s, const struct tree_ray *ray, const struct tree_node *node,
                   double *near) {
    double first = 0;
    double last = s->end;
    for (int a = 0; a < 3; a++) {
        bool backwards = ray->inverse[a] < 0;
        double lower = (node->lower[a] - ray->at_lower[a]) * ray->inverse[a];
        double upper = (node->upper[a] - ray->at_upper[a]) * ray->inverse[a];
        double in = backwards ? upper : lower;
        double out = backwards ? lower : upper;
        if (in > first)
            first = in;
        if (out < last)
            last = out;
    }
    *near = first;
    return first <= last + fabs(last) * BOX_SLACK;
}

static void search_tree(struct search *s, const struct tree_ray *ray);

static void search_instance(struct search *s, const struct instance *instance) {
    struct tree_ray ray;
    reference_to_mesh(s->r, instance, s->sheared.origin, s->sheared.direction, &ray);
    search_tree(s, &ray);
}

static void test_shared(struct search *s, const struct instance *instance, uint32_t triangle) {
    struct primitive p;
    if (reference_make_primitive(s->r, &s->r->bodies[instance->body], triangle, &p))
        test_primitive(s, instance->first + triangle, &p);
}

static void test_leaf(struct search *s, const struct instance *instance, const struct tree_node *leaf) {
    for (uint32_t i = leaf->second; i < leaf->second + leaf->count; i++) {
        if (instance)
            test_shared(s, instance, s->r->shared_meshes[instance->mesh].order[i]);
        else if (s->r->primitives[i].is_instance)
            search_instance(s, &s->r->instances[s->r->primitives[i].triangle]);
        else
            test_primitive(s, i, &s->r->primitives[i]);
    }
}

// Recurses once: an instance is a leaf of the scene's tree.
static void search_tree(struct search *s, const struct tree_ray *ray) {
    struct {
        uint32_t node;
        double near;
    } stack[TREE_STACK];
    int count = 0;
    uint32_t at = 0;
    double near;
    if (!enters(s, ray, &ray->nodes[0], &near))
        return;
    for (;;) {
        const struct tree_node *node = &ray->nodes[at];
        bool goes_on = false;
        if (node->count) {
            test_leaf(s, ray->instance, node);
            if (s->any && s->tie_count)
                return;
        } else {
            uint32_t children[2] = {at + 1, node->second};
            double nears[2];
            bool hits[2];
            for (int i = 0; i < 2; i++)
                hits[i] = enters(s, ray, &ray->nodes[children[i]], &nears[i]);
            int nearer = hits[0] && (!hits[1] || nears[0] <= nears[1]) ? 0 : 1;
            goes_on = hits[nearer];
            at = children[nearer];
            if (hits[0] && hits[1]) {
                assert(count < TREE_STACK);
                stack[count].node = children[1 - nearer];
                stack[count++].near = nears[1 - nearer];
            }
        }
        while (!goes_on) {
            if (count == 0)
                return;
            at = stack[--count].node;
            goes_on = stack[count].near <= s->end + s->end * BOX_SLACK;
        }
    }
}

static void search_scene(struct search *s) {
    struct tree_ray ray = {.nodes = s->r->nodes};
    for (int a = 0; a < 3; a++) {
        ray.at_lower[a] = ray.at_upper[a] = s->sheared.origin[a];
        ray.inverse[a] = 1 / s->sheared.direction[a];
    }
    search_tree(s, &ray);
}

// At equal distance the lower (body, triangle): the first of the ties.
static void search(const struct reference *r, const struct ray *ray, bool any, struct intersection *out) {
    // Not cleared as a whole: ties and wide numbers are large, and most rays need none.
    struct search s;
    s.r = r;
    s.ray = ray;
    s.sheared = shear(ray, reference_unit(r));
    s.exact_begun = false;
    s.any = any;
    s.nearest.primitive = NO_PRIMITIVE;
    s.end = ray->t_max;
    s.tie_count = 0;
    if (r->input.no_tree)
        for (uint32_t i = 0; i < r->primitive_count && !(any && s.tie_count); i++)
            test_primitive(&s, i, &r->primitives[i]);
    else if (r->primitive_count)
        search_scene(&s);
    *out = s.tie_count ? s.ties[0] : (struct intersection){.t = ray->t_max, .primitive = NO_PRIMITIVE};
}

void reference_intersect(const struct reference *r, const struct ray *ray, struct intersection *out) {
    search(r, ray, false, out);
}

bool reference_blocks(const struct reference *r, const struct ray *ray) {
    struct intersection hit;
    search(r, ray, true, &hit);
    return hit.primitive != NO_PRIMITIVE;
}
