#include "measure/hit_errors.h"
#include "scene/shape.h"

#include <math.h>

struct hit_counts {
    uint64_t silhouette, wrong_inside, wrong_outside, acne, leaks, shadow_edge, holes, wrong_second;
};

struct comparing {
    uint32_t width, height;
    const struct hit_pixel *device, *reference;
    const struct scene *scene;
};

struct surroundings {
    bool silhouette, shadow_edge;
};

static struct surroundings look_around(const struct comparing *c, uint32_t x, uint32_t y) {
    const struct hit_pixel *own = &c->reference[(size_t)y * c->width + x];
    struct surroundings around = {0};
    for (uint32_t v = y ? y - 1 : 0; v <= y + 1 && v < c->height; v++)
        for (uint32_t u = x ? x - 1 : 0; u <= x + 1 && u < c->width; u++) {
            const struct hit_pixel *other = &c->reference[(size_t)v * c->width + u];
            const double nearer = fmin(own->distance, other->distance);
            around.silhouette |=
                other->body != own->body || fabs(own->distance - other->distance) > 0.05 * nearer;
            around.shadow_edge |= other->lit != own->lit || other->considered != own->considered;
        }
    return around;
}

static bool is_second_wrong(const struct hit_pixel *d, const struct hit_pixel *r) {
    return d->reflected != r->reflected || d->refracted != r->refracted;
}

// The halves of a parallelogram are one face: the side of its diagonal that a ray hits never shows.
static bool is_same_face(const struct comparing *c, const struct hit_pixel *d, const struct hit_pixel *r) {
    if (d->body != r->body)
        return false;
    const bool halves =
        r->body < c->scene->body_count && shape_traits(c->scene->bodies[r->body].shape).is_flat;
    return halves || d->triangle == r->triangle;
}

static void compare_pixel(const struct comparing *c, uint32_t x, uint32_t y, struct hit_counts *counts) {
    const size_t at = (size_t)y * c->width + x;
    const struct hit_pixel *d = &c->device[at], *r = &c->reference[at];
    const struct surroundings around = look_around(c, x, y);
    const bool wrong = !is_same_face(c, d, r);
    counts->silhouette += around.silhouette;
    counts->wrong_inside += wrong && around.silhouette;
    counts->wrong_outside += wrong && !around.silhouette;
    const bool closed = r->body < c->scene->body_count && c->scene->bodies[r->body].closed;
    counts->holes += d->body == HIT_NONE && closed && !around.silhouette;
    if (wrong || r->body == HIT_NONE)
        return;
    counts->wrong_second += !around.silhouette && is_second_wrong(d, r);
    const uint32_t both = d->considered & r->considered;
    const bool dark = both & r->lit & ~d->lit, light = both & d->lit & ~r->lit;
    counts->acne += dark && !around.shadow_edge;
    counts->leaks += light && !around.shadow_edge;
    counts->shadow_edge += (dark || light) && around.shadow_edge;
}

void hits_compare(uint32_t width, uint32_t height, const struct hit_pixel *device,
                  const struct hit_pixel *reference, const struct scene *scene, struct hit_errors *out) {
    const struct comparing comparing = {width, height, device, reference, scene};
    struct hit_counts counts = {0};
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            compare_pixel(&comparing, x, y, &counts);
    const double million = 1e6 / ((double)width * height);
    *out = (struct hit_errors){.known = true,
                               .silhouette = million * (double)counts.silhouette,
                               .wrong_inside = million * (double)counts.wrong_inside,
                               .wrong_outside = million * (double)counts.wrong_outside,
                               .acne = million * (double)counts.acne,
                               .leaks = million * (double)counts.leaks,
                               .shadow_edge = million * (double)counts.shadow_edge,
                               .holes = million * (double)counts.holes,
                               .wrong_second = million * (double)counts.wrong_second};
}

// ---- whole paths

static bool sees_around(uint32_t width, uint32_t height, const double *reference, uint32_t x, uint32_t y) {
    for (uint32_t v = y ? y - 1 : 0; v <= y + 1 && v < height; v++)
        for (uint32_t u = x ? x - 1 : 0; u <= x + 1 && u < width; u++)
            for (size_t c = 0; c < 3; c++)
                if (reference[3 * ((size_t)v * width + u) + c] != 0)
                    return true;
    return false;
}

double hits_escapes(uint32_t width, uint32_t height, const float *device, const double *reference) {
    uint64_t count = 0;
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            const float *p = device + 3 * ((size_t)y * width + x);
            count += (p[0] != 0 || p[1] != 0 || p[2] != 0) && !sees_around(width, height, reference, x, y);
        }
    return 1e6 * (double)count / ((double)width * height);
}
