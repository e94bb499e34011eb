// What a ray hit, and where light that leaves it comes from (docs/language.md, "Hit" and "Checker").
#include "core/angle.h"
#include "reference/exact.h"
#include "reference/reference_internal.h"

#include "scene/shape.h"
#include "scene/transform.h"

static vec3 vertex(const struct primitive *p, int k) {
    return (vec3){p->v[k][0], p->v[k][1], p->v[k][2]};
}

static vec3 weighted(const vec3 corners[3], const double b[3]) {
    return vec3_add(vec3_add(vec3_mul(corners[0], b[0]), vec3_mul(corners[1], b[1])),
                    vec3_mul(corners[2], b[2]));
}

// ---- materials

// Parity of a sum of whole numbers too large for any integer type.
static bool is_odd(double cells) {
    return fmod(cells, 2) != 0;
}

static double cell_of(double place, double size) {
    return floor(place / size);
}

// The size of the numbers from which a device computes a place on the checker: those of the hit, in the
// checker's units; for a parallelogram, the length of its edges.
static double checker_error(const struct reference *r, const struct scene_body *body, const struct surface *s,
                            vec3 place) {
    if (!r->input.as_single)
        return 0;
    if (shape_traits(body->shape).is_flat)
        return fmax(vec3_length(mat3_column(body->object_to_world.linear, 0)) * body->cells->scale.x,
                    vec3_length(mat3_column(body->object_to_world.linear, 1)) * body->cells->scale.y);
    const vec3 offset = vec3_sub(body->object_to_world.offset, r->origin);
    const double reach = vec3_length(vec3_sub(s->point, offset));
    return (vec3_max_abs(s->point) + vec3_max_abs(offset)) * (reach > 0 ? vec3_length(place) / reach : 1);
}

static void take_material(const struct reference *r, const struct scene_body *body, const double b[3],
                          vec3 arm, struct surface *s) {
    s->material = scene_body_material(body, s->triangle);
    const struct material *m = &r->materials[s->material];
    bool odd = false;
    if (m->is->checker) {
        const vec3 exact = reference_checker_place(body, s, b, arm);
        const vec3 at = reference_rounded3(r, exact, checker_error(r, body, s, exact));
        const double cell = m->is->cell;
        odd = is_odd(cell_of(at.x, cell) + cell_of(at.y, cell) + cell_of(at.z, cell));
    }
    s->is = m->is;
    s->diffuse = m->diffuse[odd];
    s->specular = m->specular;
    s->index = m->is->refractive_index;
    s->alpha = m->is->alpha;
    s->solid = body->closed;
}

// ---- normals

// The interpolated unit normal on the side of the geometric one; the geometric one where the normals cancel.
static vec3 smooth_normal(const struct body *body, const struct surface *s, const double b[3]) {
    vec3 normals[3];
    for (int k = 0; k < 3; k++)
        normals[k] =
            vec3_unit(mat3_apply(body->normal_map, body->normals[3 * (size_t)s->triangle + (size_t)k]));
    vec3 n = vec3_unit(weighted(normals, b));
    if (vec3_is_zero(n))
        return s->geometric;
    return vec3_dot(n, s->geometric) < 0 ? vec3_neg(n) : n;
}

static void turn_to_ray(struct surface *s, vec3 outward, vec3 direction) {
    s->enters = vec3_dot(outward, direction) <= 0;
    s->geometric = s->enters ? outward : vec3_neg(outward);
    s->shading = s->geometric;
}

// ---- surfaces

static void sphere_surface(const struct reference *r, const struct ray *ray, const struct primitive *p,
                           const struct body *body, struct surface *s, vec3 *arm) {
    vec3 centre = vertex(p, 0);
    vec3 at = vec3_add(ray->start.at, vec3_mul(ray->direction, s->distance));
    // The error of a place on the ray grows with its distance.
    at = reference_rounded3(r, at, vec3_max_abs(at));
    vec3 outward = reference_rounded3(r, vec3_unit(vec3_sub(at, centre)), 1);
    // Back onto the sphere: the error is then that of the radius, whatever the ray's length.
    const vec3 from_centre = vec3_mul(outward, p->v[1][0]);
    s->point = vec3_add(centre, from_centre);
    s->point = reference_rounded3(r, s->point, 0);
    s->error = vec3_add(vec3_mul(vec3_abs(from_centre), reference_gamma(r, 5)),
                        vec3_mul(vec3_abs(s->point), reference_gamma(r, 1)));
    turn_to_ray(s, outward, ray->direction);
    s->bend = (s->enters ? 1 : -1) / p->v[1][0];
    *arm = shape_into_frame(body->is, from_centre);
}

