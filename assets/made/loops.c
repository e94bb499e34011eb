#include "assets/made/region_internal.h"

#include "assets/triangulate.h"
#include "core/heap.h"

struct linking {
    const struct loops *loops;
    uint32_t *first; // per place: its first in by_from; one more at the end
    uint32_t *by_from;
};

static void sort_by_from(struct linking *l, struct arena *arena) {
    const struct loops *loops = l->loops;
    l->first = ARENA_ARRAY(arena, uint32_t, (size_t)loops->place_count + 1);
    l->by_from = ARENA_ARRAY(arena, uint32_t, loops->edge_count);
    for (uint32_t e = 0; e < loops->edge_count; e++)
        l->first[loops->edges[e].from + 1]++;
    for (uint32_t p = 0; p < loops->place_count; p++)
        l->first[p + 1] += l->first[p];
    uint32_t *used = ARENA_ARRAY(arena, uint32_t, loops->place_count);
    for (uint32_t e = 0; e < loops->edge_count; e++) {
        const uint32_t from = loops->edges[e].from;
        l->by_from[l->first[from] + used[from]++] = e;
    }
}

// Quarters of the way round from the direction `at`-`back`, clockwise: 0 within half a turn, 1 half a turn, 2
// beyond it, 3 the same direction.
static int sector(const struct ir_pair *p, uint32_t at, uint32_t back, uint32_t to) {
    const int side = plane_side(p[at], p[back], p[to]);
    if (side != 0)
        return side < 0 ? 0 : 2;
    return (plane_before(p[at], p[back])) == (plane_before(p[at], p[to])) ? 3 : 1;
}

// Whether turning clockwise from `back` the edge to `a` comes before that to `b`.
static bool comes_first(const struct ir_pair *p, uint32_t at, uint32_t back, uint32_t a, uint32_t b) {
    const int sector_a = sector(p, at, back, a), sector_b = sector(p, at, back, b);
    if (sector_a != sector_b)
        return sector_a < sector_b;
    return plane_side(p[at], p[a], p[b]) < 0;
}

static uint32_t next_of(const struct linking *l, uint32_t edge) {
    const struct loops *loops = l->loops;
    const uint32_t at = loops->edges[edge].to, back = loops->edges[edge].from;
    uint32_t best = l->by_from[l->first[at]];
    for (uint32_t i = l->first[at] + 1; i < l->first[at + 1]; i++)
        if (comes_first(loops->places, at, back, loops->edges[l->by_from[i]].to, loops->edges[best].to))
            best = l->by_from[i];
    return best;
}

void loops_link(struct loops *loops, struct arena *arena) {
    struct linking l = {.loops = loops};
    sort_by_from(&l, arena);
    loops->next = ARENA_ARRAY(arena, uint32_t, loops->edge_count);
    for (uint32_t e = 0; e < loops->edge_count; e++)
        loops->next[e] = next_of(&l, e);
}

struct cutting {
    const struct loops *loops;
    struct region *region;
    struct triangulator triangulator;
    bool *is_seen;
    uint32_t *loop; // places
    vec3 *corners;
    uint32_t *cuts;
};

// Notes the places of the loop through an edge; returns how many.
static uint32_t walk(struct cutting *c, uint32_t edge) {
    uint32_t count = 0;
    while (!c->is_seen[edge]) {
        c->is_seen[edge] = true;
        c->loop[count++] = c->loops->edges[edge].from;
        edge = c->loops->next[edge];
    }
    return count;
}

static void cut_loop(struct cutting *c, uint32_t count) {
    if (count < 3)
        return;
    for (uint32_t i = 0; i < count; i++)
        c->corners[i] = (vec3){c->loops->places[c->loop[i]].u, c->loops->places[c->loop[i]].v, 0};
    triangulate(&c->triangulator, c->corners, count, c->cuts);
    for (uint32_t t = 0; t + 2 < count; t++) {
        uint32_t *triangle = c->region->triangles[c->region->triangle_count++];
        for (int k = 0; k < 3; k++)
            triangle[k] = c->loop[c->cuts[3 * t + (uint32_t)k]];
    }
}

void loops_cut(const struct loops *loops, struct region *region) {
    struct arena *arena = region->arena;
    struct cutting c = {.loops = loops,
                        .region = region,
                        .is_seen = ARENA_ARRAY(arena, bool, loops->edge_count),
                        .loop = ARENA_ARRAY(arena, uint32_t, loops->edge_count),
                        .corners = ARENA_ARRAY(arena, vec3, loops->edge_count),
                        .cuts = ARENA_ARRAY(arena, uint32_t, heap_times(3, loops->edge_count))};
    triangulate_init(&c.triangulator, arena);
    region->triangles = arena_alloc_array(arena, loops->edge_count, sizeof *region->triangles);
    region->triangle_count = 0;
    for (uint32_t e = 0; e < loops->edge_count; e++)
        if (!c.is_seen[e])
            cut_loop(&c, walk(&c, e));
}
