// What a hit is made of: point, error, normals, colours (docs/language.md, "Hit" and "Checker").

#include "paint/paint.glsl"

// Which media a ray is inside: media.glsl.
struct media_set {
    uvec4 a, b;
};

struct surface {
    REAL3 point;
    REAL3 error;     // bound of the point's error, by component
    REAL3 geometric; // unit, towards the viewer
    REAL3 shading;   // unit, on the same side
    bool enters;     // the ray comes from outside
    bool solid;      // refraction bends; else a thin pane
    vec3 diffuse;    // weight times colour
    vec3 specular;   // weight times colour
    vec3 emission;
    float exponent;
    bool has_diffuse, has_specular;
    float reflection, refraction;
    vec3 mirror; // with HAS_REFLECTION_COLOR, and:
    bool metal;
    REAL index;
    REAL bend;  // with HAS_FOOTPRINT: how fast the normal turns along the surface, positive where it bulges to the viewer
    REAL width; // and how wide the ray's cone is
    bool fresnel;
    float alpha; // with HAS_ROUGHNESS; 0: smooth
    REAL3 micro; // the normal that then reflects and refracts (light/rough.glsl)
    uint body;
    // For a ray that comes from a place inside certain media (media.glsl).
    REAL index_before, index_after;
    media_set after; // what it is inside once it is through
    bool passes;     // it goes on unseen: nothing changes here
    bool is_over;    // it would be inside more than MEDIA_MOST
};

bool is_odd(REAL cells) { return cells - 2.0 * floor(cells * 0.5) != 0.0; }

// How a checker's coordinates change along an axis of the footprint.
REAL3 cell_change(body_record map, bool is_half, REAL3 axis, REAL2 by, REAL cell) {
    REAL3 change = is_half ? REAL3(by * map.row_x.xy, 0.0)
                           : REAL3(dot3(map.row_x, axis), dot3(map.row_y, axis), dot3(map.row_z, axis));
    return change / cell;
}

// `shade`: material and flags; `along`: the place on a parallelogram, 0..1 along its edges.
void read_material(uint shade, uint body, REAL2 along, paint_spot spot, inout surface s) {
    uint number = shade & TRIANGLE_MATERIAL;
    material_record material = load_material(number);
    bool painted = HAS_PAINT && wants(FEATURE_TEXTURES | FEATURE_FOOTPRINT);
    if (HAS_DIFFUSE) {
        vec3 color = material.diffuse;
        if (HAS_CHECKER) {
            body_record map = load_body(body);
            REAL3 own = REAL3(dot3(map.row_x, s.point) + map.offset_x, dot3(map.row_y, s.point) + map.offset_y,
                              dot3(map.row_z, s.point) + map.offset_z);
            bool is_half = (shade & TRIANGLE_HALF) != 0u, is_checker = (shade & TRIANGLE_CHECKER) != 0u;
            own = (is_half ? REAL3(along * map.row_x.xy, 0.0) : own) / material.cell;
            bool odd = is_odd(floor(own.x) + floor(own.y) + floor(own.z));
            color = is_checker && odd ? material.diffuse_odd : color;
            if (HAS_FOOTPRINT && painted && is_checker && (load_paint(2u * number).flags & PAINT_SOFT) != 0u) {
                REAL3 a = cell_change(map, is_half, spot.axis_along, spot.along, material.cell);
                REAL3 b = cell_change(map, is_half, spot.axis_across, spot.across, material.cell);
                float share = odd_share(own, a, b, is_half);
                color = material.diffuse * (1.0 - share) + material.diffuse_odd * share;
            }
        }
        if (HAS_TEXTURES && painted) {
            paint_record image = load_paint(2u * number);
            if (image.levels != 0u)
                color = image_color(image, spot);
        }
        s.diffuse = color * material.diffuse_weight;
        s.has_diffuse = material.diffuse_weight != 0.0;
    }
    s.specular = material.specular * material.specular_weight;
    if (HAS_SPECULAR && HAS_TEXTURES && painted) {
        paint_record image = load_paint(2u * number + 1u);
        if (image.levels != 0u)
            s.specular = image_color(image, spot) * material.specular_weight;
    }
    s.has_specular = material.specular_weight != 0.0;
    if (HAS_EMISSION)
        s.emission = material.emission;
    s.index = material.refractive_index;
    s.exponent = material.specular_exponent;
    s.reflection = material.reflection;
    s.refraction = material.refraction;
    if (HAS_FRESNEL)
        s.fresnel = material.fresnel != 0u;
    if (HAS_REFLECTION_COLOR) {
        s.mirror = material.mirror;
        s.metal = material.metal != 0u;
    }
    if (HAS_ROUGHNESS)
        s.alpha = material.alpha;
    s.body = body;
}