// `arm`: in the cone's own axes, from its beginning.
static void cone_surface(const struct reference *r, const struct ray *ray, const struct body *body,
                         const struct primitive *p, struct surface *s, vec3 *arm) {
    const struct shape_cone cone = reference_cone_of(p);
    const enum reference_face face = reference_face(s);
    const vec3 at = vec3_add(vec3_sub(ray->start.at, cone.from), vec3_mul(ray->direction, s->distance));
    const vec3 found = reference_rounded3(r, at, vec3_max_abs(at));
    const double y = vec3_dot(found, cone.axis);
    const double height = face == REFERENCE_FROM ? 0
                          : face == REFERENCE_TO ? cone.height
                                                 : fmin(fmax(y, 0), cone.height);
    const vec3 across = vec3_sub(found, vec3_mul(cone.axis, y)), away = vec3_unit(across);
    const double rise = cone.radius_to - cone.radius, radius = cone.radius + rise * (height / cone.height);
    vec3 outward = face == REFERENCE_FROM ? vec3_neg(cone.axis) : cone.axis;
    // The side is at right angles to (rise, height) in the half-plane of the axis and the place.
    if (face == REFERENCE_SIDE)
        outward = vec3_unit(vec3_sub(vec3_mul(away, cone.height), vec3_mul(cone.axis, rise)));
    outward = reference_rounded3(r, outward, 1);
    const double reach = face == REFERENCE_SIDE ? radius : fmin(vec3_length(across), radius);
    const vec3 place = vec3_add(vec3_mul(cone.axis, height), vec3_mul(away, reach));
    s->point = reference_rounded3(r, vec3_add(cone.from, place), 0);
    const double error = (cone.height + radius) * reference_gamma(r, 6);
    s->error = vec3_add((vec3){error, error, error}, vec3_mul(vec3_abs(s->point), reference_gamma(r, 1)));
    // By the end of the way inside, not by the normal, which rounding may have turned away from a grazing
    // ray.
    s->enters = s->b2 > 0.5;
    s->geometric = s->enters ? outward : vec3_neg(outward);
    const vec3 unit = vec3_unit(ray->direction);
    const double along = vec3_dot(unit, s->geometric);
    if (along > 0)
        s->geometric = vec3_unit(vec3_sub(s->geometric, vec3_mul(unit, along)));
    s->shading = s->geometric;
    if (face == REFERENCE_SIDE && radius > 0)
        s->bend = (s->enters ? 0.5 : -0.5) * cone.height / (radius * hypot(cone.height, rise));
    *arm = shape_into_frame(body->is, place);
}

// How fast the normals turn from corner to corner, the mean over the edges (Akenine-Moeller et al. 2021,
// section 3).
static double bend_of(const struct body *body, const struct surface *s, const vec3 corners[3]) {
    double sum = 0;
    vec3 normals[3];
    for (int k = 0; k < 3; k++) {
        normals[k] =
            vec3_unit(mat3_apply(body->normal_map, body->normals[3 * (size_t)s->triangle + (size_t)k]));
        if (vec3_dot(normals[k], s->geometric) < 0)
            normals[k] = vec3_neg(normals[k]);
    }
    for (int k = 0; k < 3; k++) {
        const vec3 edge = vec3_sub(corners[(k + 1) % 3], corners[k]);
        const double length2 = vec3_dot(edge, edge);
        if (length2 > 0)
            sum += vec3_dot(vec3_sub(normals[(k + 1) % 3], normals[k]), edge) / length2;
    }
    return sum / 3;
}

