// What a surface shows without any light, and ambient light with what blocks it (docs/language.md, "Ambient light").

bool is_occluded() { return HAS_OCCLUSION && wants(FEATURE_OCCLUSION); }

// Light that nothing can block.
vec3 own_light(surface s) {
    vec3 sum = vec3(0.0);
    if (HAS_EMISSION)
        sum = s.emission;
    if (HAS_AMBIENT && HAS_DIFFUSE)
        sum += is_occluded() ? vec3(0.0) : s.diffuse * frame.ambient;
    return sum;
}

// Numbers of the lights, and after them those of ambient light and the background: everything that a surface sends
// shadow rays to.
uint light_end() {
    uint end = frame.light_count + (is_occluded() ? 1u : 0u);
    if (HAS_SKY_LIGHT)
        end += frame.sky_rows > OPAQUE_ZERO ? 1u : 0u;
    return end;
}
bool is_sky(uint index) { return HAS_SKY_LIGHT && frame.sky_rows > OPAQUE_ZERO && index + 1u == light_end(); }

// A direction in the hemisphere, by its cosine (Malley's method; Pharr et al. 2016, section 13.6.3), reaching as far as
// `occlusion`.
light_ray ambient_ray(surface s, REAL3 start, uint ray_key) {
    REAL2 at = disc_point(point_at(point_key(ray_key, POINT_AMBIENT)));
    REAL3 l = turned_to(s.shading, at, sqrt(max(1.0 - dot3(REAL3(at, 0.0), REAL3(at, 0.0)), 0.0)));
    light_ray ray;
    // Not a difference of two places: if it is short compared with the coordinates, their rounding would turn
    // it.
    ray.direction = l * frame.occlusion;
    ray.place = start + ray.direction;
    ray.t_max = 1.0;
    ray.value = vec3(0.0);
    if (HAS_DIFFUSE)
        ray.value = dot3(s.geometric, l) > 0.0 ? s.diffuse * frame.ambient : vec3(0.0);
    return ray;
}