// The cone's width where it hits a surface, and the axes of the footprint there.
paint_spot begin_spot(REAL t, REAL3 direction, inout surface s) {
    paint_spot spot = paint_spot(REAL2(0.0), REAL2(0.0), REAL2(0.0), REAL3(0.0), REAL3(0.0));
    s.bend = 0.0;
    s.width = 0.0;
    if (HAS_FOOTPRINT) {
        s.width = surface_cone.x + surface_cone.y * t;
        footprint_axes(s.width, direction, s.geometric, spot.axis_along, spot.axis_across);
    }
    return spot;
}

void triangle_spot(triangle_record triangle, hit_record hit, REAL2 along, inout paint_spot spot) {
    bool is_half = (triangle.shade & TRIANGLE_HALF) != 0u;
    REAL2 a = REAL2(0.0), b = REAL2(0.0);
    if (HAS_FOOTPRINT) {
        REAL3 edge1 = triangle.v1 - triangle.v0, edge2 = triangle.v2 - triangle.v0;
        a = weights_along(edge1, edge2, spot.axis_along);
        b = weights_along(edge1, edge2, spot.axis_across);
    }
    uint coordinates = 0u;
    if (HAS_TEXTURES && wants(FEATURE_TEXTURES))
        coordinates = component_of(FETCH(paints, frame.coordinates_table + triangle.body / 4u), triangle.body);
    if (is_half)
        half_spot((triangle.shade & TRIANGLE_SECOND_HALF) != 0u, along, a, b, spot);
    else if (HAS_TEXTURES && coordinates != 0u)
        mesh_spot(coordinates, triangle.number - load_body(triangle.body).first_triangle, hit.b1, hit.b2, a, b, spot);
}

// How fast the normals turn from corner to corner, the mean over the edges.
REAL bend_of(triangle_record triangle, REAL3 n0, REAL3 n1, REAL3 n2) {
    REAL3 e0 = triangle.v1 - triangle.v0, e1 = triangle.v2 - triangle.v1, e2 = triangle.v0 - triangle.v2;
    REAL sum = dot3(n1 - n0, e0) / dot3(e0, e0) + dot3(n2 - n1, e1) / dot3(e1, e1) + dot3(n0 - n2, e2) / dot3(e2, e2);
    return sum / 3.0;
}

void triangle_surface(hit_record hit, REAL3 direction, inout surface s) {
    triangle_record triangle = load_triangle(hit.item);
    REAL b0 = max(1.0 - hit.b1 - hit.b2, 0.0);
    REAL3 q0 = triangle.v0 * b0, q1 = triangle.v1 * hit.b1, q2 = triangle.v2 * hit.b2;
    s.point = q0 + q1 + q2;
    s.error = (abs(q0) + abs(q1) + abs(q2)) * GAMMA_7;
#ifndef DOUBLE_PRECISION
    // A triangle that is much larger than its point's distance from the camera.
    bool is_coarse = largest3(s.error) > 1.5 * GAMMA_7 * largest3(abs(s.point));
    vec3 spread = abs(q0) + abs(q1) + abs(q2);
    s.point = is_coarse ? narrow3(exact_point(triangle, hit.b1, hit.b2)) : s.point;
    s.error = is_coarse ? abs(s.point) * GAMMA_2 + spread * WIDE_STEP : s.error;
#endif
    REAL3 outward = triangle_normal(triangle);
    s.enters = dot3(outward, direction) <= 0.0;
    s.geometric = s.enters ? outward : -outward;
    s.shading = s.geometric;
    s.solid = (triangle.shade & TRIANGLE_SOLID) != 0u;
    paint_spot spot = begin_spot(hit.t, direction, s);
    if (HAS_SMOOTH) {
        body_record body = load_body(triangle.body);
        bool smooth_shaded = (triangle.shade & TRIANGLE_SMOOTH) != 0u;
        uint base = smooth_shaded ? 3u * (triangle.number - body.first_triangle) + body.normal_base : 0u;
        REAL3 n = load_normal(body, base) * b0 + load_normal(body, base + 1u) * hit.b1 +
                  load_normal(body, base + 2u) * hit.b2;
        if (HAS_FOOTPRINT) {
            REAL bend = bend_of(triangle, load_normal(body, base), load_normal(body, base + 1u), load_normal(body, base + 2u));
            s.bend = !smooth_shaded ? 0.0 : dot3(n, s.geometric) < 0.0 ? -bend : bend;
        }
        REAL length2 = dot3(n, n);
        n = n * (1.0 / sqrt(length2));
        n = dot3(n, s.geometric) < 0.0 ? -n : n;
        s.shading = smooth_shaded && length2 > 0.0 ? n : s.geometric;
    }
    bool second_half = (triangle.shade & TRIANGLE_SECOND_HALF) != 0u;
    REAL sum = hit.b1 + hit.b2;
    REAL2 along = second_half ? REAL2(hit.b1, sum) : REAL2(sum, hit.b2);
    if (HAS_PAINT && wants(FEATURE_TEXTURES | FEATURE_FOOTPRINT))
        triangle_spot(triangle, hit, along, spot);
    read_material(triangle.shade, triangle.body, along, spot, s);
}