static void triangle_surface(const struct reference *r, const struct body *body, const struct ray *ray,
                             const struct primitive *p, const double b[3], struct surface *s) {
    vec3 corners[3] = {vertex(p, 0), vertex(p, 1), vertex(p, 2)};
    vec3 sizes[3];
    for (int k = 0; k < 3; k++)
        sizes[k] = vec3_abs(corners[k]);
    const double positive[3] = {fabs(b[0]), fabs(b[1]), fabs(b[2])};
    s->point = weighted(corners, b);
    s->point = reference_rounded3(r, s->point, vec3_max_abs(s->point));
    s->error =
        vec3_mul(r->input.as_single ? vec3_abs(s->point) : weighted(sizes, positive), reference_gamma(r, 7));
    const vec3 outward = reference_rounded3(r, exact_normal(p), 1);
    turn_to_ray(s, body->is->mirrored ? vec3_neg(outward) : outward, ray->direction);
    if (body->normals)
        s->shading = reference_rounded3(r, smooth_normal(body, s, b), 1);
    if (body->normals)
        s->bend = bend_of(body, s, corners);
}

void reference_surface(const struct reference *r, const struct ray *ray, const struct intersection *hit,
                       struct surface *out) {
    struct primitive room;
    const struct primitive *p = reference_primitive(r, hit->primitive, &room);
    const struct body *body = &r->bodies[p->body];
    const double b1 = reference_rounded(r, hit->b1, 1), b2 = reference_rounded(r, hit->b2, 1);
    const double b[3] = {fmax(1 - b1 - b2, 0), fmax(b1, 0), fmax(b2, 0)};
    vec3 arm = {0, 0, 0};
    *out = (struct surface){.primitive = hit->primitive,
                            .body = p->body,
                            .triangle = p->triangle,
                            .distance = hit->t,
                            .b1 = b[1],
                            .b2 = b[2]};
    if (p->is_sphere)
        sphere_surface(r, ray, p, body, out, &arm);
    else if (p->is_cone)
        cone_surface(r, ray, body, p, out, &arm);
    else
        triangle_surface(r, body, ray, p, b, out);
    take_material(r, body->is, b, arm, out);
    out->facet = out->shading;
    out->width = ray->cone.width + ray->cone.spread * hit->t;
    if (scene_material_is_painted(out->is))
        reference_paint(r, ray, b, arm, out);
}

// ---- rays that leave

static vec3 mirror(vec3 d, vec3 n) {
    return vec3_sub(d, vec3_mul(n, 2 * vec3_dot(d, n)));
}

// Samples a height of the unit sphere's cap that the stretched ray sees (Dupuy and Benyoub 2023): the facets
// are those of GGX.
void reference_roughen(const struct reference *r, struct surface *s, vec3 direction,
                       const struct points *points, uint32_t key) {
    if (points->bits == 0)
        s->alpha = 0;
    if (s->alpha == 0)
        return;
    const vec3 n = vec3_dot(direction, s->shading) < 0 ? s->shading : s->geometric;
    vec3 a, b;
    double u, v;
    reference_frame(n, &a, &b);
    points_at(points, point_key(key, POINT_ROUGH), &u, &v);
    const vec3 ray = vec3_neg(direction);
    const vec3 seen =
        vec3_unit((vec3){s->alpha * vec3_dot(ray, a), s->alpha * vec3_dot(ray, b), vec3_dot(ray, n)});
    const double height = (1 - v) * (1 + seen.z) - seen.z, angle = 2 * PI * u;
    const double ring = sqrt(fmax(1 - height * height, 0));
    const vec3 half_way = vec3_add(seen, (vec3){ring * cos(angle), ring * sin(angle), height});
    const vec3 facet =
        vec3_unit((vec3){s->alpha * half_way.x, s->alpha * half_way.y, fmax(half_way.z, 1e-12)});
    const vec3 across = vec3_add(vec3_mul(a, facet.x), vec3_mul(b, facet.y));
    s->facet = reference_rounded3(r, vec3_unit(vec3_add(across, vec3_mul(n, facet.z))), 1);
}

vec3 reference_mirrored(const struct reference *r, const struct surface *s, vec3 direction) {
    vec3 out = mirror(direction, s->facet);
    // A ray that would go through the surface is turned back by another facet.
    if (s->alpha > 0 && vec3_dot(out, s->geometric) < 0)
        out = mirror(out, s->geometric);
    if (vec3_dot(out, s->geometric) <= 0)
        out = mirror(direction, s->geometric);
    return reference_rounded3(r, vec3_unit(out), 1);
}

// The cosine of a ray to the normal, and the squared cosine behind the surface: below 0 nothing comes
// through.
struct angles {
    double c, k;
};

