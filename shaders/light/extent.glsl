// Lights with extent: where a sample takes them (docs/language.md, "Soft light").

struct light_spot {
    REAL3 place; // of a light that is not infinitely far away
    REAL3 l;     // unit, towards it
    REAL share;  // of what a light at that point would add
};

// A direction in a cap around `axis`, all equally likely; `gap`: 1 - cosine of its half angle. `lacks`: 1 - the cosine to
// the axis.
REAL3 in_cap(REAL3 axis, REAL gap, uint key, out REAL lacks) {
    REAL2 at = disc_point(point_at(key));
    lacks = gap * (at.x * at.x + at.y * at.y);
    return turned_to(axis, at * sqrt(gap * (2.0 - lacks)), 1.0 - lacks);
}

// Where the sample takes a light with extent. `l`, `distance2`: to its middle. `ray_key`: the key of the ray that hit the
// surface.
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
        // If a body has the same sphere, in front of it, by the possible rounding of the sphere and of a long ray.
        REAL reach = inside ? extent.radius - extent.before_body : extent.radius + extent.before_body;
        REAL deep = sqrt(max(reach * reach - beside2, 0.0)), middle = sqrt(distance2) * (1.0 - lacks);
        REAL t = inside ? middle + deep : middle - deep;
        t -= t * (extent.before_body > 0.0 ? 1.9073486328125e-6 : 0.0);
        if (!disc)
            spot.place = point + spot.l * t;
    }
    return spot;
}
