// The method of the course project that glint grew out of, as a yardstick: each ray walks a list of boxes
// around 64 triangles each, in file order, and tests all triangles of every box that it enters.
//
// Box: slabs. Triangle: Möller and Trumbore 1997. Shading and recursion as tinyraytracer: a shadow ray to
// each light, always; rays start a constant off the surface; depth 20 and no weight is too small.
// Mapping of workgroups to pixels, background and the scene's words are glint's own, so that only the
// method differs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "../../shaders/scene.glsl"
#include "../../shaders/records.h"
#include "../../shaders/math.glsl"
#include "../../shaders/camera.glsl"
#include "../../shaders/background.glsl"
#include "layout.h"

layout(local_size_x = TILE_PIXELS) in;
layout(constant_id = CONSTANT_BOXES) const uint BOXES = 1u;
layout(constant_id = CONSTANT_RECTANGLES) const uint RECTANGLES = 0u;
layout(constant_id = CONSTANT_DEPTH) const uint DEPTH = 20u;
layout(constant_id = CONSTANT_EPSILON) const float EPSILON = 1.0e-3;

WORDS(BINDING_BOXES, boxes)
WORDS(BINDING_RECTANGLES, rectangles)

const uint NOTHING = 0xffffffffu;
const uint RECTANGLE = 0x80000000u; // in `item`: a rectangle, not a triangle

struct meeting {
    float t; // the ray's end before, where nothing was met
    float u, v;
    uint item;
};

struct place {
    vec3 point, flat_normal, normal; // normals unit, towards the viewer
    vec3 diffuse, specular;          // colours
    vec4 weights;
    float exponent, index;
    bool enters, solid;
};

bool enters_box(vec3 lower, vec3 upper, vec3 origin, vec3 inverse) {
    vec3 a = (lower - origin) * inverse, b = (upper - origin) * inverse;
    vec3 near = min(a, b), far = max(a, b);
    return max(max(near.x, near.y), max(near.z, 0.0)) <= min(min(far.x, far.y), far.z);
}

void test_triangle(uint item, vec3 origin, vec3 direction, inout meeting m) {
    vec3 a = uintBitsToFloat(FETCH(triangles, item * TRIANGLE_WORDS).xyz);
    vec3 ab = uintBitsToFloat(FETCH(triangles, item * TRIANGLE_WORDS + 1u).xyz) - a;
    vec3 ac = uintBitsToFloat(FETCH(triangles, item * TRIANGLE_WORDS + 2u).xyz) - a;
    vec3 p = cross3(direction, ac);
    float inverse = 1.0 / dot3(ab, p);
    vec3 s = origin - a;
    vec3 q = cross3(s, ab);
    float u = dot3(s, p) * inverse, v = dot3(direction, q) * inverse, t = dot3(ac, q) * inverse;
    // Infinite or no number where the determinant is 0, and false.
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < m.t)
        m = meeting(t, u, v, item);
}

void test_rectangle(uint index, vec3 origin, vec3 direction, inout meeting m) {
    vec3 corner = uintBitsToFloat(FETCH(rectangles, index * RECTANGLE_WORDS).xyz);
    vec3 edge_u = uintBitsToFloat(FETCH(rectangles, index * RECTANGLE_WORDS + 1u).xyz);
    vec3 edge_v = uintBitsToFloat(FETCH(rectangles, index * RECTANGLE_WORDS + 2u).xyz);
    vec3 n = cross3(edge_u, edge_v);
    float t = dot3(corner - origin, n) / dot3(direction, n);
    vec3 at = origin + direction * t - corner;
    float scale = 1.0 / dot3(n, n);
    float u = dot3(cross3(at, edge_v), n) * scale, v = dot3(cross3(edge_u, at), n) * scale;
    if (t > 0.0 && t < m.t && u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0)
        m = meeting(t, u, v, RECTANGLE | index);
}