static struct angles bend(vec3 d, vec3 n, double eta, vec3 *out) {
    const double c = -vec3_dot(d, n);
    const double k = 1 - eta * eta * (1 - c * c);
    if (k >= 0)
        *out = vec3_add(vec3_mul(d, eta), vec3_mul(n, eta * c - sqrt(k)));
    return (struct angles){c, k};
}

static double square(double x) {
    return x * x;
}

// A pane has two such faces, between which light goes back and forth.
static double of_faces(double one, bool pane) {
    return pane ? 2 * one / (1 + one) : one;
}

// For unpolarised light from index n to m (Fresnel 1823; Born and Wolf 1999, section 1.5.2).
static double fresnel(double n, double m, struct angles at, bool pane) {
    if (n == m)
        return 0;
    if (at.k <= 0)
        return 1;
    const double t = sqrt(at.k);
    const double across = square((n * at.c - m * t) / (n * at.c + m * t));
    const double along = square((m * at.c - n * t) / (m * at.c + n * t));
    return (of_faces(across, pane) + of_faces(along, pane)) / 2;
}

// From the thinner side, whichever side the ray comes from: as for light that was bent on its way in.
double reference_shine(const struct surface *s, vec3 direction) {
    if (!s->is->fresnel)
        return s->is->refraction;
    const double low = fmin(s->index_before, s->index_after), high = fmax(s->index_before, s->index_after);
    double c = -vec3_dot(direction, s->shading);
    if (c <= 0)
        c = -vec3_dot(direction, s->geometric);
    const struct angles at = {c, 1 - square(low / high) * (1 - c * c)};
    return s->is->refraction * (1 - fresnel(low, high, at, !s->solid));
}

void reference_split(const struct reference *r, const struct surface *s, vec3 direction, struct split *out) {
    const double eta = s->index_before / s->index_after;
    const bool flat = vec3_dot(direction, s->facet) >= 0;
    vec3 bent = direction;
    struct angles at = bend(direction, flat ? s->geometric : s->facet, eta, &bent);
    if (s->alpha > 0 && at.k >= 0 && vec3_dot(bent, s->geometric) > 0)
        bent = mirror(bent, s->geometric);
    if (at.k >= 0 && vec3_dot(bent, s->geometric) >= 0)
        at = bend(direction, s->geometric, eta, &bent);
    const bool straight = !s->solid || eta == 1;
    *out = (struct split){.bent = straight ? direction : reference_rounded3(r, vec3_unit(bent), 1),
                          .through = straight || at.k >= 0};
    if (s->alpha > 0 && !s->solid)
        out->bent = mirror(reference_mirrored(r, s, direction), s->geometric);
    if (s->is->fresnel)
        out->reflected = fresnel(s->index_before, s->index_after, at, !s->solid && s->is->refraction > 0);
}

double reference_reflection(const struct surface *s, const struct split *split) {
    if (s->is->fresnel)
        return s->is->reflection * split->reflected;
    return s->is->refraction > 0 && !split->through ? s->is->reflection + s->is->refraction
                                                    : s->is->reflection;
}

// Schlick 1994: a metal mirrors its colour straight on, and white at a right angle to that.
static vec3 metal(vec3 color, double c) {
    const double grazing = pow(fmin(fmax(1 - c, 0), 1), 5);
    return vec3_add(color, vec3_mul(vec3_sub((vec3){1, 1, 1}, color), grazing));
}

vec3 reference_mirror_color(const struct surface *s, vec3 direction, const struct split *split) {
    const struct scene_material *m = s->is;
    const double facing = -vec3_dot(direction, s->facet);
    const vec3 color =
        m->metal ? metal(m->mirror, facing > 0 ? facing : -vec3_dot(direction, s->geometric)) : m->mirror;
    if (m->fresnel || split->through || !(m->refraction > 0))
        return color;
    // What would have been refracted is turned back as it is.
    const vec3 both = vec3_add(vec3_mul(color, m->reflection), vec3_mul((vec3){1, 1, 1}, m->refraction));
    return vec3_mul(both, 1 / (m->reflection + m->refraction));
}

double reference_refraction(const struct surface *s, const struct split *split) {
    if (!split->through)
        return 0;
    return s->is->fresnel ? s->is->refraction * (1 - split->reflected) : s->is->refraction;
}
