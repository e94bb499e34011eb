#include "assets/made/clash.h"

#include "assets/made/fault.h"

#include <stdio.h>

static uint32_t nodes_of(const struct clash_chain *chain) {
    return chain->path->count + chain->is_open;
}

static void take_chain(const struct clash_chain *chain, struct ir_pair *points, struct region_edge *edges,
                       uint32_t first) {
    const struct path *path = chain->path;
    for (uint32_t i = 0; i < path->count; i++) {
        const uint32_t next = i + 1 < nodes_of(chain) ? i + 1 : 0;
        points[i] = path->pieces[i].from;
        if (next)
            points[next] = path->pieces[i].to;
        edges[i] = (struct region_edge){first + i, first + next};
    }
}

void clash_take(const struct clash_chains *chains, struct arena *arena, struct region *region) {
    uint64_t points = 0, pieces = 0;
    for (uint32_t i = 0; i < chains->count; i++) {
        points += nodes_of(&chains->chains[i]);
        pieces += chains->chains[i].path->count;
    }
    struct ir_pair *at = ARENA_ARRAY(arena, struct ir_pair, points);
    struct region_edge *edges = ARENA_ARRAY(arena, struct region_edge, pieces);
    *region = (struct region){.arena = arena, .points = at, .edges = edges};
    for (uint32_t i = 0; i < chains->count; i++) {
        take_chain(&chains->chains[i], at + region->point_count, edges + region->edge_count,
                   region->point_count);
        region->point_count += nodes_of(&chains->chains[i]);
        region->edge_count += chains->chains[i].path->count;
    }
}

// The chain and the point that a node belongs to, or an edge begins at.
static void blame(const struct clash_chains *chains, uint32_t item, bool is_edge, uint32_t which,
                  struct made_fault *fault) {
    for (uint32_t i = 0; i < chains->count; i++) {
        const struct path *path = chains->chains[i].path;
        const uint32_t own = is_edge ? path->count : nodes_of(&chains->chains[i]);
        if (item >= own) {
            item -= own;
            continue;
        }
        fault->outlines[which] = i;
        fault->points[which] = path->pieces[item < path->count ? item : path->count - 1].source;
        // The last node of an open path is the point after the one that its piece begins at.
        fault->points[which] += item == path->count;
        return;
    }
}

static int name_one(const struct clash_chains *chains, const struct made_fault *fault, int which, char *out,
                    size_t size) {
    if (chains->names_outlines)
        return snprintf(out, size, "point %u of outline %u", fault->points[which] + 1,
                        fault->outlines[which] + 1);
    return snprintf(out, size, "point %u", fault->points[which] + 1);
}

bool clash_fail(const struct clash_chains *chains, const struct region *region, enum region_clash clash,
                struct made_fault *fault) {
    char names[2][64];
    for (uint32_t which = 0; which < 2; which++) {
        blame(chains, region->clash[which], clash != REGION_MEETS, which, fault);
        name_one(chains, fault, (int)which, names[which], sizeof names[which]);
    }
    fault->place = region->place;
    if (!chains->names_outlines)
        fault->outlines[0] = fault->outlines[1] = IR_NO_INDEX;
    const double x = region->place.u, y = region->place.v;
    if (clash == REGION_MEETS)
        return made_fail(fault, MADE_TOUCHES, "%s and %s are at the same place, [%.6g, %.6g]", names[0],
                         names[1], x, y);
    const bool crosses = clash == REGION_CROSSES;
    return made_fail(fault, crosses ? MADE_CROSSES : MADE_TOUCHES,
                     "the line after %s %s that after %s at [%.6g, %.6g]", names[0],
                     crosses ? "crosses" : "touches", names[1], x, y);
}

bool clash_check(const struct clash_chains *chains, struct arena *arena, struct made_fault *fault) {
    struct region region;
    clash_take(chains, arena, &region);
    const enum region_clash clash = region_check(&region);
    return clash == REGION_FINE || clash_fail(chains, &region, clash, fault);
}
