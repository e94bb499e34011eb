// Which media a ray is inside (docs/language.md, "Media").
#include "core/heap.h"
#include "reference/reference_internal.h"

#include <stdlib.h>

enum {
    CROSSINGS_MOST = 1000000 // on the way to the camera
};

// ---- sets

// The medium that fills a place: the one with the highest priority, among equals the last one entered.
uint32_t reference_filling(const struct reference *r, const struct inside *inside) {
    uint32_t found = HIT_NONE;
    int32_t most = INT32_MIN;
    for (uint32_t i = 0; i < inside->count; i++) {
        const int32_t priority = r->materials[r->bodies[inside->bodies[i]].filling].is->priority;
        if (priority >= most) {
            found = inside->bodies[i];
            most = priority;
        }
    }
    return found;
}

static bool leave(struct inside *inside, uint32_t body) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < inside->count; i++)
        if (inside->bodies[i] != body)
            inside->bodies[kept++] = inside->bodies[i];
    const bool was_inside = kept < inside->count;
    inside->count = kept;
    return was_inside;
}

// false: there are too many.
static bool enter(struct inside *inside, uint32_t body) {
    if (inside->count == SCENE_MEDIA_MOST)
        return false;
    inside->bodies[inside->count++] = body;
    return true;
}

// ---- crossings

// The refractive index on one side; a body's own faces give the index of the body.
static double index_of(const struct reference *r, uint32_t medium, const struct surface *s) {
    if (medium == HIT_NONE)
        return 1;
    return medium == s->body ? s->index : r->materials[r->bodies[medium].filling].is->refractive_index;
}

static bool is_same(const struct reference *r, uint32_t a, uint32_t b) {
    const struct scene_material *all = r->input.scene->materials;
    if (a == HIT_NONE || b == HIT_NONE)
        return a == b;
    return a == b || scene_compare_media(&all[r->bodies[a].filling], &all[r->bodies[b].filling]) == 0;
}

// Without media: the side of the surface decides everything.
static void cross_alone(struct surface *s) {
    const bool leaves = s->solid && s->is->refraction > 0 && !s->enters;
    s->index_before = leaves ? s->index : 1;
    s->index_after = leaves ? 1 : s->index;
}

void reference_cross(const struct reference *r, const struct inside *before, struct surface *s) {
    s->after = *before;
    if (!r->media) {
        cross_alone(s);
        return;
    }
    struct inside around = *before; // what the ray is inside, without this body
    const bool was_inside = leave(&around, s->body);
    if (!s->solid || !(s->is->refraction > 0)) {
        s->index_before = index_of(r, reference_filling(r, before), s);
        s->index_after = s->index;
        return;
    }
    // For a sphere or a cone the side is certain. A mesh may have walls turned either way.
    const bool leaves = reference_is_round(r, s->primitive) ? !s->enters : was_inside;
    struct inside within = was_inside ? *before : around;
    s->is_over = !was_inside && !enter(&within, s->body);
    s->after = leaves ? around : within;
    const uint32_t left = reference_filling(r, leaves ? &within : &around);
    const uint32_t entered = reference_filling(r, &s->after);
    s->passes = is_same(r, left, entered);
    s->index_before = index_of(r, left, s);
    s->index_after = index_of(r, entered, s);
}

vec3 reference_left(const struct reference *r, const struct inside *inside, double way) {
    const uint32_t medium = r->media ? reference_filling(r, inside) : HIT_NONE;
    if (medium == HIT_NONE)
        return (vec3){1, 1, 1};
    const vec3 rate = r->materials[r->bodies[medium].filling].is->absorption;
    return (vec3){exp(-rate.x * way), exp(-rate.y * way), exp(-rate.z * way)};
}

// ---- the camera

// The media that a ray is inside on its way to the camera may be more than a path has room for.
struct approach {
    uint32_t *bodies; // room for all, in the order in which they were entered
    uint32_t count;
};

// Any face of a medium counts, even one that lets nothing through. For a sphere or a cone the side is
// certain.
static void cross_on_the_way(const struct reference *r, struct approach *on, const struct surface *s) {
    if (!r->bodies[s->body].is_medium)
        return;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < on->count; i++)
        if (on->bodies[i] != s->body)
            on->bodies[kept++] = on->bodies[i];
    const bool leaves = reference_is_round(r, s->primitive) ? !s->enters : kept < on->count;
    if (!leaves)
        on->bodies[kept++] = s->body;
    on->count = kept;
}

// A ray comes to the camera from above all bodies, and is inside those that it entered and did not leave.
static void look_from_above(const struct reference *r, struct approach *on) {
    const vec3 up = scene_inside_direction();
    const double height = r->primitive_count ? r->nodes[0].upper[1] : 0;
    if (!(height > 0))
        return;
    struct start start = reference_start(vec3_mul(up, 1.01 * height / up.y));
    for (int i = 0; i < CROSSINGS_MOST; i++) {
        const struct ray ray = {.start = start, .direction = vec3_neg(up), .t_max = vec3_length(start.at)};
        struct intersection hit;
        struct surface s;
        reference_intersect(r, &ray, &hit);
        if (hit.primitive == NO_PRIMITIVE)
            return;
        reference_surface(r, &ray, &hit, &s);
        cross_on_the_way(r, on, &s);
        start = reference_leave(r, &s, vec3_neg(s.geometric));
    }
}

// false: no memory. If there are too many, the outermost ones count; this was reported when the scene was
// opened.
static bool find_around_camera(struct reference *r) {
    struct approach on = {heap_array((size_t)r->input.scene->body_count + 1, sizeof *on.bodies), 0};
    if (!on.bodies)
        return false;
    look_from_above(r, &on);
    for (uint32_t i = 0; i < on.count; i++)
        enter(&r->around_camera, on.bodies[i]);
    free(on.bodies);
    return true;
}

bool reference_make_media(struct reference *r) {
    struct scene_media_reason reason;
    if (!scene_media_need(r->input.scene, &reason))
        return false;
    r->media = reason.need != SCENE_MEDIA_APART;
    return !r->media || find_around_camera(r);
}