// false: the device ended the walk before its end.
bool walk(vec3 origin, vec3 direction, inout meeting m) {
    vec3 inverse = 1.0 / direction;
    uint box = 0u;
    for (; box < BOXES; box++) {
        uvec4 lower = FETCH(boxes, box * BOX_WORDS), upper = FETCH(boxes, box * BOX_WORDS + 1u);
        if (enters_box(uintBitsToFloat(lower.xyz), uintBitsToFloat(upper.xyz), origin, inverse))
            for (uint i = 0u; i < upper.w; i++)
                test_triangle(lower.w + i, origin, direction, m);
    }
    for (uint i = 0u; i < RECTANGLES; i++)
        test_rectangle(i, origin, direction, m);
    return box == BOXES;
}

void read_material(uint material, vec2 cells, bool checker, inout place s) {
    vec4 w1 = uintBitsToFloat(FETCH(materials, material * MATERIAL_WORDS + 1u));
    vec4 w2 = uintBitsToFloat(FETCH(materials, material * MATERIAL_WORDS + 2u));
    vec4 w3 = uintBitsToFloat(FETCH(materials, material * MATERIAL_WORDS + 3u));
    s.weights = uintBitsToFloat(FETCH(materials, material * MATERIAL_WORDS));
    bool odd = ((int(floor(cells.x / w3.w)) + int(floor(cells.y / w3.w))) & 1) != 0;
    s.diffuse = checker && w3.w > 0.0 && odd ? w3.xyz : w1.xyz;
    s.specular = w2.xyz;
    s.exponent = w1.w;
    s.index = w2.w;
}

void turn_to_viewer(vec3 outward, vec3 direction, inout place s) {
    s.enters = dot3(outward, direction) <= 0.0;
    s.flat_normal = s.enters ? outward : -outward;
    s.normal = s.flat_normal;
}

void triangle_place(meeting m, vec3 direction, inout place s) {
    uvec4 w0 = FETCH(triangles, m.item * TRIANGLE_WORDS);
    uvec4 w1 = FETCH(triangles, m.item * TRIANGLE_WORDS + 1u);
    uvec4 w2 = FETCH(triangles, m.item * TRIANGLE_WORDS + 2u);
    vec3 a = uintBitsToFloat(w0.xyz);
    turn_to_viewer(unit3(cross3(uintBitsToFloat(w1.xyz) - a, uintBitsToFloat(w2.xyz) - a)), direction, s);
    if ((w2.w & TRIANGLE_SMOOTH) != 0u) {
        uvec4 body = FETCH(bodies, w1.w * BODY_WORDS);
        uint base = 3u * (w0.w - body.x) + body.y;
        vec3 n = uintBitsToFloat(FETCH(normals, base).xyz) * (1.0 - m.u - m.v) +
                 uintBitsToFloat(FETCH(normals, base + 1u).xyz) * m.u +
                 uintBitsToFloat(FETCH(normals, base + 2u).xyz) * m.v;
        n = dot3(n, s.flat_normal) < 0.0 ? -n : n;
        s.normal = dot3(n, n) > 0.0 ? unit3(n) : s.flat_normal;
    }
    s.solid = (w2.w & TRIANGLE_SOLID) != 0u;
    read_material(w2.w & TRIANGLE_MATERIAL, vec2(0.0), false, s);
}

void rectangle_place(meeting m, vec3 direction, inout place s) {
    uint at = (m.item & ~RECTANGLE) * RECTANGLE_WORDS;
    uvec4 corner = FETCH(rectangles, at);
    vec4 edge_u = uintBitsToFloat(FETCH(rectangles, at + 1u)), edge_v = uintBitsToFloat(FETCH(rectangles, at + 2u));
    turn_to_viewer(unit3(cross3(edge_u.xyz, edge_v.xyz)), direction, s);
    s.solid = false;
    read_material(corner.w, vec2(m.u * edge_u.w, m.v * edge_v.w), true, s);
}

vec3 start_towards(place s, vec3 direction) {
    return s.point + s.flat_normal * (dot3(direction, s.flat_normal) < 0.0 ? -EPSILON : EPSILON);
}

