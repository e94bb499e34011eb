// What a ray hit, and where light comes from that leaves it: shaders/surface.glsl and bounce.glsl in C.
#include "bench/embree/peer.h"

#include <embree3/rtcore.h>

// gamma(7) with u = 2^-24, as glint's own. Larger ones let more light through cracks and corners: pictures
// are nearest to glint's with this one.
static const float POINT_ERROR = 4.1723270e-7F;

static bool is_odd(float cells) {
    return cells - 2.0F * floorf(cells * 0.5F) != 0.0F;
}

static void take_material(const struct peer *peer, const struct peer_body *body, uint32_t number, float3 own,
                          struct peer_surface *s) {
    const struct peer_material *m = &peer->materials[number];
    const bool odd =
        m->checker && is_odd(floorf(own.x / m->cell) + floorf(own.y / m->cell) + floorf(own.z / m->cell));
    s->diffuse = m->diffuse[odd];
    s->specular = m->specular;
    s->exponent = m->exponent;
    s->reflection = m->reflection;
    s->refraction = m->refraction;
    s->index = m->index;
    s->solid = body->is->closed;
}

static void turn_to_ray(struct peer_surface *s, float3 outward, float3 direction) {
    s->enters = float3_dot(outward, direction) <= 0;
    s->geometric = s->enters ? outward : float3_neg(outward);
    s->shading = s->geometric;
}

static float3 mixed(const float3 *v, const float b[3]) {
    return float3_add(float3_add(float3_mul(v[0], b[0]), float3_mul(v[1], b[1])), float3_mul(v[2], b[2]));
}

static void smooth(const struct peer_body *body, uint32_t triangle, const float b[3],
                   struct peer_surface *s) {
    const float3 *n = body->normals + 3 * (size_t)triangle;
    float3 turned[3];
    for (int k = 0; k < 3 && body->instance; k++)
        turned[k] = float3_unit(float34_turn(&body->normal_map, n[k]));
    n = body->instance ? turned : n;
    const float3 sum = mixed(n, b);
    const float length2 = float3_dot(sum, sum);
    if (!(length2 > 0))
        return;
    const float3 unit = float3_mul(sum, 1.0F / sqrtf(length2));
    s->shading = float3_dot(unit, s->geometric) < 0 ? float3_neg(unit) : unit;
}

static float3 own_place(const struct peer_body *body, const struct peer_surface *s, uint32_t triangle,
                        const float b[3]) {
    if (body->is->shape != SCENE_PARALLELOGRAM)
        return float34_apply(&body->to_own, s->point);
    const float sum = b[1] + b[2];
    return (float3){(triangle ? b[1] : sum) * body->edge_u, (triangle ? sum : b[2]) * body->edge_v, 0};
}

static void triangle_surface(const struct peer *peer, const struct peer_body *body,
                             const struct RTCRayHit *found, float3 direction, struct peer_surface *s) {
    const uint32_t triangle = found->hit.primID;
    const uint32_t *corners = body->corners + (size_t)body->stride * triangle;
    const float b0 = 1.0F - found->hit.u - found->hit.v;
    const float b[3] = {b0 > 0 ? b0 : 0, found->hit.u, found->hit.v};
    float3 v[3], size[3];
    for (int k = 0; k < 3; k++) {
        v[k] = body->positions[corners[k]];
        v[k] = body->instance ? float34_apply(&body->to_world, v[k]) : v[k];
        size[k] = float3_abs(v[k]);
    }
    s->point = mixed(v, b);
    s->error = float3_mul(mixed(size, b), POINT_ERROR);
    const float3 normal = float3_unit(float3_cross(float3_sub(v[1], v[0]), float3_sub(v[2], v[0])));
    turn_to_ray(s, body->is->mirrored ? float3_neg(normal) : normal, direction);
    if (body->normals)
        smooth(body, triangle, b, s);
    const uint32_t material = scene_body_material(body->is, triangle);
    const bool checker = peer->materials[material].checker;
    take_material(peer, body, material, checker ? own_place(body, s, triangle, b) : s->point, s);
}

static void sphere_surface(const struct peer *peer, const struct RTCRayHit *found, float3 direction,
                           struct peer_surface *s) {
    const struct peer_sphere *sphere = &peer->spheres[found->hit.primID];
    const struct peer_body *body = &peer->bodies[sphere->body];
    const float3 origin = {found->ray.org_x, found->ray.org_y, found->ray.org_z};
    const float3 at = float3_add(origin, float3_mul(direction, found->ray.tfar));
    const float3 outward = float3_unit(float3_sub(at, sphere->center));
    const float3 arm = float3_mul(outward, sphere->radius);
    s->point = float3_add(sphere->center, arm);
    s->error = float3_mul(float3_add(float3_abs(arm), float3_abs(s->point)), POINT_ERROR);
    turn_to_ray(s, outward, direction);
    const uint32_t material = scene_body_material(body->is, 0);
    const bool checker = peer->materials[material].checker;
    take_material(peer, body, material, checker ? float34_apply(&body->to_own, s->point) : s->point, s);
}

void peer_surface(const struct peer *peer, const struct RTCRayHit *found, struct peer_surface *out) {
    const float3 direction = {found->ray.dir_x, found->ray.dir_y, found->ray.dir_z};
    const bool within = found->hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    const uint32_t number = within ? found->hit.instID[0] : found->hit.geomID;
    if (number == peer->scene->body_count)
        sphere_surface(peer, found, direction, out);
    else
        triangle_surface(peer, &peer->bodies[number], found, direction, out);
}

// ---- rays that leave

float3 peer_leave(const struct peer_surface *s, float3 side) {
    const float along = float3_dot(float3_abs(side), s->error), most = float3_largest(s->error);
    return float3_add(s->point, float3_mul(side, along > most ? along : most));
}

static float3 mirror(float3 d, float3 n) {
    return float3_sub(d, float3_mul(n, 2 * float3_dot(d, n)));
}

float3 peer_mirrored(const struct peer_surface *s, float3 direction) {
    const float3 out = mirror(direction, s->shading);
    return float3_unit(float3_dot(out, s->geometric) > 0 ? out : mirror(direction, s->geometric));
}

// k < 0: nothing comes through.
static float bend(float3 d, float3 n, float eta, float3 *out) {
    const float c = -float3_dot(d, n);
    const float k = 1 - eta * eta * (1 - c * c);
    if (k >= 0)
        *out = float3_add(float3_mul(d, eta), float3_mul(n, eta * c - sqrtf(k)));
    return k;
}

bool peer_bent(const struct peer_surface *s, float3 direction, float3 *out) {
    const float eta = s->enters ? 1 / s->index : s->index;
    *out = direction;
    if (!s->solid || eta == 1)
        return true;
    const bool flat = float3_dot(direction, s->shading) >= 0;
    float k = bend(direction, flat ? s->geometric : s->shading, eta, out);
    if (k >= 0 && float3_dot(*out, s->geometric) >= 0)
        k = bend(direction, s->geometric, eta, out);
    *out = float3_unit(*out);
    return k >= 0;
}
