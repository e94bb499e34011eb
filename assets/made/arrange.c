#include "assets/made/arrange.h"

#include <stdlib.h>

enum {
    ROUNDS_MOST = 12,
    POINTS_MOST = 1 << 20,
};

#define PAIRS_MOST (UINT64_C(1) << 28) // in all rounds: some seconds

// A cut of an edge at a point.
struct cut {
    uint32_t edge, point;
    double share; // of the edge's length
};

struct cutter {
    struct arrange *in;
    struct {
        struct cut *items;
        uint32_t count, capacity;
    } cuts;
    uint64_t pairs_left;
};

static struct ir_pair end_of(const struct cutter *c, uint32_t edge, bool to) {
    const struct region_edge *e = &c->in->edges.items[edge];
    return c->in->points.items[to ? e->to : e->from];
}

static void cut_at(struct cutter *c, uint32_t edge, uint32_t point) {
    const struct ir_pair from = end_of(c, edge, false), along = plane_sub(end_of(c, edge, true), from);
    const double share =
        plane_dot(plane_sub(c->in->points.items[point], from), along) / plane_dot(along, along);
    *ARENA_PUSH(c->in->arena, &c->cuts) = (struct cut){edge, point, fmin(fmax(share, 0), 1)};
}

// Cuts an edge where an end of another one lies on it.
static void cut_at_end(struct cutter *c, uint32_t edge, uint32_t other, bool to) {
    const struct ir_pair a = end_of(c, edge, false), b = end_of(c, edge, true), p = end_of(c, other, to);
    const bool ordered = plane_before(a, b);
    const struct ir_pair low = ordered ? a : b, high = ordered ? b : a;
    if (plane_before(low, p) && plane_before(p, high)) {
        const struct region_edge *e = &c->in->edges.items[other];
        cut_at(c, edge, to ? e->to : e->from);
    }
}

static double on_grid(double value, double grid) {
    return rint(value / grid) * grid;
}

static void cut_pair(struct cutter *c, uint32_t a, uint32_t b) {
    const struct ir_pair ends[4] = {end_of(c, a, false), end_of(c, a, true), end_of(c, b, false),
                                    end_of(c, b, true)};
    const int sides[4] = {plane_side(ends[2], ends[3], ends[0]), plane_side(ends[2], ends[3], ends[1]),
                          plane_side(ends[0], ends[1], ends[2]), plane_side(ends[0], ends[1], ends[3])};
    for (int i = 0; i < 4; i++)
        if (sides[i] == 0)
            cut_at_end(c, i < 2 ? b : a, i < 2 ? a : b, i % 2);
    if (sides[0] * sides[1] >= 0 || sides[2] * sides[3] >= 0)
        return;
    const struct ir_pair at = plane_crossing(ends[0], ends[1], ends[2], ends[3]);
    *ARENA_PUSH(c->in->arena, &c->in->points) =
        (struct ir_pair){on_grid(at.u, c->in->grid), on_grid(at.v, c->in->grid)};
    cut_at(c, a, c->in->points.count - 1);
    cut_at(c, b, c->in->points.count - 1);
}

// ---- pairs

struct span {
    double left, right, bottom, top;
    uint32_t edge;
};

static int compare_spans(const void *a, const void *b) {
    const struct span *p = a, *q = b;
    if (p->left != q->left)
        return p->left < q->left ? -1 : 1;
    return p->edge < q->edge ? -1 : 1;
}

static struct span *find_spans(const struct cutter *c) {
    const uint32_t count = c->in->edges.count;
    struct span *spans = ARENA_ARRAY(c->in->arena, struct span, count);
    for (uint32_t i = 0; i < count; i++) {
        const struct ir_pair a = end_of(c, i, false), b = end_of(c, i, true);
        spans[i] = (struct span){fmin(a.u, b.u), fmax(a.u, b.u), fmin(a.v, b.v), fmax(a.v, b.v), i};
    }
    qsort(spans, count, sizeof *spans, compare_spans);
    return spans;
}

static bool find_cuts(struct cutter *c) {
    const struct span *spans = find_spans(c);
    c->cuts.count = 0;
    for (uint32_t i = 0; i < c->in->edges.count; i++)
        for (uint32_t k = i + 1; k < c->in->edges.count && spans[k].left <= spans[i].right; k++) {
            if (c->pairs_left-- == 0 || c->in->points.count > POINTS_MOST || c->cuts.count > POINTS_MOST)
                return false;
            if (spans[k].bottom <= spans[i].top && spans[k].top >= spans[i].bottom)
                cut_pair(c, spans[i].edge, spans[k].edge);
        }
    return true;
}

// ---- edges

static int compare_cuts(const void *a, const void *b) {
    const struct cut *p = a, *q = b;
    if (p->edge != q->edge)
        return p->edge < q->edge ? -1 : 1;
    if (p->share != q->share)
        return p->share < q->share ? -1 : 1;
    return p->point < q->point ? -1 : p->point > q->point;
}

static struct ir_pair direction_at(const struct prism_look *look, double share) {
    const struct ir_pair mixed = plane_mix(look->along[0], look->along[1], share);
    return plane_direction((struct ir_pair){0, 0}, mixed);
}

static struct prism_look look_between(const struct prism_look *look, double from, double to) {
    const double length = look->u[1] - look->u[0];
    return (struct prism_look){{direction_at(look, from), direction_at(look, to)},
                               {look->u[0] + length * from, look->u[0] + length * to}};
}

static void add_part(struct arrange *out, uint32_t from, uint32_t to, struct prism_look look) {
    if (plane_same(out->points.items[from], out->points.items[to]))
        return;
    out->looks[out->edges.count] = look;
    out->edges.items[out->edges.count++] = (struct region_edge){from, to};
}

static void apply_cuts(struct cutter *c) {
    struct arrange *a = c->in;
    struct arrange before = *a;
    const uint32_t most = a->edges.count + c->cuts.count;
    qsort(c->cuts.items, c->cuts.count, sizeof *c->cuts.items, compare_cuts);
    a->edges.items = ARENA_ARRAY(a->arena, struct region_edge, most);
    a->edges.capacity = most;
    a->edges.count = 0;
    a->looks = ARENA_ARRAY(a->arena, struct prism_look, most);
    uint32_t at = 0;
    for (uint32_t e = 0; e < before.edges.count; e++) {
        struct cut last = {e, before.edges.items[e].from, 0};
        for (; at < c->cuts.count && c->cuts.items[at].edge == e; at++) {
            const struct cut next = c->cuts.items[at];
            add_part(a, last.point, next.point, look_between(&before.looks[e], last.share, next.share));
            last = next;
        }
        add_part(a, last.point, before.edges.items[e].to, look_between(&before.looks[e], last.share, 1));
    }
}

bool arrange_run(struct arrange *arrange, struct region *region) {
    struct cutter cutter = {.in = arrange, .pairs_left = PAIRS_MOST};
    for (int round = 0; round < ROUNDS_MOST; round++) {
        *region = (struct region){.arena = arrange->arena,
                                  .points = arrange->points.items,
                                  .point_count = arrange->points.count,
                                  .edges = arrange->edges.items,
                                  .edge_count = arrange->edges.count,
                                  .may_touch = true};
        if (region_cut(region) == REGION_FINE)
            return true;
        if (!find_cuts(&cutter))
            return false;
        apply_cuts(&cutter);
    }
    return false;
}
