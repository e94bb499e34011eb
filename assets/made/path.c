#include "assets/made/path.h"

#include "assets/made/fault.h"

bool path_check_numbers(const struct ir_pair *points, uint32_t count, struct made_fault *fault) {
    for (uint32_t i = 0; i < count; i++) {
        if (fabs(points[i].u) <= MESH_COORDINATE_MAX && fabs(points[i].v) <= MESH_COORDINATE_MAX)
            continue;
        fault->points[0] = i;
        return made_fail(fault, MADE_NUMBER, "point %u is not two numbers up to 1e18", i + 1);
    }
    return true;
}

// ---- pieces

static bool push(struct path *path, struct arena *arena, struct path_piece piece) {
    if (path->count >= MADE_POINTS_MOST)
        return false;
    piece.length_before = path->length;
    path->length += plane_distance(piece.from, piece.to);
    piece.length_after = path->length;
    if (ARENA_IS_FULL(path))
        path->pieces = arena_regrow(arena, path->pieces, path->count, &path->capacity, sizeof *path->pieces);
    path->pieces[path->count++] = piece;
    return true;
}

bool path_add_line(struct path *path, struct arena *arena, struct ir_pair from, struct ir_pair to,
                   uint32_t source) {
    const struct ir_pair along = plane_direction(from, to);
    return plane_same(from, to) ||
           push(path, arena, (struct path_piece){from, to, along, along, 0, 0, source});
}

static uint32_t pieces_of(const struct ir_pair b[4], double tolerance) {
    double most = 0;
    for (int i = 0; i < 2; i++) {
        const struct ir_pair ends = plane_add(b[i], b[i + 2]);
        most = fmax(most, plane_distance(plane_mul(b[i + 1], 2), ends));
    }
    const double count = ceil(sqrt(0.75 * most / tolerance));
    return count > MADE_PIECES_MOST ? MADE_PIECES_MOST : count > 1 ? (uint32_t)count : 1;
}

