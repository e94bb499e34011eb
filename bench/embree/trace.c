// Whitted's recursion with Embree's rtcIntersect1 and rtcOccluded1, a tile of pixels a piece of work.
#include "bench/embree/peer.h"
#include "core/heap.h"
#include "core/parallel.h"

#include <embree3/rtcore.h>
#include <stdatomic.h>
#include <stdlib.h>

enum {
    TILE = 16, // pixels of a tile's side
};

enum kind {
    PRIMARY,
    REFLECTED,
    REFRACTED,
};

struct branch {
    float3 start, direction;
    float throughput;
    uint32_t depth;
    enum kind kind;
};

struct work {
    const struct peer *peer;
    uint32_t width, height, samples, tiles_x;
    const float *offsets; // of the samples within a pixel, two each
    float *rgb;
    struct peer_counts *by_tile;
    atomic_bool failed;
};

struct path {
    const struct peer *peer;
    struct peer_counts *counts;
    struct branch *stack; // max_depth + 2
    uint32_t waiting;
    float3 radiance;
};

static void add(struct path *p, float3 value, float throughput) {
    p->radiance = float3_add(p->radiance, float3_mul(value, throughput));
}

static bool blocked(const struct peer *peer, float3 start, float3 way, float far) {
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    struct RTCRay ray = {start.x, start.y, start.z, 0, way.x, way.y, way.z, 0, far, UINT32_MAX, 0, 0};
    rtcOccluded1(peer->top, &context, &ray);
    return ray.tfar < 0;
}

static float3 direct_light(struct path *p, const struct peer_surface *s, float3 direction) {
    const struct peer *peer = p->peer;
    const float3 start = peer_leave(s, s->geometric);
    float3 sum = {0, 0, 0};
    for (uint32_t i = 0; i < peer->light_count; i++) {
        float3 way;
        float far;
        const float3 value = peer_light(&peer->lights[i], s, start, direction, &way, &far);
        if (float3_is_zero(value))
            continue;
        p->counts->shadow += peer->shadows;
        if (!peer->shadows || !blocked(peer, start, way, far))
            sum = float3_add(sum, value);
    }
    return sum;
}

// Whether a child is followed; one cut by depth is, to see the background.
static bool followed(const struct peer *peer, const struct branch *from, float throughput) {
    const bool heavy = throughput > 0 && throughput >= peer->min_weight;
    return heavy && !(from->depth == peer->max_depth && !peer->cut_sees_background);
}

static void send(struct path *p, const struct branch *from, const struct peer_surface *s) {
    float reflection = s->reflection, refraction = s->refraction;
    struct branch through = {.depth = from->depth + 1, .kind = REFRACTED};
    if (refraction > 0 && !peer_bent(s, from->direction, &through.direction)) {
        reflection += refraction;
        refraction = 0;
    }
    through.throughput = from->throughput * refraction;
    if (followed(p->peer, from, through.throughput)) {
        through.start = peer_leave(s, float3_neg(s->geometric));
        p->stack[p->waiting++] = through;
    }
    const float throughput = from->throughput * reflection;
    if (followed(p->peer, from, throughput))
        p->stack[p->waiting++] =
            (struct branch){peer_leave(s, s->geometric), peer_mirrored(s, from->direction), throughput,
                            from->depth + 1, REFLECTED};
}

static void follow_ray(struct path *p, const struct branch *b) {
    const struct peer *peer = p->peer;
    if (b->depth > peer->max_depth) {
        add(p, peer_background(peer, b->direction), b->throughput);
        return;
    }
    p->counts->primary += b->kind == PRIMARY;
    p->counts->reflected += b->kind == REFLECTED;
    p->counts->refracted += b->kind == REFRACTED;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags =
        b->kind == PRIMARY ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    struct RTCRayHit found = {.ray = {b->start.x, b->start.y, b->start.z, 0, b->direction.x, b->direction.y,
                                      b->direction.z, 0, INFINITY, UINT32_MAX, 0, 0}};
    found.hit.geomID = found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(peer->top, &context, &found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        add(p, peer_background(peer, b->direction), b->throughput);
        return;
    }
    struct peer_surface s;
    peer_surface(peer, &found, &s);
    add(p, direct_light(p, &s, b->direction), b->throughput);
    send(p, b, &s);
}

