#include "assets/made/made.h"

#include "assets/made/clash.h"
#include "assets/made/fault.h"
#include "assets/made/revolve.h"

static bool check_points(const struct made_lathe *lathe, struct made_fault *fault) {
    double most = 0;
    if (lathe->count > MADE_POINTS_MOST)
        return made_fail(fault, MADE_POINTS_MANY, "a profile has at most %d points", (int)MADE_POINTS_MOST);
    if (!path_check_numbers(lathe->points, lathe->count, fault))
        return false;
    for (uint32_t i = 0; i < lathe->count; i++) {
        most = fmax(most, plane_number(lathe->points[i].u));
        if (lathe->points[i].u >= 0)
            continue;
        fault->points[0] = i;
        return made_fail(fault, MADE_RADIUS, "the radius of point %u is %.6g; it must be at least 0", i + 1,
                         lathe->points[i].u);
    }
    if (lathe->count > 0 && most == 0)
        return made_fail(fault, MADE_AXIS, "all points are on the axis, where the radius is 0");
    return true;
}

static bool check_sizes(const struct made_lathe *lathe, struct made_fault *fault) {
    if (!(lathe->angle > 0 && lathe->angle <= 360))
        return made_fail(fault, MADE_RANGE,
                         "the angle must be more than 0 and at most 360 degrees; it is %.6g", lathe->angle);
    return made_check_tolerance(lathe->tolerance, fault);
}

static double largest_radius(const struct made_lathe *lathe) {
    double most = 0;
    for (uint32_t i = 0; i < lathe->count; i++)
        most = fmax(most, lathe->points[i].u);
    return most;
}

static bool is_ring(const struct made_lathe *lathe) {
    return lathe->count > 3 &&
           plane_same(plane_point(lathe->points[0]), plane_point(lathe->points[lathe->count - 1]));
}

static bool check_axis(const struct path *path, struct made_fault *fault) {
    for (uint32_t i = 0; i < path->count; i++) {
        const struct path_piece *piece = &path->pieces[i];
        if (piece->to.u >= 0)
            continue;
        fault->points[0] = piece->source;
        fault->place = piece->to;
        return made_fail(fault, MADE_CURVE, "the curve after point %u crosses the axis, at y = %.6g",
                         piece->source + 1, piece->to.v);
    }
    return true;
}

static bool check_crossings(const struct path *path, bool ring, struct arena *arena,
                            struct made_fault *fault) {
    const struct clash_chain chain = {path, !ring};
    return clash_check(&(struct clash_chains){&chain, 1, false}, arena, fault);
}

bool made_build_lathe(const struct made_lathe *lathe, const struct made_to *to, struct made *out) {
    made_begin(out);
    if (!check_sizes(lathe, &out->fault) || !check_points(lathe, &out->fault))
        return false;
    const bool ring = is_ring(lathe);
    // A smooth profile has half of the tolerance along it and half around.
    const double share = lathe->smooth ? lathe->tolerance / 2 : lathe->tolerance;
    const struct path_curve curve = {lathe->points, lathe->count, lathe->smooth,
                                     ring,          true,         share * largest_radius(lathe)};
    struct path path;
    if (!path_make(&curve, to->arena, &path))
        return made_fail(&out->fault, MADE_POINTS_MANY, "the curve needs more than %d straight pieces",
                         (int)MADE_POINTS_MOST);
    if (path.count == 0 || (ring && path.knot_count < 3))
        return made_fail(&out->fault, MADE_POINTS_FEW, "a profile needs two different points");
    if (!check_axis(&path, &out->fault) || !check_crossings(&path, ring, to->arena, &out->fault))
        return false;
    const struct revolve revolve = {&path, ring, lathe->angle, revolve_columns(lathe->angle, share)};
    return revolve_build(&revolve, to, out);
}