static struct ir_pair cubic_at(const struct ir_pair b[4], double t) {
    const double s = 1 - t;
    const double weights[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    struct ir_pair sum = {0, 0};
    for (int i = 0; i < 4; i++)
        sum = plane_add(sum, plane_mul(b[i], weights[i]));
    return plane_point(sum);
}

// Where control points coincide, the direction is that to the next one that differs.
static struct ir_pair cubic_along(const struct ir_pair b[4], double t) {
    const struct ir_pair zero = {0, 0};
    if (t == 0)
        return plane_direction(b[0], !plane_same(b[0], b[1]) ? b[1] : !plane_same(b[0], b[2]) ? b[2] : b[3]);
    if (t == 1)
        return plane_direction(!plane_same(b[2], b[3]) ? b[2] : !plane_same(b[1], b[3]) ? b[1] : b[0], b[3]);
    const double s = 1 - t;
    const double weights[3] = {s * s, 2 * s * t, t * t};
    struct ir_pair sum = zero;
    for (int i = 0; i < 3; i++)
        sum = plane_add(sum, plane_mul(plane_sub(b[i + 1], b[i]), weights[i]));
    return plane_same(sum, zero) ? plane_direction(b[0], b[3]) : plane_direction(zero, sum);
}

bool path_add_cubic(struct path *path, struct arena *arena, const struct ir_pair b[4], double tolerance,
                    uint32_t source) {
    const uint32_t count = pieces_of(b, tolerance);
    struct ir_pair from = b[0];
    struct ir_pair along = cubic_along(b, 0);
    for (uint32_t i = 1; i <= count; i++) {
        const double t = (double)i / count;
        const struct ir_pair to = i < count ? cubic_at(b, t) : b[3];
        const struct ir_pair after = cubic_along(b, t);
        if (plane_same(from, to))
            continue;
        if (!push(path, arena, (struct path_piece){from, to, along, after, 0, 0, source}))
            return false;
        from = to;
        along = after;
    }
    return true;
}

// ---- curves through points

// The points without repetitions.
struct knots {
    struct ir_pair *at;
    uint32_t *source;
    bool *is_corner;
    uint32_t count;
};

static struct knots find_knots(const struct path_curve *curve, struct arena *arena) {
    struct knots k = {ARENA_ARRAY(arena, struct ir_pair, curve->count),
                      ARENA_ARRAY(arena, uint32_t, curve->count), ARENA_ARRAY(arena, bool, curve->count), 0};
    for (uint32_t i = 0; i < curve->count; i++) {
        const struct ir_pair at = plane_point(curve->points[i]);
        if (k.count > 0 && plane_same(k.at[k.count - 1], at)) {
            k.is_corner[k.count - 1] = true;
            continue;
        }
        k.at[k.count] = at;
        k.source[k.count++] = i;
    }
    if (curve->is_closed && k.count > 1 && plane_same(k.at[0], k.at[k.count - 1])) {
        k.is_corner[0] |= k.is_corner[k.count - 1];
        k.count--;
    }
    return k;
}

// The control point beside `i` on the way to `to`, where `beyond` comes before `i`.
static struct ir_pair control_beside(struct ir_pair beyond, struct ir_pair i, struct ir_pair to) {
    const double a2 = plane_distance(beyond, i), b2 = plane_distance(i, to);
    const double a = sqrt(a2), b = sqrt(b2);
    const struct ir_pair sum =
        plane_add(plane_sub(plane_mul(to, a2), plane_mul(beyond, b2)), plane_mul(i, 2 * a2 + 3 * a * b + b2));
    return plane_mul(sum, 1 / (3 * a * (a + b)));
}

// The control point beside `i` of the piece between `i` and `other`, which comes after `i` if the piece goes
// forward. false: no point beyond `i` shapes the curve there.
static bool find_control(const struct path_curve *curve, const struct knots *k, uint32_t i, uint32_t other,
                         bool forward, struct ir_pair *out) {
    const struct ir_pair at = k->at[i], to = k->at[other];
    if (k->is_corner[i])
        return false;
    if (curve->is_mirrored && at.u == 0) {
        *out = (struct ir_pair){to.u / 3, at.v};
        return true;
    }
    if (!curve->is_closed && i == (forward ? 0 : k->count - 1))
        return false;
    const uint32_t beyond = forward ? (i + k->count - 1) % k->count : (i + 1) % k->count;
    *out = control_beside(k->at[beyond], at, to);
    return true;
}

// The control point of a parabola that leaves `from` towards `other`, the control point beside `to`.
static struct ir_pair bend_towards(struct ir_pair from, struct ir_pair to, struct ir_pair other) {
    const struct ir_pair tip = plane_add(to, plane_mul(plane_sub(other, to), 1.5));
    return plane_mix(from, tip, 2.0 / 3);
}

// At an end without a point beyond it the piece is a parabola; between two such ends it is straight.
static void set_controls(const struct path_curve *curve, const struct knots *k, uint32_t i, uint32_t j,
                         struct ir_pair b[4]) {
    b[0] = k->at[i];
    b[3] = k->at[j];
    b[1] = plane_mix(b[0], b[3], 1.0 / 3);
    b[2] = plane_mix(b[0], b[3], 2.0 / 3);
    const bool has_first = find_control(curve, k, i, j, true, &b[1]);
    const bool has_second = find_control(curve, k, j, i, false, &b[2]);
    if (!has_first && has_second)
        b[1] = bend_towards(b[0], b[3], b[2]);
    if (!has_second && has_first)
        b[2] = bend_towards(b[3], b[0], b[1]);
}

static bool add_piece(const struct path_curve *curve, const struct knots *k, uint32_t i, struct arena *arena,
                      struct path *out) {
    const uint32_t j = (i + 1) % k->count;
    const bool on_axis = curve->is_mirrored && k->at[i].u == 0 && k->at[j].u == 0;
    if (!curve->smooth || on_axis)
        return path_add_line(out, arena, k->at[i], k->at[j], k->source[i]);
    struct ir_pair control[4];
    set_controls(curve, k, i, j, control);
    return path_add_cubic(out, arena, control, curve->tolerance, k->source[i]);
}

bool path_make(const struct path_curve *curve, struct arena *arena, struct path *out) {
    *out = (struct path){0};
    const struct knots k = find_knots(curve, arena);
    out->knot_count = k.count;
    const uint32_t pieces = k.count < 2 ? 0 : curve->is_closed ? k.count : k.count - 1;
    bool fits = true;
    for (uint32_t i = 0; fits && i < pieces; i++)
        fits = add_piece(curve, &k, i, arena, out);
    return fits;
}