static float3 camera_direction(const struct work *w, uint32_t x, uint32_t y, uint32_t sample) {
    const float *offset = w->offsets + 2 * (size_t)sample;
    const float along = 2 * ((float)x + offset[0]) / (float)w->width - 1;
    const float down = 1 - 2 * ((float)y + offset[1]) / (float)w->height;
    const struct peer *peer = w->peer;
    return float3_unit(
        float3_add(float3_add(peer->forward, float3_mul(peer->right, along)), float3_mul(peer->up, down)));
}

static void draw_pixel(const struct work *w, struct path *p, uint32_t x, uint32_t y) {
    p->radiance = (float3){0, 0, 0};
    for (uint32_t sample = 0; sample < w->samples; sample++) {
        p->stack[0] = (struct branch){w->peer->position, camera_direction(w, x, y, sample), 1, 0, PRIMARY};
        p->waiting = 1;
        while (p->waiting) {
            const struct branch next = p->stack[--p->waiting];
            follow_ray(p, &next);
        }
    }
    const float3 mean = float3_mul(p->radiance, 1 / (float)w->samples);
    float *to = w->rgb + 3 * ((size_t)y * w->width + x);
    to[0] = mean.x;
    to[1] = mean.y;
    to[2] = mean.z;
}

static void draw_tiles(void *context, size_t begin, size_t end) {
    struct work *w = context;
    struct branch *stack = heap_alloc((w->peer->max_depth + (size_t)3) * sizeof *stack);
    if (!stack) {
        w->failed = true;
        return;
    }
    for (size_t tile = begin; tile < end; tile++) {
        struct peer_counts counts = {0};
        struct path path = {.peer = w->peer, .counts = &counts, .stack = stack};
        const uint32_t left = (uint32_t)(tile % w->tiles_x) * TILE,
                       top = (uint32_t)(tile / w->tiles_x) * TILE;
        for (uint32_t y = top; y < top + TILE && y < w->height; y++)
            for (uint32_t x = left; x < left + TILE && x < w->width; x++)
                draw_pixel(w, &path, x, y);
        w->by_tile[tile] = counts;
    }
    free(stack);
}

// Two numbers a sample; NULL: no memory.
static float *make_offsets(uint32_t samples) {
    float *offsets = heap_alloc(2 * (size_t)samples * sizeof *offsets);
    for (uint32_t i = 0; offsets && i < samples; i++) {
        double a, b;
        view_sample_offset(i, &a, &b);
        offsets[2 * (size_t)i] = (float)a;
        offsets[2 * (size_t)i + 1] = (float)b;
    }
    return offsets;
}

bool peer_render(const struct peer *peer, uint32_t width, uint32_t height, uint32_t samples, float *rgb,
                 struct peer_counts *counts) {
    struct work w = {.peer = peer,
                     .width = width,
                     .height = height,
                     .samples = samples,
                     .tiles_x = (width + TILE - 1) / TILE,
                     .rgb = rgb};
    const size_t tiles = (size_t)w.tiles_x * ((height + TILE - 1) / TILE);
    float *offsets = make_offsets(samples);
    w.offsets = offsets;
    w.by_tile = heap_zeroed(tiles, sizeof *w.by_tile);
    const bool good = offsets && w.by_tile;
    if (good)
        parallel_for(tiles, 1, draw_tiles, &w);
    for (size_t i = 0; good && i < tiles; i++) {
        counts->primary += w.by_tile[i].primary;
        counts->reflected += w.by_tile[i].reflected;
        counts->refracted += w.by_tile[i].refracted;
        counts->shadow += w.by_tile[i].shadow;
    }
    free(offsets);
    free(w.by_tile);
    return good && !w.failed;
}
