// Where light that a surface reflects or refracts comes from (docs/language.md, "Reflected", "Refracted").

REAL3 mirrored(REAL3 d, REAL3 n) { return d - n * (2.0 * dot3(d, n)); }

// A ray that a rough surface would send to its wrong side is turned back by another facet.
REAL3 reflected(REAL3 d, surface s) {
    REAL3 n = s.shading;
    if (HAS_ROUGHNESS)
        n = s.micro;
    REAL3 r = mirrored(d, n);
    if (HAS_ROUGHNESS && s.alpha > 0.0 && dot3(r, s.geometric) < 0.0)
        r = mirrored(r, s.geometric);
    r = dot3(r, s.geometric) > 0.0 ? r : mirrored(d, s.geometric);
    return unit3(r);
}

// The index on the ray's side over that on the other side.
REAL index_ratio(surface s) {
    REAL eta = s.enters ? 1.0 / s.index : s.index;
    if (HAS_SIDES)
        eta = s.index_before / s.index_after;
    return eta;
}

// false: total reflection. `t` equals `d`, bit for bit, where nothing bends. `c`, `k`: the cosine to the normal that
// bends, and the squared cosine behind it.
bool refracted(REAL3 d, surface s, out REAL3 t, out REAL c, out REAL k) {
    REAL eta = index_ratio(s);
    REAL3 n = s.shading;
    if (HAS_ROUGHNESS)
        n = s.micro;
    c = -dot3(d, n);
    REAL c_flat = -dot3(d, s.geometric);
    bool flat_normal = c <= 0.0;
    n = flat_normal ? s.geometric : n;
    c = flat_normal ? c_flat : c;
    k = 1.0 - eta * eta * (1.0 - c * c);
    REAL3 bent = d * eta + n * (eta * c - sqrt(max(k, 0.0)));
    if (HAS_ROUGHNESS && s.alpha > 0.0 && dot3(bent, s.geometric) > 0.0)
        bent = mirrored(bent, s.geometric);
    bool wrong_side = k >= 0.0 && dot3(bent, s.geometric) >= 0.0;
    REAL k_flat = 1.0 - eta * eta * (1.0 - c_flat * c_flat);
    REAL3 bent_flat = d * eta + s.geometric * (eta * c_flat - sqrt(max(k_flat, 0.0)));
    bent = wrong_side ? bent_flat : bent;
    k = wrong_side ? k_flat : k;
    c = wrong_side ? c_flat : c;
    bool straight = !s.solid || eta == 1.0;
    t = straight ? d : unit3(bent);
    if (HAS_ROUGHNESS && s.alpha > 0.0 && !s.solid)
        t = unit3(mirrored(reflected(d, s), s.geometric));
    return straight || k >= 0.0;
}

// A pane has two faces, between which light goes back and forth.
REAL of_faces(REAL one, bool pane) { return pane ? 2.0 * one / (1.0 + one) : one; }

// The share of unpolarised light that is reflected between the indices n and m (Fresnel 1823; Born and Wolf 1999, section
// 1.5.2). `c`, `k`: as from refracted().
float fresnel_share(REAL n, REAL m, REAL c, REAL k, bool pane) {
    REAL t = sqrt(max(k, 0.0));
    REAL across = (n * c - m * t) / (n * c + m * t), along = (m * c - n * t) / (m * c + n * t);
    REAL both = 0.5 * (of_faces(across * across, pane) + of_faces(along * along, pane));
    return float(n == m ? 0.0 : k <= 0.0 ? 1.0 : both);
}

// The cones of rays that leave a surface: the wider the cone is there, the more the normal turns across it.
RAY_CONE mirrored_cone(surface s, RAY_CONE cone) { return REAL2(s.width, cone.y + 2.0 * s.bend * s.width); }

RAY_CONE bent_cone(surface s, RAY_CONE cone, REAL3 from, REAL3 to) {
    REAL eta = index_ratio(s);
    REAL along = dot3(to, s.shading) - eta * dot3(from, s.shading);
    bool straight = !s.solid || eta == 1.0;
    return REAL2(s.width, straight ? cone.y : eta * cone.y + along * s.bend * s.width);
}

// The rays that leave a surface.
struct scatter_rays {
    REAL3 bent;                   // direction of the refracted ray
    float reflection, refraction; // factors of the ray's throughput; 0: no such ray
    bool total;                   // the mirrored ray also has the refracted one's weight
    vec3 color;                   // with HAS_REFLECTION_COLOR: what the mirrored ray keeps of each channel
};

// A metal mirrors its colour straight on and ever more of white towards grazing rays (Schlick 1994). The share that is turned
// back inside has no colour.
vec3 mirror_color(REAL3 d, surface s, bool total) {
    REAL3 n = s.shading;
    if (HAS_ROUGHNESS)
        n = s.micro;
    REAL c = -dot3(d, n);
    c = c > 0.0 ? c : -dot3(d, s.geometric);
    float past = clamp(1.0 - float(c), 0.0, 1.0), square = past * past;
    vec3 color = s.mirror;
    color = s.metal ? color + (1.0 - color) * (square * square * past) : color;
    bool both = total && !(HAS_FRESNEL && s.fresnel);
    return both ? (color * s.reflection + s.refraction) / (s.reflection + s.refraction) : color;
}

scatter_rays scatter(REAL3 direction, surface s) {
    scatter_rays rays = scatter_rays(direction, HAS_REFLECTION ? s.reflection : 0.0, 0.0, false, vec3(1.0));
    REAL c, k;
    bool refracts = HAS_REFRACTION && s.refraction > 0.0;
    if (HAS_REFRACTION || HAS_FRESNEL) {
        bool through = refracted(direction, s, rays.bent, c, k) && refracts;
        rays.total = refracts && !through;
        rays.reflection = rays.total ? s.reflection + s.refraction : rays.reflection;
        rays.refraction = through ? s.refraction : 0.0;
    }
    if (HAS_FRESNEL) {
        float share = fresnel_share(s.index_before, s.index_after, c, k, !s.solid && refracts);
        rays.reflection = s.fresnel ? (HAS_REFLECTION ? s.reflection : 0.0) * share : rays.reflection;
        rays.refraction = s.fresnel ? rays.refraction * (1.0 - share) : rays.refraction;
    }
    if (HAS_REFLECTION_COLOR)
        rays.color = mirror_color(direction, s, rays.total);
    if (HAS_MEDIA && s.passes)
        rays = scatter_rays(direction, 0.0, 1.0, false, vec3(1.0));
    return rays;
}
