// What every pixel's first ray meets (runtime/hits.h), with the camera, trees, surfaces and lights of the tracer.
//
// A dispatch traces one kind of ray (hits.h). Later kinds make the surface again from the hit that the first one
// left in OUTPUT.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_spirv_intrinsics : require
spirv_execution_mode(extensions = ["SPV_KHR_float_controls"], capabilities = [4466], 4461, 32);

#include "scene.glsl"
#include "records.glsl"
#include "math.glsl"
#include "camera.glsl"
#include "tree.glsl"
#include "triangles.glsl"
#include "spheres.glsl"
#include "surface.glsl"
#include "lights.glsl"
#include "bounce.glsl"
#include "hits.h"

layout(local_size_x = TILE_PIXELS) in;

struct hits_ray {
    vec3 origin, direction;
    float end;
    bool any;
    bool sent;
};

hit_record load_hit(uint at) {
    uvec4 a = pixels[at], b = pixels[at + 1u];
    return hit_record(uintBitsToFloat(a.x), uintBitsToFloat(a.y), uintBitsToFloat(a.z), a.w, b.x);
}

hits_ray mirrored_ray(surface s, vec3 direction) {
    vec3 bent;
    bool total = s.refraction > 0.0 && !refracted(direction, s, bent);
    return hits_ray(ray_start(s.point, s.error, s.geometric), reflected(direction, s), FAR_AWAY, false,
                    s.reflection > 0.0 || total);
}

hits_ray refracted_ray(surface s, vec3 direction) {
    vec3 bent;
    bool through = refracted(direction, s, bent);
    return hits_ray(ray_start(s.point, s.error, -s.geometric), bent, FAR_AWAY, false, through && s.refraction > 0.0);
}

hits_ray shadow_ray(surface s, vec3 direction, uint light) {
    vec3 start = ray_start(s.point, s.error, s.geometric);
    light_ray shadow = light_at(light, s, start, direction);
    return hits_ray(start, shadow.direction, shadow.t_max, true, shadow.value != vec3(0.0));
}

void write_first(uint at, hit_record hit, surface s, bool ended) {
    bool nothing = hit.item == NO_ITEM;
    pixels[at] = uvec4(floatBitsToUint(vec3(hit.t, hit.b1, hit.b2)), hit.item);
    pixels[at + 1u] = uvec4(nothing ? HITS_NOTHING : hit.number, 0u, 0u, ended ? 0u : 1u);
    pixels[at + 2u] = nothing ? uvec4(0u) : uvec4(floatBitsToUint(s.shading), 0u);
    pixels[at + 3u] = uvec4(HITS_NOTHING);
}

void write_later(uint at, uint kind, hit_record hit, bool ended) {
    if (kind >= HITS_LIGHTS) {
        uint bit = 1u << (kind - HITS_LIGHTS);
        pixels[at + 1u].y |= bit;
        pixels[at + 1u].z |= hit.item == NO_ITEM ? bit : 0u;
    } else if (hit.item != NO_ITEM) {
        pixels[at + 3u][kind - HITS_MIRRORED] = hit.number;
    }
    pixels[at + 1u].w += ended ? 0u : 1u;
}

void main() {
    uint slot = (gl_WorkGroupID.y * dispatch.grid_width + gl_WorkGroupID.x) * TILE_PIXELS + gl_LocalInvocationID.x;
    uvec2 pixel = pixel_of_slot(slot);
    if (slot >= dispatch.tile_count * TILE_PIXELS || pixel.x >= frame.width || pixel.y >= frame.height)
        return;
    uint kind = dispatch.resume + OPAQUE_ZERO, at = slot * HITS_WORDS;
    bool first = kind == HITS_FIRST;
    vec3 direction = camera_direction(pixel);
    hits_ray ray = hits_ray(frame.camera_position, direction, FAR_AWAY, false, true);
    surface s;
    if (!first) {
        hit_record before = load_hit(at);
        if (before.item == NO_ITEM)
            return;
        make_surface(before, frame.camera_position, direction, s);
        if (kind == HITS_MIRRORED)
            ray = mirrored_ray(s, direction);
        else if (kind == HITS_REFRACTED)
            ray = refracted_ray(s, direction);
        else
            ray = shadow_ray(s, direction, kind - HITS_LIGHTS);
        if (!ray.sent)
            return;
    }
    hit_record hit = hit_record(ray.end, 0.0, 0.0, NO_ITEM, 0u);
    uint iterations = 0u;
    // Without shadows the tracer sends no such ray, and the light counts.
    if (kind < HITS_LIGHTS || (HAS_SHADOWS && wants(FEATURE_SHADOWS))) {
        if (HAS_SPHERES)
            trace_spheres(ray.origin, ray.direction, ray.any, hit, iterations);
        if (HAS_TRIANGLES && !(ray.any && hit.item != NO_ITEM))
            trace_triangles(ray.origin, ray.direction, ray.any, hit, iterations);
    }
    bool ended = iterations < ITERATION_LIMIT;
    if (!first) {
        write_later(at, kind, hit, ended);
        return;
    }
    if (hit.item != NO_ITEM)
        make_surface(hit, ray.origin, direction, s);
    write_first(at, hit, s, ended);
}
