// What a hit is made of: point, error, normals, colours (docs/language.md, "Hit" and "Checker").

struct surface {
    vec3 point;
    vec3 error;      // bound of the point's error, by component
    vec3 geometric;  // unit, towards the viewer
    vec3 shading;    // unit, on the same side
    bool enters;     // the ray comes from outside
    bool solid;      // refraction bends; else a thin pane
    vec3 diffuse;    // weight times colour
    vec3 specular;   // weight times colour
    float exponent;
    bool has_diffuse, has_specular;
    float reflection, refraction, index;
};

bool is_odd(float cells) { return cells - 2.0 * floor(cells * 0.5) != 0.0; }

void read_material(uint material, bool checker, float rectangle_s, float rectangle_t, bool rectangle, uint body,
                   inout surface s) {
    uvec4 w0 = FETCH(materials, material * MATERIAL_WORDS);
    uvec4 w1 = FETCH(materials, material * MATERIAL_WORDS + 1u);
    vec4 weights = uintBitsToFloat(w0);
    vec4 diffuse = uintBitsToFloat(w1);
    if (HAS_DIFFUSE) {
        vec3 color = diffuse.xyz;
        if (HAS_CHECKER) {
            vec4 second = uintBitsToFloat(FETCH(materials, material * MATERIAL_WORDS + 3u));
            vec4 row_x = uintBitsToFloat(FETCH(bodies, body * BODY_WORDS + 1u));
            vec4 row_y = uintBitsToFloat(FETCH(bodies, body * BODY_WORDS + 2u));
            vec4 row_z = uintBitsToFloat(FETCH(bodies, body * BODY_WORDS + 3u));
            vec3 own = vec3(dot3(row_x.xyz, s.point) + row_x.w, dot3(row_y.xyz, s.point) + row_y.w,
                            dot3(row_z.xyz, s.point) + row_z.w) / second.w;
            float cells = rectangle ? floor(rectangle_s * row_x.x / second.w) + floor(rectangle_t * row_x.y / second.w)
                                    : floor(own.x) + floor(own.y) + floor(own.z);
            color = checker && is_odd(cells) ? second.xyz : color;
        }
        s.diffuse = color * weights.x;
        s.has_diffuse = weights.x != 0.0;
    }
    if (HAS_SPECULAR || HAS_REFRACTION) {
        vec4 specular = uintBitsToFloat(FETCH(materials, material * MATERIAL_WORDS + 2u));
        s.specular = specular.xyz * weights.y;
        s.has_specular = weights.y != 0.0;
        s.index = specular.w;
    }
    s.exponent = diffuse.w;
    s.reflection = weights.z;
    s.refraction = weights.w;
}

// Unit; the edges are divided by a power of two first, so that the product of small ones does not vanish.
// Flattening leaves out triangles for which this is not finite.
vec3 triangle_normal(vec3 u, vec3 v) {
    float most = max(largest3(abs(u)), largest3(abs(v)));
    float scale = uintBitsToFloat(0x7f000000u - (floatBitsToUint(most) & 0x7f800000u));
    return unit3(cross3(u * scale, v * scale));
}

void triangle_surface(hit_record hit, vec3 direction, inout surface s) {
    uvec4 w0 = FETCH(triangles, hit.item * TRIANGLE_WORDS);
    uvec4 w1 = FETCH(triangles, hit.item * TRIANGLE_WORDS + 1u);
    uvec4 w2 = FETCH(triangles, hit.item * TRIANGLE_WORDS + 2u);
    vec3 p0 = uintBitsToFloat(w0.xyz), p1 = uintBitsToFloat(w1.xyz), p2 = uintBitsToFloat(w2.xyz);
    float b0 = 1.0 - hit.b1 - hit.b2;
    vec3 q0 = p0 * b0, q1 = p1 * hit.b1, q2 = p2 * hit.b2;
    s.point = q0 + q1 + q2;
    s.error = (abs(q0) + abs(q1) + abs(q2)) * GAMMA_7;
    vec3 outward = triangle_normal(p1 - p0, p2 - p0);
    s.enters = dot3(outward, direction) <= 0.0;
    s.geometric = s.enters ? outward : -outward;
    s.shading = s.geometric;
    s.solid = (w2.w & TRIANGLE_SOLID) != 0u;
    if (HAS_SMOOTH) {
        uvec4 body = FETCH(bodies, w1.w * BODY_WORDS);
        uint base = 3u * (w0.w - body.x) + body.y;
        bool smooth_shaded = (w2.w & TRIANGLE_SMOOTH) != 0u;
        base = smooth_shaded ? base : 0u;
        vec3 n = uintBitsToFloat(FETCH(normals, base).xyz) * b0 +
                 uintBitsToFloat(FETCH(normals, base + 1u).xyz) * hit.b1 +
                 uintBitsToFloat(FETCH(normals, base + 2u).xyz) * hit.b2;
        float length2 = dot3(n, n);
        n = n * (1.0 / sqrt(length2));
        n = dot3(n, s.geometric) < 0.0 ? -n : n;
        s.shading = smooth_shaded && length2 > 0.0 ? n : s.geometric;
    }
    bool second_half = (w2.w & TRIANGLE_RECT_TOP) != 0u;
    float along_u = second_half ? hit.b1 : hit.b1 + hit.b2;
    float along_v = second_half ? hit.b1 + hit.b2 : hit.b2;
    read_material(w2.w & TRIANGLE_MATERIAL, (w2.w & TRIANGLE_CHECKER) != 0u, along_u, along_v,
                  (w2.w & TRIANGLE_RECT) != 0u, w1.w, s);
}

void sphere_surface(hit_record hit, vec3 origin, vec3 direction, inout surface s) {
    uint item = hit.item & ~ITEM_SPHERE;
    uvec4 w0 = FETCH(spheres, item * SPHERE_WORDS);
    uvec4 w1 = FETCH(spheres, item * SPHERE_WORDS + 1u);
    vec3 center = uintBitsToFloat(w0.xyz);
    // Back onto the sphere: the point's error is then that of the radius, whatever the ray's length.
    vec3 outward = unit3(origin + direction * hit.t - center);
    vec3 arm = outward * uintBitsToFloat(w0.w);
    s.point = center + arm;
    s.error = abs(arm) * GAMMA_5 + abs(s.point) * GAMMA_1;
    s.enters = dot3(outward, direction) <= 0.0;
    s.geometric = s.enters ? outward : -outward;
    s.shading = s.geometric;
    s.solid = true;
    read_material(w1.y & TRIANGLE_MATERIAL, (w1.y & TRIANGLE_CHECKER) != 0u, 0.0, 0.0, false, w1.x, s);
}

void make_surface(hit_record hit, vec3 origin, vec3 direction, inout surface s) {
    bool sphere = (hit.item & ITEM_SPHERE) != 0u;
    if (HAS_TRIANGLES && !(HAS_SPHERES && sphere))
        triangle_surface(hit, direction, s);
    if (HAS_SPHERES && (!HAS_TRIANGLES || sphere))
        sphere_surface(hit, origin, direction, s);
}
