#include "assets/made/made.h"

#include "assets/made/clash.h"
#include "assets/made/fault.h"
#include "assets/made/prism.h"

static bool check_points(const struct made_extrude *extrude, struct made_fault *fault) {
    uint64_t points = 0;
    if (extrude->count == 0)
        return made_fail(fault, MADE_EMPTY, "there are no outlines");
    for (uint32_t i = 0; i < extrude->count; i++) {
        points += extrude->outlines[i].count;
        if (points > MADE_POINTS_MOST)
            return made_fail(fault, MADE_POINTS_MANY, "outlines have at most %d points",
                             (int)MADE_POINTS_MOST);
        fault->outlines[0] = i;
        if (!path_check_numbers(extrude->outlines[i].points, extrude->outlines[i].count, fault))
            return false;
    }
    fault->outlines[0] = IR_NO_INDEX;
    return true;
}

static bool check(const struct made_extrude *extrude, struct made_fault *fault) {
    return made_check_size(extrude->height, "the height", fault) &&
           made_check_bevel(extrude->bevel, extrude->height, "height", fault) &&
           made_check_tolerance(extrude->tolerance, fault) && check_points(extrude, fault);
}

// Half of the longer side of the box around all points.
static double size_of(const struct made_extrude *extrude) {
    struct ir_pair lower = {INFINITY, INFINITY}, upper = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < extrude->count; i++)
        for (uint32_t k = 0; k < extrude->outlines[i].count; k++) {
            const struct ir_pair at = extrude->outlines[i].points[k];
            lower = (struct ir_pair){fmin(lower.u, at.u), fmin(lower.v, at.v)};
            upper = (struct ir_pair){fmax(upper.u, at.u), fmax(upper.v, at.v)};
        }
    return fmax(upper.u - lower.u, upper.v - lower.v) / 2;
}

static bool make_paths(const struct made_extrude *extrude, struct arena *arena, struct path *paths,
                       struct made_fault *fault) {
    const double tolerance = extrude->tolerance * size_of(extrude);
    uint64_t pieces = 0;
    for (uint32_t i = 0; i < extrude->count; i++) {
        const struct made_outline *outline = &extrude->outlines[i];
        const struct path_curve curve = {.points = outline->points,
                                         .count = outline->count,
                                         .smooth = extrude->smooth,
                                         .is_closed = true,
                                         .tolerance = tolerance};
        const bool fits = path_make(&curve, arena, &paths[i]);
        pieces += paths[i].count;
        if (!fits || pieces > MADE_POINTS_MOST)
            return made_fail(fault, MADE_POINTS_MANY, "the outlines need more than %d straight pieces",
                             (int)MADE_POINTS_MOST);
        if (paths[i].knot_count >= 3)
            continue;
        fault->outlines[0] = i;
        return made_fail(fault, MADE_POINTS_FEW, "outline %u needs three different points", i + 1);
    }
    return true;
}

static struct prism_look *make_looks(const struct path *paths, uint32_t count, struct region *region) {
    struct prism_look *looks = ARENA_ARRAY(region->arena, struct prism_look, region->edge_count);
    uint32_t at = 0;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < paths[i].count; k++) {
            const struct path_piece *piece = &paths[i].pieces[k];
            looks[at++] = (struct prism_look){
                {piece->along_from, piece->along_to},
                {piece->length_before / paths[i].length, piece->length_after / paths[i].length}};
        }
    return looks;
}

bool made_build_extrude(const struct made_extrude *extrude, const struct made_to *to, struct made *out) {
    made_begin(out);
    if (!check(extrude, &out->fault))
        return false;
    struct path *paths = ARENA_ARRAY(to->arena, struct path, extrude->count);
    struct clash_chain *chains = ARENA_ARRAY(to->arena, struct clash_chain, extrude->count);
    if (!make_paths(extrude, to->arena, paths, &out->fault))
        return false;
    for (uint32_t i = 0; i < extrude->count; i++)
        chains[i] = (struct clash_chain){&paths[i], false};
    const struct clash_chains all = {chains, extrude->count, true};
    struct region region;
    clash_take(&all, to->arena, &region);
    region.even_odd = true;
    const enum region_clash clash = region_cut(&region);
    if (clash != REGION_FINE)
        return clash_fail(&all, &region, clash, &out->fault);
    const struct prism prism = {&region, make_looks(paths, extrude->count, &region), 1, extrude->height,
                                extrude->bevel};
    return prism_build(&prism, to, out);
}
