// The points of a region, sorted and each place once, and its edges between places.
#include "assets/made/region_internal.h"

#include <stdlib.h>

struct numbered {
    struct ir_pair at;
    uint32_t point;
};

static int compare_points(const void *a, const void *b) {
    const struct numbered *p = a, *q = b;
    if (plane_same(p->at, q->at))
        return p->point < q->point ? -1 : 1;
    return plane_before(p->at, q->at) ? -1 : 1;
}

bool region_find_places(struct region *r) {
    struct numbered *sorted = ARENA_ARRAY(r->arena, struct numbered, r->point_count);
    for (uint32_t i = 0; i < r->point_count; i++)
        sorted[i] = (struct numbered){plane_point(r->points[i]), i};
    qsort(sorted, r->point_count, sizeof *sorted, compare_points);
    r->places = ARENA_ARRAY(r->arena, struct ir_pair, r->point_count);
    r->first_at = ARENA_ARRAY(r->arena, uint32_t, r->point_count);
    r->place_of = ARENA_ARRAY(r->arena, uint32_t, r->point_count);
    r->place_count = 0;
    for (uint32_t i = 0; i < r->point_count; i++) {
        const bool again = i > 0 && plane_same(sorted[i].at, sorted[i - 1].at);
        if (again && !r->may_touch) {
            r->clash[0] = sorted[i - 1].point;
            r->clash[1] = sorted[i].point;
            r->place = sorted[i].at;
            return false;
        }
        if (!again) {
            r->first_at[r->place_count] = sorted[i].point;
            r->places[r->place_count++] = sorted[i].at;
        }
        r->place_of[sorted[i].point] = r->place_count - 1;
    }
    return true;
}

struct placed {
    struct sweep_edge edge;
    uint32_t given;
};

static int compare_edges(const void *a, const void *b) {
    const struct placed *p = a, *q = b;
    if (p->edge.low != q->edge.low)
        return p->edge.low < q->edge.low ? -1 : 1;
    if (p->edge.high != q->edge.high)
        return p->edge.high < q->edge.high ? -1 : 1;
    return p->given < q->given ? -1 : 1;
}

static uint32_t place_edges(const struct region *r, struct placed *placed) {
    uint32_t count = 0;
    for (uint32_t e = 0; e < r->edge_count; e++) {
        const uint32_t from = r->place_of[r->edges[e].from], to = r->place_of[r->edges[e].to];
        if (from < to)
            placed[count++] = (struct placed){{from, to, 1, 0}, e};
        else if (from > to)
            placed[count++] = (struct placed){{to, from, -1, 0}, e};
    }
    return count;
}

// Adds up edges between the same places; those that cancel are left out.
static void add_up(struct sweep *sweep, uint32_t *given, const struct placed *placed, uint32_t count) {
    for (uint32_t i = 0, end; i < count; i = end) {
        struct sweep_edge edge = placed[i].edge;
        for (end = i + 1;
             end < count && placed[end].edge.low == edge.low && placed[end].edge.high == edge.high; end++)
            edge.turn += placed[end].edge.turn;
        if (edge.turn == 0)
            continue;
        given[sweep->edge_count] = placed[i].given;
        sweep->edges[sweep->edge_count++] = edge;
    }
}

void region_place_edges(const struct region *r, struct sweep *sweep, uint32_t *given) {
    struct placed *placed = ARENA_ARRAY(r->arena, struct placed, r->edge_count);
    const uint32_t count = place_edges(r, placed);
    qsort(placed, count, sizeof *placed, compare_edges);
    *sweep = (struct sweep){.arena = r->arena,
                            .points = r->places,
                            .point_count = r->place_count,
                            .edges = ARENA_ARRAY(r->arena, struct sweep_edge, count),
                            .even_odd = r->even_odd};
    add_up(sweep, given, placed, count);
}
