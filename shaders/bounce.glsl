// Where light comes from that a surface reflects or refracts (docs/language.md, "Reflected", "Refracted").

vec3 mirrored(vec3 d, vec3 n) { return d - n * (2.0 * dot3(d, n)); }

vec3 reflected(vec3 d, surface s) {
    vec3 r = mirrored(d, s.shading);
    r = dot3(r, s.geometric) > 0.0 ? r : mirrored(d, s.geometric);
    return unit3(r);
}

// false: total reflection. `d` comes out unchanged, bit for bit, where nothing bends.
bool refracted(vec3 d, surface s, out vec3 t) {
    float eta = s.enters ? 1.0 / s.index : s.index;
    float c = -dot3(d, s.shading), c_flat = -dot3(d, s.geometric);
    bool flat_normal = c <= 0.0;
    vec3 n = flat_normal ? s.geometric : s.shading;
    c = flat_normal ? c_flat : c;
    float k = 1.0 - eta * eta * (1.0 - c * c);
    vec3 bent = d * eta + n * (eta * c - sqrt(max(k, 0.0)));
    bool wrong_side = k >= 0.0 && dot3(bent, s.geometric) >= 0.0;
    float k_flat = 1.0 - eta * eta * (1.0 - c_flat * c_flat);
    vec3 bent_flat = d * eta + s.geometric * (eta * c_flat - sqrt(max(k_flat, 0.0)));
    bent = wrong_side ? bent_flat : bent;
    k = wrong_side ? k_flat : k;
    bool straight = !s.solid || eta == 1.0;
    t = straight ? d : unit3(bent);
    return straight || k >= 0.0;
}
