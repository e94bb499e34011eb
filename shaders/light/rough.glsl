// Rough surfaces (docs/language.md, "Roughness"): reflection and refraction by the normal of a facet, drawn for each ray
// among those that it sees.

// Facets are those of GGX (Walter, Marschner, Li, Torrance 2007), seen ones as Heitz 2018 draws them ("Sampling the GGX
// Distribution of Visible Normals"), by the shorter way of Dupuy and Benyoub 2023 ("Sampling Visible GGX Normals with
// Spherical Caps"). `key`, `d`: of the ray. A picture's only sample finds the surface smooth.
void roughen(REAL3 d, uint key, inout surface s) {
    s.micro = s.shading;
    bool drawn = s.alpha > 0.0 && frame.point_bits > OPAQUE_ZERO;
    if (!drawn)
        s.alpha = 0.0;
    if (drawn) {
        REAL3 n = dot3(d, s.shading) < 0.0 ? s.shading : s.geometric, a, b;
        frame_around(n, a, b);
        REAL alpha = REAL(s.alpha);
        vec2 point = point_at(point_key(key, POINT_ROUGH));
        REAL3 seen = unit3(REAL3(-alpha * dot3(d, a), -alpha * dot3(d, b), -dot3(d, n)));
        REAL height = (1.0 - REAL(point.y)) * (1.0 + seen.z) - seen.z;
        REAL2 around = turn_by(4.0 * REAL(point.x)) * sqrt(max(1.0 - height * height, 0.0));
        REAL3 half_way = REAL3(around, height) + seen;
        half_way = unit3(REAL3(alpha * half_way.xy, max(half_way.z, 1.0e-12)));
        s.micro = unit3(a * half_way.x + b * half_way.y + n * half_way.z);
    }
}