// Phong's terms of all lights, each after its shadow ray. `whole` becomes false as in walk.
vec3 lighting(place s, vec3 direction, inout bool whole) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < frame.light_count; i++) {
        vec3 way = uintBitsToFloat(FETCH(lights, i * LIGHT_WORDS).xyz) - s.point;
        vec3 emission = uintBitsToFloat(FETCH(lights, i * LIGHT_WORDS + 1u).xyz);
        vec3 l = unit3(way);
        meeting shadow = meeting(sqrt(dot3(way, way)), 0.0, 0.0, NOTHING);
        whole = walk(start_towards(s, l), l, shadow) && whole;
        float facing = dot3(s.normal, l);
        bool lit = shadow.item == NOTHING && facing > 0.0 && dot3(s.flat_normal, l) > 0.0;
        float shine = max(0.0, -dot3(s.normal * (2.0 * facing) - l, direction));
        vec3 value = s.diffuse * (s.weights.x * facing) + s.specular * (s.weights.y * pow(shine, s.exponent));
        sum += lit ? emission * value : vec3(0.0);
    }
    return sum;
}

// false: total reflection.
bool refract_at(place s, vec3 direction, out vec3 bent) {
    float eta = s.enters ? 1.0 / s.index : s.index;
    float c = -dot3(direction, s.normal);
    float k = 1.0 - eta * eta * (1.0 - c * c);
    bent = s.solid && eta != 1.0 ? unit3(direction * eta + s.normal * (eta * c - sqrt(max(k, 0.0)))) : direction;
    return k >= 0.0 || !s.solid;
}

struct ray {
    vec3 origin, direction;
    float weight;
    uint depth;
};
ray stack[DEPTH + 1u]; // refracted rays that wait

// As glint, so that both trace the same rays.
bool is_followed(ray r) { return r.weight > 0.0 && r.weight >= frame.min_weight; }

// Where the ray meets something: its light, and the rays that it sends. false: it sends none.
bool shade(meeting m, inout ray r, inout uint waiting, inout vec3 radiance, inout bool whole) {
    place s;
    s.point = r.origin + r.direction * m.t;
    if ((m.item & RECTANGLE) != 0u)
        rectangle_place(m, r.direction, s);
    else
        triangle_place(m, r.direction, s);
    radiance += lighting(s, r.direction, whole) * r.weight;
    vec3 bent;
    bool through = refract_at(s, r.direction, bent);
    vec3 mirrored = unit3(r.direction - s.normal * (2.0 * dot3(r.direction, s.normal)));
    float back_weight = s.weights.z + (through ? 0.0 : s.weights.w);
    ray back = ray(start_towards(s, mirrored), mirrored, r.weight * back_weight, r.depth + 1u);
    ray on = ray(start_towards(s, bent), bent, r.weight * s.weights.w, r.depth + 1u);
    bool sends_back = is_followed(back), sends_on = through && is_followed(on);
    if (sends_back && sends_on)
        stack[waiting++] = on;
    r = sends_back ? back : on;
    return sends_back || sends_on;
}

void main() {
    uint slot = (gl_WorkGroupID.y * dispatch.grid_width + gl_WorkGroupID.x) * TILE_PIXELS + gl_LocalInvocationID.x;
    if (slot >= dispatch.tile_count * TILE_PIXELS)
        return;
    uvec2 pixel = pixel_of_slot(slot);
    if (pixel.x >= frame.width || pixel.y >= frame.height)
        return;
    ray r = ray(frame.camera_position, camera_direction(pixel), 1.0, 0u);
    vec3 radiance = vec3(0.0);
    uint waiting = 0u;
    bool whole = true, more = true;
    while (more) {
        meeting m = meeting(FAR_AWAY, 0.0, 0.0, NOTHING);
        if (r.depth <= DEPTH)
            whole = walk(r.origin, r.direction, m) && whole;
        if (m.item == NOTHING) {
            radiance += background(r.direction) * r.weight;
            more = false;
        } else {
            more = shade(m, r, waiting, radiance, whole);
        }
        if (!more && waiting > 0u) {
            r = stack[--waiting];
            more = true;
        }
    }
    pixels[slot] = uvec4(floatBitsToUint(radiance), whole && !more ? PIXEL_WHOLE : PIXEL_CUT);
}
