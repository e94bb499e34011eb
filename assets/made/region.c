#include "assets/made/region.h"

#include "assets/made/region_internal.h"
#include "core/heap.h"

static bool is_end(const struct sweep *sweep, uint32_t point, uint32_t edge) {
    return plane_side(sweep->points[sweep->edges[edge].low], sweep->points[sweep->edges[edge].high],
                      sweep->points[point]) == 0;
}

// Two edges that have a point in common: do they cross, or does one end on the other?
static enum region_clash judge(struct region *r, const struct sweep *sweep, const uint32_t *given) {
    const uint32_t a = sweep->clash[0], b = sweep->clash[1];
    const struct sweep_edge *ends[2] = {&sweep->edges[a], &sweep->edges[b]};
    r->clash[0] = given[a] < given[b] ? given[a] : given[b];
    r->clash[1] = given[a] < given[b] ? given[b] : given[a];
    for (int i = 0; i < 2; i++) {
        const uint32_t other = i == 0 ? b : a;
        for (int high = 1; high >= 0; high--) {
            const uint32_t point = high ? ends[i]->high : ends[i]->low;
            const bool within = point > ends[!i]->low && point < ends[!i]->high;
            if (within && is_end(sweep, point, other)) {
                r->place = sweep->points[point];
                return REGION_TOUCHES;
            }
        }
    }
    r->place = plane_crossing(sweep->points[ends[0]->low], sweep->points[ends[0]->high],
                              sweep->points[ends[1]->low], sweep->points[ends[1]->high]);
    return REGION_CROSSES;
}

static enum region_clash run(struct region *r, struct sweep *sweep, uint32_t **given) {
    if (!region_find_places(r))
        return REGION_MEETS;
    *given = ARENA_ARRAY(r->arena, uint32_t, r->edge_count);
    region_place_edges(r, sweep, *given);
    return sweep_run(sweep) ? REGION_FINE : judge(r, sweep, *given);
}

enum region_clash region_check(struct region *r) {
    struct sweep sweep;
    uint32_t *given;
    return run(r, &sweep, &given);
}

static void keep_sides(struct region *r, const struct sweep *sweep, const uint32_t *given) {
    r->sides = ARENA_ARRAY(r->arena, struct region_side, sweep->edge_count);
    r->side_count = 0;
    for (uint32_t e = 0; e < sweep->edge_count; e++) {
        const struct sweep_edge *edge = &sweep->edges[e];
        const bool above = sweep_fills(sweep, edge->above);
        if (above == sweep_fills(sweep, edge->above - edge->turn))
            continue;
        const uint32_t from = above ? edge->low : edge->high, to = above ? edge->high : edge->low;
        const bool is_reversed = r->place_of[r->edges[given[e]].from] != from;
        r->sides[r->side_count++] = (struct region_side){from, to, given[e], is_reversed, 0};
    }
}

// The sides, followed by each diagonal in both directions.
static struct loops make_loops(const struct region *r, const struct sweep *sweep) {
    const uint32_t diagonals = sweep ? sweep->diagonals.count : 0;
    struct sweep_diagonal *edges =
        ARENA_ARRAY(r->arena, struct sweep_diagonal, r->side_count + heap_times(2, diagonals));
    uint32_t count = 0;
    for (uint32_t i = 0; i < r->side_count; i++)
        edges[count++] = (struct sweep_diagonal){r->sides[i].from, r->sides[i].to};
    for (uint32_t i = 0; i < diagonals; i++) {
        const struct sweep_diagonal d = sweep->diagonals.items[i];
        edges[count++] = d;
        edges[count++] = (struct sweep_diagonal){d.to, d.from};
    }
    struct loops loops = {r->places, r->place_count, edges, count, NULL};
    loops_link(&loops, r->arena);
    return loops;
}

static enum region_clash find(struct region *r, struct sweep *sweep) {
    uint32_t *given;
    const enum region_clash clash = run(r, sweep, &given);
    if (clash != REGION_FINE)
        return clash;
    keep_sides(r, sweep, given);
    const struct loops loops = make_loops(r, NULL);
    for (uint32_t i = 0; i < r->side_count; i++)
        r->sides[i].next = loops.next[i];
    return REGION_FINE;
}

enum region_clash region_find(struct region *r) {
    struct sweep sweep;
    return find(r, &sweep);
}

// Sweeps the sides by themselves: edges inside the filled area would get diagonals, too.
static void sweep_sides(const struct region *r, struct sweep *sweep) {
    uint32_t kept = 0;
    for (uint32_t e = 0; e < sweep->edge_count && kept < r->side_count; e++) {
        const struct sweep_edge *edge = &sweep->edges[e];
        const struct region_side *side = &r->sides[kept];
        const uint32_t low = side->from < side->to ? side->from : side->to;
        if (edge->low == low && edge->high == (side->from < side->to ? side->to : side->from))
            sweep->edges[kept++] = (struct sweep_edge){edge->low, edge->high, 1, 0};
    }
    sweep->edge_count = kept;
    sweep->even_odd = true;
    sweep->diagonals.count = 0;
    sweep_run(sweep);
}

enum region_clash region_cut(struct region *r) {
    struct sweep sweep;
    const enum region_clash clash = find(r, &sweep);
    if (clash != REGION_FINE)
        return clash;
    if (r->side_count != sweep.edge_count)
        sweep_sides(r, &sweep);
    const struct loops loops = make_loops(r, &sweep);
    loops_cut(&loops, r);
    return REGION_FINE;
}
