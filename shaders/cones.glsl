// Cylinders and cones, whole or cut off: convex bodies between the planes of two discs. They lie in the tree of the spheres.
//
// A ray is inside such a body from the larger of two ways to the smaller of two others: those at which it enters and
// leaves the space between the planes, and those of the cone without end. So it cannot slip between the side and a disc,
// whatever is rounded. A ray that leaves the body knows so (ray_offset.glsl): outward it never meets the body again,
// because the body is convex, and inward it always does.

// Where start.b1 says that a ray leaves a cone to.
const REAL LEAVES_OUTWARD = 1.0;
const REAL LEAVES_INWARD = -1.0;

struct way_inside {
    REAL enter, leave;
    bool exists;
};

// Between the planes of the discs, where `z` is the height above the base and `dz` how it changes.
way_inside between_planes(frustum_record body, REAL z, REAL dz) {
    REAL low = -z / dz, high = (body.height - z) / dz;
    way_inside way = way_inside(dz > 0.0 ? low : high, dz > 0.0 ? high : low, true);
    if (dz == 0.0)
        way = way_inside(-FAR_AWAY, FAR_AWAY, z >= 0.0 && z <= body.height);
    return way;
}

// Inside the cone without end, counted from a place of the ray between the planes: `e` and `g` are that place and the
// ray's direction, turned by a right angle across the axis; the radius there, and by how much it grows.
//
// The distance from the axis, less the radius, is below 0 between the roots of a t^2 + 2 b t + c. The discriminant is a
// difference of squares, neither of which changes along the ray: so it does not lose digits near the rim of what is
// seen. Of a ray that is steeper than the side (a < 0) one half lies inside; the other roots' half is on the other half
// of the double cone, which is never between the planes.
way_inside inside_cone(REAL3 e, REAL3 g, REAL radius, REAL growth) {
    REAL a = dot3(g, g) - growth * growth;
    REAL b = dot3(e, g) - radius * growth;
    REAL c = dot3(e, e) - radius * radius;
    REAL3 wide_side = g * radius - e * growth, across = cross3(e, g);
    REAL discriminant = dot3(wide_side, wide_side) - dot3(across, across);
    REAL root = sqrt(max(discriminant, 0.0));
    REAL q = b > 0.0 ? -b - root : root - b;
    REAL far = q / (a == 0.0 ? REAL(-1.0e-37) : a), near = q != 0.0 ? c / q : REAL(0.0);
    REAL first = min(near, far), last = max(near, far);
    way_inside way = way_inside(first, last, discriminant >= 0.0 && q != 0.0);
    if (a <= 0.0)
        way = growth == 0.0 ? way_inside(-FAR_AWAY, FAR_AWAY, c <= 0.0)
                            : way_inside(growth > 0.0 ? last : -FAR_AWAY, growth > 0.0 ? FAR_AWAY : first, true);
    return way;
}

// As test_triangle.
void test_frustum(uint item, bool there, ray_start start, REAL3 direction, inout hit_record hit) {
    frustum_record body = load_frustum(item);
    bool is_left = start.left == (item | ITEM_SPHERE), inward = is_left && start.b1 < 0.0;
    REAL3 f = start.at - body.base;
    REAL z = dot3(f, body.axis), dz = dot3(direction, body.axis);
    way_inside planes = between_planes(body, z, dz);
    // Numbers are small where the ray comes nearest to the axis between the planes.
    REAL3 e = cross3(f, body.axis), g = cross3(direction, body.axis);
    REAL gg = dot3(g, g);
    REAL at = gg > 0.0 ? -dot3(e, g) / gg : planes.enter;
    at = at < planes.enter ? planes.enter : at > planes.leave ? planes.leave : at;
    REAL height = clamp(z + dz * at, 0.0, body.height);
    way_inside cone = inside_cone(e + g * at, g, body.radius + body.slope * height, body.slope * dz);
    REAL enter = at + cone.enter, leave = at + cone.leave;
    bool by_side = enter > planes.enter, out_by_side = leave < planes.leave;
    REAL first = by_side ? enter : planes.enter, last = out_by_side ? leave : planes.leave;
    bool crosses = planes.exists && cone.exists && first <= last && !is_left;
    bool enters = !inward && first > 0.0;
    REAL t = enters ? first : inward ? max(last, 0.0) : last;
    bool nearer = t < hit.t || (t == hit.t && body.number < hit.number);
    if (there && (inward || (crosses && last > 0.0)) && nearer) {
        hit.t = t;
        hit.b1 = (enters ? by_side : out_by_side) ? FACE_SIDE : (dz > 0.0) == enters ? FACE_BASE : FACE_TOP;
        hit.b2 = enters ? 1.0 : 0.0;
        hit.item = item | ITEM_SPHERE;
        hit.number = body.number;
    }
}