void sphere_surface(hit_record hit, REAL3 origin, REAL3 direction, inout surface s) {
    sphere_record sphere = load_sphere(hit.item & ~ITEM_SPHERE);
    // Moves the point back onto the sphere: its error is then the radius's, whatever the ray's length.
    REAL3 outward = unit3(origin + direction * hit.t - sphere.center);
    REAL3 arm = outward * sphere.radius;
    s.point = sphere.center + arm;
    s.error = abs(arm) * GAMMA_5 + abs(s.point) * GAMMA_1;
    s.enters = dot3(outward, direction) <= 0.0;
    s.geometric = s.enters ? outward : -outward;
    s.shading = s.geometric;
    s.solid = true;
    paint_spot spot = begin_spot(hit.t, direction, s);
    if (HAS_FOOTPRINT)
        s.bend = (s.enters ? 1.0 : -1.0) / sphere.radius;
    if (HAS_PAINT && wants(FEATURE_TEXTURES | FEATURE_FOOTPRINT)) {
        if (HAS_TURNED)
            turned_sphere_spot(load_body(sphere.body), outward, sphere.radius, s.width, spot);
        else
            sphere_spot(outward, sphere.radius, s.width, spot);
    }
    read_material(sphere.shade, sphere.body, REAL2(0.0), spot, s);
}

// A place is moved back onto the face, as with a sphere.
void frustum_surface(hit_record hit, REAL3 origin, REAL3 direction, inout surface s) {
    frustum_record body = load_frustum(hit.item & ~ITEM_SPHERE);
    bool is_side = hit.b1 == FACE_SIDE, is_top = hit.b1 == FACE_TOP;
    REAL3 f = origin - body.base + direction * hit.t;
    REAL above = dot3(f, body.axis);
    REAL3 arm = f - body.axis * above;
    REAL away = sqrt(dot3(arm, arm));
    REAL height = is_side ? clamp(above, 0.0, body.height) : is_top ? body.height : REAL(0.0);
    REAL radius = body.radius + body.slope * height;
    // On the axis only the tip of a cone is hit, or rounding decides: any direction will do.
    REAL3 around = away > 0.0 ? arm / away : REAL3(0.0);
    REAL3 outward = is_top ? body.axis : -body.axis;
    if (is_side && (away > 0.0 || body.slope > 0.0))
        outward = unit3(around - body.axis * body.slope);
    arm = around * (is_side ? radius : min(away, radius));
    s.point = body.base + body.axis * height + arm;
    s.error = REAL3((height + radius) * GAMMA_6) + abs(s.point) * GAMMA_1;
    s.enters = hit.b2 > 0.0;
    // A grazing ray may seem to come from the other side, because rounding turned the normal: back to a right angle.
    REAL along = dot3(outward, direction);
    if ((along > 0.0) == s.enters)
        outward = unit3(outward - direction * (along / dot3(direction, direction)));
    s.geometric = s.enters ? outward : -outward;
    s.shading = s.geometric;
    s.solid = true;
    paint_spot spot = begin_spot(hit.t, direction, s);
    // The mean of what it is around the axis and along it.
    if (HAS_FOOTPRINT && is_side && radius > 0.0)
        s.bend = (s.enters ? 0.5 : -0.5) / (radius * sqrt(1.0 + body.slope * body.slope));
    if (HAS_PAINT && wants(FEATURE_TEXTURES | FEATURE_FOOTPRINT)) {
        frustum_map map = frustum_map(arm, radius, (body.shade & FRUSTUM_TURNED) != 0u, body.height, height);
        frustum_spot(load_body(body.body), map, hit.b1, s.width, spot);
    }
    // A disc, which often lies between two layers of a checker's cells, shows those of the layer inside.
    REAL3 point = s.point;
    if (HAS_CHECKER && !is_side)
        s.point += body.axis * (is_top ? -CONE_INSET : CONE_INSET) * body.height;
    read_material(body.shade & ~(FRUSTUM_SHADE | FRUSTUM_TURNED), body.body, REAL2(0.0), spot, s);
    s.point = point;
}

void make_surface(hit_record hit, REAL3 origin, REAL3 direction, inout surface s) {
    bool sphere = (hit.item & ITEM_SPHERE) != 0u, frustum = HAS_CONES && hit.b1 != 0.0;
    if (HAS_TRIANGLES && !(HAS_ROUND && sphere))
        triangle_surface(hit, direction, s);
    if (HAS_SPHERES && (!HAS_TRIANGLES || sphere) && !frustum)
        sphere_surface(hit, origin, direction, s);
    if (HAS_CONES && (!HAS_TRIANGLES || sphere) && (!HAS_SPHERES || frustum))
        frustum_surface(hit, origin, direction, s);
#ifdef ALTERNATIVES
    if (alternative_moves()) {
        s.point = origin + direction * hit.t;
        s.error = vec3(alternative_offset(hit.t));
    }
#endif
}
