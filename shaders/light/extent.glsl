// Lights with extent: where a sample takes them (docs/language.md, "Soft light").

// The unit disc, area by area, from the unit square: Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square".
// Sine and cosine are Taylor's series up to pi / 4.
#ifdef DOUBLE_PRECISION
const double QUARTER_PI = 0.78539816339744831lf;
#else
const float QUARTER_PI = 0.785398163;
#endif

REAL2 disc_of(vec2 point) {
    REAL2 at = REAL2(point) * 2.0 - 1.0;
    bool wide = abs(at.x) > abs(at.y);
    REAL r = wide ? at.x : at.y, other = wide ? at.y : at.x;
    REAL x = r == 0.0 ? 0.0 : QUARTER_PI * (other / r), z = x * x;
#ifdef DOUBLE_PRECISION
    REAL s = 1.0 - z / 272.0, c = 1.0 - z / 240.0;
    s = 1.0 - z / 210.0 * s;
    c = 1.0 - z / 182.0 * c;
    s = 1.0 - z / 156.0 * s;
    c = 1.0 - z / 132.0 * c;
    s = 1.0 - z / 110.0 * s;
    c = 1.0 - z / 90.0 * c;
#else
    REAL s = 1.0, c = 1.0 - z / 90.0;
#endif
    s = 1.0 - z / 72.0 * s;
    c = 1.0 - z / 56.0 * c;
    s = 1.0 - z / 42.0 * s;
    c = 1.0 - z / 30.0 * c;
    s = 1.0 - z / 20.0 * s;
    c = 1.0 - z / 12.0 * c;
    s = x * (1.0 - z / 6.0 * s);
    c = 1.0 - z / 2.0 * c;
    return wide ? REAL2(r * c, r * s) : REAL2(r * s, r * c);
}

// across.x along a first and across.y along a second unit vector at right angles to the unit vector n, and `along` along n:
// Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
REAL3 turned_to(REAL3 n, REAL2 across, REAL along) {
    REAL side = n.z < 0.0 ? -1.0 : 1.0;
    REAL a = -1.0 / (side + n.z), b = n.x * n.y * a;
    REAL3 first = REAL3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    REAL3 second = REAL3(b, side + n.y * n.y * a, -n.y);
    return first * across.x + second * across.y + n * along;
}

struct light_spot {
    REAL3 place; // of a light that is not infinitely far away
    REAL3 l;     // unit, towards it
    REAL share;  // of what a point there would add
};

// In a cap around `axis` of directions that all count alike; `gap`: 1 - cosine of its half angle. `along` is what the cosine
// to the axis lacks of 1.
REAL3 in_cap(REAL3 axis, REAL gap, uint key, out REAL lacks) {
    REAL2 at = disc_of(point_at(key));
    lacks = gap * (at.x * at.x + at.y * at.y);
    return turned_to(axis, at * sqrt(gap * (2.0 - lacks)), 1.0 - lacks);
}

// Where the sample takes a light with extent. `l`, `distance2`: to its middle. `ray_key`: of the ray that hit the surface.
light_spot spot_of(uint index, light_record light, REAL3 point, REAL3 l, REAL distance2, uint ray_key) {
    extent_record extent = load_extent(index);
    uint key = point_key(ray_key, POINT_LIGHT + index);
    light_spot spot = light_spot(light.place, l, 1.0);
    if ((light.flags & LIGHT_PANEL) != 0u) {
        REAL2 at = REAL2(point_at(key)) - 0.5;
        spot.place = light.place + extent.edge_u * at.x + extent.edge_v * at.y;
        REAL3 way = spot.place - point;
        REAL near2 = dot3(way, way);
        spot.l = way * (1.0 / sqrt(near2));
        spot.share = max(-dot3(spot.l, extent.outward), 0.0);
        if (HAS_INVERSE_SQUARE && (light.flags & LIGHT_INVERSE_SQUARE) != 0u)
            spot.share *= distance2 / near2;
        spot.share = near2 > 0.0 ? spot.share : 0.0;
    } else {
        REAL radius2 = extent.radius * extent.radius;
        bool disc = (light.flags & LIGHT_DIRECTIONAL) != 0u, inside = radius2 >= distance2;
        REAL sine2 = inside ? 1.0 : radius2 / distance2;
        REAL gap = disc ? extent.gap : sine2 / (1.0 + sqrt(1.0 - sine2)), lacks;
        spot.l = in_cap(l, gap, key, lacks);
        spot.share = 2.0 / (2.0 - gap);
        // Where the sphere is hit; from inside it, on the far side.
        REAL beside2 = distance2 * lacks * (2.0 - lacks);
        REAL deep = sqrt(max(radius2 - beside2, 0.0)), middle = sqrt(distance2) * (1.0 - lacks);
        REAL t = inside ? middle + deep : middle - deep;
        if (!disc)
            spot.place = point + spot.l * t;
    }
    return spot;
}
