// Lights that rays see (docs/language.md, "Lights that are seen"): only a path's own rays see them.

struct seen_light {
    REAL t;        // how far away it is; before one is found, how far the ray goes
    uint number;   // of the scene's lights, from 1 on; 0: none
    vec3 radiance;
};

seen_light no_light(REAL t_max) { return seen_light(t_max, 0u, vec3(0.0)); }

// Where a ray enters a sphere from outside; below 0: nowhere. `way`: from its start to the middle.
REAL sphere_ahead(REAL3 way, REAL3 direction, REAL radius) {
    REAL middle = dot3(way, direction);
    REAL3 beside = way - direction * middle;
    REAL deep = radius * radius - dot3(beside, beside);
    bool hits = deep >= 0.0 && dot3(way, way) > radius * radius;
    return hits ? middle - sqrt(max(deep, 0.0)) : -1.0;
}

REAL panel_ahead(REAL3 way, REAL3 direction, seen_record light) {
    REAL below = dot3(direction, light.outward);
    REAL t = dot3(way, light.outward) / below;
    REAL3 place = direction * t - way;
    bool hits = below < 0.0 && abs(dot3(place, light.along_u)) <= 1.0 && abs(dot3(place, light.along_v)) <= 1.0;
    return hits ? t : -1.0;
}

// The nearest one with a place before seen.t.
void see_lights(REAL3 start, REAL3 direction, inout seen_light seen) {
    uint count = frame.seen_count + OPAQUE_ZERO;
    for (uint i = 0u; i < count; i++) {
        seen_record light = load_seen(i);
        REAL3 way = light.place - start;
        REAL t = sphere_ahead(way, direction, light.size);
        if ((light.flags & LIGHT_PANEL) != 0u)
            t = panel_ahead(way, direction, light);
        bool nearer = (light.flags & LIGHT_DIRECTIONAL) == 0u && t > 0.0 && t < seen.t;
        if (nearer)
            seen = seen_light(t, light.light + 1u, light.radiance);
    }
}

// What is seen if nothing is hit: the background, and discs in front of it. Uses the sine of the angle to their middle,
// which has the digits that small discs need.
vec3 seen_beyond(REAL3 direction) {
    vec3 sum = background(direction);
    uint count = HAS_SEEN_LIGHT ? frame.seen_count + OPAQUE_ZERO : 0u;
    for (uint i = 0u; HAS_SEEN_LIGHT && i < count; i++) {
        seen_record light = load_seen(i);
        REAL3 across = cross3(direction, light.place);
        bool inside = (light.flags & LIGHT_DIRECTIONAL) != 0u && dot3(direction, light.place) > 0.0 &&
                      dot3(across, across) <= light.size * light.size;
        sum += inside ? light.radiance : vec3(0.0);
    }
    return sum;
}
