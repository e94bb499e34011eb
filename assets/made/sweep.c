#include "assets/made/sweep.h"

#include "assets/made/order.h"

struct sweeping {
    struct sweep *sweep;
    struct order order;
    uint32_t *first_high; // per point: its first in by_high; one more at the end
    uint32_t *by_high;    // edges, sorted by their high point
    uint32_t *right;      // edges that begin at the current point, from below upwards
    uint32_t right_count;
    uint32_t *helpers; // per edge with filled area above it: the last point beside that area
};

static bool clash(struct sweep *sweep, uint32_t a, uint32_t b) {
    sweep->clash[0] = a;
    sweep->clash[1] = b;
    return false;
}

static int side_of(const struct sweep *s, uint32_t edge, uint32_t point) {
    return plane_side(s->points[s->edges[edge].low], s->points[s->edges[edge].high], s->points[point]);
}

bool sweep_edges_clash(const struct ir_pair *p, const struct sweep_edge *a, const struct sweep_edge *b) {
    const int low = plane_side(p[a->low], p[a->high], p[b->low]);
    const int high = plane_side(p[a->low], p[a->high], p[b->high]);
    const bool share = a->low == b->low || a->low == b->high || a->high == b->low || a->high == b->high;
    const uint32_t from = a->low > b->low ? a->low : b->low;
    const uint32_t to = a->high < b->high ? a->high : b->high;
    if (low == 0 && high == 0)
        return share ? from < to : from <= to;
    if (share || low * high > 0)
        return false;
    return plane_side(p[b->low], p[b->high], p[a->low]) * plane_side(p[b->low], p[b->high], p[a->high]) <= 0;
}

static bool fits(struct sweeping *w, uint32_t a, uint32_t b) {
    if (a == ORDER_NONE || b == ORDER_NONE ||
        !sweep_edges_clash(w->sweep->points, &w->sweep->edges[a], &w->sweep->edges[b]))
        return true;
    return clash(w->sweep, a, b);
}

static void sort_by_high(struct sweeping *w) {
    const struct sweep *s = w->sweep;
    for (uint32_t e = 0; e < s->edge_count; e++)
        w->first_high[s->edges[e].high + 1]++;
    for (uint32_t p = 0; p < s->point_count; p++)
        w->first_high[p + 1] += w->first_high[p];
    uint32_t *next = ARENA_ARRAY(s->arena, uint32_t, s->point_count);
    for (uint32_t e = 0; e < s->edge_count; e++) {
        const uint32_t high = s->edges[e].high;
        w->by_high[w->first_high[high] + next[high]++] = e;
    }
}

// The edges that begin at a point are those from `begin` on. Two in the same direction overlap.
static bool sort_right(struct sweeping *w, uint32_t point, uint32_t begin) {
    struct sweep *s = w->sweep;
    w->right_count = 0;
    for (uint32_t e = begin; e < s->edge_count && s->edges[e].low == point; e++) {
        uint32_t at = w->right_count++;
        for (; at > 0; at--) {
            const int side = side_of(s, w->right[at - 1], s->edges[e].high);
            if (side == 0)
                return clash(s, w->right[at - 1], e);
            if (side > 0)
                break;
            w->right[at] = w->right[at - 1];
        }
        w->right[at] = e;
    }
    return true;
}

// The edge directly below a point, among those that neither begin nor end there.
static bool find_below(struct sweeping *w, uint32_t point, uint32_t own, uint32_t *below) {
    uint32_t at = w->order.root;
    *below = ORDER_NONE;
    while (at != ORDER_NONE) {
        const int side = side_of(w->sweep, at, point);
        if (side == 0)
            return clash(w->sweep, at, own);
        if (side > 0)
            *below = at;
        at = w->order.nodes[at].child[side > 0];
    }
    return true;
}

static void insert_right(struct sweeping *w, uint32_t below) {
    struct sweep *s = w->sweep;
    int32_t winding = below == ORDER_NONE ? 0 : s->edges[below].above;
    for (uint32_t i = 0; i < w->right_count; i++) {
        const uint32_t edge = w->right[i];
        order_insert(&w->order, edge, below);
        winding += s->edges[edge].turn;
        s->edges[edge].above = winding;
        below = edge;
    }
}

static bool fills_above(const struct sweeping *w, uint32_t edge) {
    return edge != ORDER_NONE && sweep_fills(w->sweep, w->sweep->edges[edge].above);
}

static void note_point(struct sweeping *w, uint32_t point, uint32_t below, bool begins) {
    struct sweep *s = w->sweep;
    if (begins && fills_above(w, below))
        *ARENA_PUSH(s->arena, &s->diagonals) = (struct sweep_diagonal){point, w->helpers[below]};
    if (below != ORDER_NONE)
        w->helpers[below] = point;
    for (uint32_t i = 0; i < w->right_count; i++)
        w->helpers[w->right[i]] = point;
}

static bool pass(struct sweeping *w, uint32_t point, uint32_t begin) {
    const uint32_t *left = w->by_high + w->first_high[point];
    const uint32_t left_count = w->first_high[point + 1] - w->first_high[point];
    if (!sort_right(w, point, begin))
        return false;
    if (left_count + w->right_count == 0)
        return true;
    for (uint32_t i = 0; i < left_count; i++)
        order_remove(&w->order, left[i]);
    uint32_t below;
    if (!find_below(w, point, left_count ? left[0] : w->right[0], &below))
        return false;
    const uint32_t above = below == ORDER_NONE ? w->order.first : w->order.nodes[below].beside[1];
    insert_right(w, below);
    note_point(w, point, below, left_count == 0);
    if (w->right_count == 0)
        return fits(w, below, above);
    return fits(w, below, w->right[0]) && fits(w, w->right[w->right_count - 1], above);
}

bool sweep_run(struct sweep *s) {
    struct sweeping w = {.sweep = s,
                         .first_high = ARENA_ARRAY(s->arena, uint32_t, (size_t)s->point_count + 1),
                         .by_high = ARENA_ARRAY(s->arena, uint32_t, s->edge_count),
                         .right = ARENA_ARRAY(s->arena, uint32_t, s->edge_count),
                         .helpers = ARENA_ARRAY(s->arena, uint32_t, s->edge_count)};
    order_init(&w.order, s->arena, s->edge_count);
    sort_by_high(&w);
    uint32_t edge = 0;
    bool fine = true;
    for (uint32_t point = 0; fine && point < s->point_count; point++) {
        fine = pass(&w, point, edge);
        while (edge < s->edge_count && s->edges[edge].low == point)
            edge++;
    }
    return fine;
}
