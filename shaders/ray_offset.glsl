// Where a ray that leaves a surface starts, so that it does not hit that surface again.

// For rays that leave on the side of `side` (unit): the point is displaced by its error, then by one number
// outward (Pharr, Jakob, Humphreys 2023, section 6.8.6). The error along the normal is not enough: the error
// along the surface can carry the point across an edge, where a neighbour bends away.
REAL3 ray_offset(REAL3 point, REAL3 error, REAL3 side) {
#ifdef ALTERNATIVES
    if (alternative_moves())
        return point + side * error.x;
#endif
    REAL distance = max(dot3(abs(side), error), largest3(error));
    REAL3 shift = side * distance;
    REAL3 moved = point + shift;
    return REAL3(next_real(moved.x, shift.x), next_real(moved.y, shift.y), next_real(moved.z, shift.z));
}

// The start of a ray that leaves the surface of a hit on the side of `side`. A ray that leaves a sphere or a cone starts
// exactly at the moved point; one that leaves a triangle starts on the triangle, and is moved only for the first tests.
ray_start leave(surface s, hit_record hit, REAL3 side) {
    REAL3 at = ray_offset(s.point, s.error, side);
#ifdef ALTERNATIVES
    if (alternative_moves())
        return exact_start(at);
#endif
    if (!HAS_TRIANGLES || (HAS_ROUND && (hit.item & ITEM_SPHERE) != 0u)) {
        if (HAS_CONES) {
            bool outward = (dot3(side, s.geometric) > 0.0) == s.enters;
            return ray_start(at, 0.0, hit.item, outward ? LEAVES_OUTWARD : LEAVES_INWARD, 0.0);
        }
        return exact_start(at);
    }
    // The error, the displacement of at most sqrt(3) times that, and the rounding of both.
    return ray_start(at, 4.25 * largest3(s.error), hit.item, hit.b1, hit.b2);
}
