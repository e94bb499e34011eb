#include "assets/made/ends.h"

#include "assets/made/region.h"
#include "core/heap.h"

#include <stdlib.h>

struct closing {
    struct ir_pair *nodes;
    uint32_t node_count;
    struct region_edge *edges;
    uint32_t edge_count;
};

static void take_path(struct closing *c, const struct path *path, bool is_ring, struct arena *arena) {
    c->node_count = is_ring ? path->count : path->count + 1;
    c->nodes = ARENA_ARRAY(arena, struct ir_pair, c->node_count);
    c->edges = ARENA_ARRAY(arena, struct region_edge, heap_times(2, path->count) + 1);
    for (uint32_t i = 0; i < path->count; i++) {
        const uint32_t next = i + 1 < c->node_count ? i + 1 : 0;
        c->nodes[i] = path->pieces[i].from;
        c->nodes[next] = next ? path->pieces[i].to : c->nodes[next];
        c->edges[c->edge_count++] = (struct region_edge){i, next};
    }
}

struct height {
    double v;
    uint32_t node;
};

static int compare_heights(const void *a, const void *b) {
    const struct height *p = a, *q = b;
    if (p->v != q->v)
        return p->v < q->v ? -1 : 1;
    return p->node < q->node ? -1 : 1;
}

// From the last node to the first along the axis, by all nodes on the axis between them.
static void close_along_axis(struct closing *c, struct arena *arena) {
    const struct ir_pair first = c->nodes[0], last = c->nodes[c->node_count - 1];
    struct height *heights = ARENA_ARRAY(arena, struct height, c->node_count);
    uint32_t count = 0;
    for (uint32_t i = 0; i < c->node_count; i++)
        if (c->nodes[i].u == 0 && c->nodes[i].v >= fmin(first.v, last.v) &&
            c->nodes[i].v <= fmax(first.v, last.v))
            heights[count++] = (struct height){c->nodes[i].v, i};
    qsort(heights, count, sizeof *heights, compare_heights);
    for (uint32_t i = 0; i + 1 < count; i++) {
        const uint32_t low = heights[i].node, high = heights[i + 1].node;
        c->edges[c->edge_count++] =
            first.v < last.v ? (struct region_edge){high, low} : (struct region_edge){low, high};
    }
}

void ends_cut(struct ends *ends, const struct path *path, bool is_ring, struct arena *arena) {
    struct closing c = {0};
    take_path(&c, path, is_ring, arena);
    if (!is_ring)
        close_along_axis(&c, arena);
    struct region region = {.arena = arena,
                            .points = c.nodes,
                            .point_count = c.node_count,
                            .edges = c.edges,
                            .edge_count = c.edge_count,
                            .may_touch = true};
    *ends = (struct ends){.nodes = c.nodes, .box = PLANE_BOX_EMPTY};
    for (uint32_t i = 0; i < c.node_count; i++)
        plane_include(&ends->box, c.nodes[i]);
    if (region_cut(&region) != REGION_FINE)
        return;
    for (uint32_t t = 0; t < region.triangle_count; t++)
        for (int k = 0; k < 3; k++)
            region.triangles[t][k] = region.first_at[region.triangles[t][k]];
    ends->triangles = region.triangles;
    ends->triangle_count = region.triangle_count;
}
