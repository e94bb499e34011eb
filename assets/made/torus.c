#include "assets/made/made.h"

#include "assets/made/fault.h"
#include "assets/made/revolve.h"

// The circle of the tube, from its outermost point upwards.
static void add_circle(const struct made_torus *torus, uint32_t count, struct path *path) {
    struct vec3_turn before = vec3_turn_of(0);
    for (uint32_t i = 0; i < count; i++) {
        const struct vec3_turn after = vec3_turn_of(i + 1 < count ? 360.0 * (i + 1) / count : 0);
        struct path_piece *piece = &path->pieces[path->count++];
        *piece = (struct path_piece){
            .from = {torus->radius + torus->tube * before.cosine, torus->tube * before.sine},
            .to = {torus->radius + torus->tube * after.cosine, torus->tube * after.sine},
            .along_from = {-before.sine, before.cosine},
            .along_to = {-after.sine, after.cosine},
            .length_before = i,
            .length_after = i + 1,
        };
        before = after;
    }
    path->length = count;
}

bool made_build_torus(const struct made_torus *torus, const struct made_to *to, struct made *out) {
    made_begin(out);
    struct made_fault *fault = &out->fault;
    if (!made_check_size(torus->radius, "the radius", fault) ||
        !made_check_size(torus->tube, "the tube", fault) || !made_check_tolerance(torus->tolerance, fault))
        return false;
    fault->most = torus->radius;
    if (torus->tube > torus->radius)
        return made_fail(fault, MADE_TUBE, "the tube, %.6g, is larger than the radius, %.6g", torus->tube,
                         torus->radius);
    fault->most = 0;
    // Half of the tolerance around the tube, half around the axis; both are shares of radius and tube
    // together.
    const double share = torus->tolerance / 2;
    const double share_of_tube = share * ((torus->radius + torus->tube) / torus->tube);
    const uint32_t count = revolve_columns(360, share_of_tube);
    struct path path = {.pieces = ARENA_ARRAY(to->arena, struct path_piece, count)};
    add_circle(torus, count, &path);
    return revolve_build(&(struct revolve){&path, true, 360, revolve_columns(360, share)}, to, out);
}
