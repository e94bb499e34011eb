#include "assets/made/bevel.h"

enum {
    HALVINGS = 24,
};

static struct ir_pair direction_of(const struct region *region, uint32_t side) {
    return plane_direction(region->places[region->sides[side].from], region->places[region->sides[side].to]);
}

// Where the lines beside both sides of a corner cross, seen from the corner, for a distance of 1. false: the
// corner turns back so sharply that, as far as doubles tell, they are parallel.
static bool find_mitre(struct ir_pair before, struct ir_pair after, struct ir_pair *out) {
    const struct ir_pair sum = {-before.v - after.v, before.u + after.u};
    // The same as 1 + before * after, which would be nothing but rounding at a sharp corner.
    const double share = plane_dot(sum, sum) / 2;
    *out = plane_mul(sum, 1 / share);
    return share > 0;
}

static bool move_corners(const struct region *region, double distance, struct ir_pair *points) {
    for (uint32_t i = 0; i < region->side_count; i++) {
        const struct region_side *side = &region->sides[i];
        struct ir_pair by;
        if (!find_mitre(direction_of(region, i), direction_of(region, side->next), &by))
            return false;
        points[i] = plane_add(region->places[side->to], plane_mul(by, distance));
    }
    return true;
}

// Whether each side, from the corner before it to its own, keeps its direction.
static bool keeps_sides(const struct region *region, const struct region_edge *edges,
                        struct ir_pair *points) {
    for (uint32_t i = 0; i < region->side_count; i++) {
        const struct ir_pair moved = plane_sub(points[edges[i].to], points[edges[i].from]);
        if (!(plane_dot(moved, direction_of(region, i)) > 0))
            return false;
    }
    return true;
}

static bool keeps_area(const struct region *inset) {
    bool keeps = inset->side_count == inset->edge_count;
    for (uint32_t i = 0; keeps && i < inset->side_count; i++)
        keeps = !inset->sides[i].is_reversed;
    return keeps;
}

bool bevel_make(const struct region *region, double distance, struct region *inset) {
    struct arena *arena = region->arena;
    struct ir_pair *points = ARENA_ARRAY(arena, struct ir_pair, region->side_count);
    struct region_edge *edges = ARENA_ARRAY(arena, struct region_edge, region->side_count);
    for (uint32_t i = 0; i < region->side_count; i++) {
        edges[i].to = i;
        edges[region->sides[i].next].from = i;
    }
    *inset = (struct region){.arena = arena,
                             .points = points,
                             .point_count = region->side_count,
                             .edges = edges,
                             .edge_count = region->side_count};
    return move_corners(region, distance, points) && keeps_sides(region, edges, points) &&
           region_cut(inset) == REGION_FINE && keeps_area(inset);
}

struct trial {
    const struct region *region;
    struct arena arena;
    double distance;
    bool fits;
};

static void run_trial(void *context) {
    struct trial *trial = context;
    struct region region = *trial->region, inset;
    region.arena = &trial->arena;
    trial->fits = bevel_make(&region, trial->distance, &inset);
}

// In memory of its own, which ends with the trial.
static bool fits(const struct region *region, double distance) {
    struct trial trial = {.region = region, .distance = distance};
    arena_init(&trial.arena, region->arena->cap_bytes);
    const enum arena_fault fault = arena_guarded(&trial.arena, run_trial, &trial);
    arena_finish(&trial.arena);
    if (fault != ARENA_FAULT_NONE)
        arena_raise(region->arena, fault);
    return trial.fits;
}

double bevel_largest(const struct region *region, double most) {
    double fitting = 0;
    double step = most;
    for (int i = 0; i < HALVINGS; i++) {
        step /= 2;
        if (fits(region, fitting + step))
            fitting += step;
    }
    return fitting;
}
