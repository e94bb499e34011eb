// What every pixel's first ray hits (scene/hits.h), found with the tracer's camera, trees, surfaces and lights.
//
// A dispatch traces one kind of ray (hits.h). Later kinds make the surface again from the hit that the first one
// left in OUTPUT.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "scene.glsl"
#include "records.glsl"
#include "math.glsl"
#define POINT_BITS 0u // the middle of each light
#include "light/points.glsl"
#include "light/round.glsl"
#include "camera.glsl"
#include "light/lens.glsl"
#include "tree.glsl"
#include "wide.glsl"
#include "triangles.glsl"
#include "exact.glsl"
#include "cones.glsl"
#include "spheres.glsl"
#include "surface.glsl"
#include "ray_offset.glsl"
#include "background.glsl"
#include "lights.glsl"
#include "bounce.glsl"
#include "light/rough.glsl"
#include "media.glsl"
#include "trace_all.glsl"
#include "bits.glsl"
#include "hits.h"

layout(local_size_x = TILE_PIXELS) in;

struct hits_ray {
    ray_start start;
    exact_aim aim;
    REAL end;
    bool any;
    bool sent;
};

hit_record load_hit(uint at) {
    uvec4 a = pixels[at], b = pixels[at + 1u];
    return hit_record(number_of(a.xy), number_of(a.zw), number_of(b.xy), b.z, b.w);
}

hits_ray mirrored_ray(surface s, hit_record hit, REAL3 direction) {
    return hits_ray(leave(s, hit, s.geometric), aim_along(reflected(direction, s)), FAR_AWAY, false,
                    scatter(direction, s).reflection > 0.0);
}

hits_ray refracted_ray(surface s, hit_record hit, REAL3 direction) {
    scatter_rays rays = scatter(direction, s);
    return hits_ray(leave(s, hit, -s.geometric), aim_along(rays.bent), FAR_AWAY, false, rays.refraction > 0.0);
}

hits_ray shadow_ray(surface s, hit_record hit, REAL3 direction, uint light) {
    ray_start start = leave(s, hit, s.geometric);
    light_ray shadow = light_at(light, s, start.at, direction, point_root(point_pixel.x, point_pixel.y));
    bool sent = shadow.value != vec3(0.0) && !(HAS_MEDIA && s.passes);
    return hits_ray(start, aim_at(light, shadow), shadow.t_max, true, sent);
}

// Whether any of a light's light reaches a surface through refracting bodies.
bool shines_to(hits_ray ray, uint light, media_set inside, inout bool ended) {
    light_ray shadow = light_ray(vec3(1.0), ray.aim.direction, ray.end, ray.aim.target);
    return shine_all(ray.start, light, shadow, inside, ended) != vec3(0.0);
}

void write_first(uint at, hit_record hit, surface s, bool ended) {
    bool nothing = hit.item == NO_ITEM;
    pixels[at] = uvec4(bits_of(hit.t), bits_of(hit.b1));
    pixels[at + 1u] = uvec4(bits_of(hit.b2), hit.item, nothing ? HITS_NOTHING : hit.number);
    pixels[at + 2u] = uvec4(0u, 0u, HITS_NOTHING, HITS_NOTHING);
    pixels[at + 3u] = uvec4(nothing ? uvec3(0u) : floatBitsToUint(vec3(s.shading)), ended ? 0u : 1u);
    vec3 albedo = vec3(0.0);
    if (HAS_DIFFUSE)
        albedo = s.diffuse;
    pixels[at + 4u] = nothing ? uvec4(0u) : uvec4(floatBitsToUint(albedo), 0u);
}

void write_later(uint at, uint kind, hit_record hit, bool ended) {
    bool nothing = hit.item == NO_ITEM;
    uvec4 found = pixels[at + 2u];
    uint bit = kind < HITS_LIGHTS ? 0u : 1u << (kind - HITS_LIGHTS);
    found.x |= bit;
    found.y |= nothing ? bit : 0u;
    found.z = kind == HITS_MIRRORED && !nothing ? hit.number : found.z;
    found.w = kind == HITS_REFRACTED && !nothing ? hit.number : found.w;
    pixels[at + 2u] = found;
    pixels[at + 4u].w |= kind == HITS_MIRRORED ? HITS_REFLECTS : kind == HITS_REFRACTED ? HITS_REFRACTS : 0u;
    if (!ended)
        pixels[at + 3u].w++;
}

void main() {
    uint group = gl_WorkGroupID.y * dispatch.grid_width + gl_WorkGroupID.x;
    uint slot = dispatch.path_begin + group * TILE_PIXELS + gl_LocalInvocationID.x;
    uvec2 pixel = pixel_of_slot(slot);
    if (slot >= dispatch.path_end || pixel.x >= frame.width || pixel.y >= frame.height)
        return;
    pixel = pixel_of_whole(pixel);
    point_pixel = pixel;
    uint kind = dispatch.resume + OPAQUE_ZERO, at = slot * HITS_WORDS;
    bool first = kind == HITS_FIRST;
    camera_ray seen = camera_ray_of(pixel);
    REAL3 direction = seen.direction;
    hits_ray ray = hits_ray(exact_start(seen.at), aim_along(direction), FAR_AWAY, false, true);
    surface s;
    if (HAS_FOOTPRINT)
        surface_cone = camera_cone(direction);
    media_set inside = camera_media();
    if (!first) {
        hit_record before = load_hit(at);
        if (before.item == NO_ITEM)
            return;
        make_surface(before, seen.at, direction, s);
        cross_surface(inside, before, s);
        if (HAS_ROUGHNESS)
            roughen(direction, 0u, s);
        if (kind == HITS_MIRRORED)
            ray = mirrored_ray(s, before, direction);
        else if (kind == HITS_REFRACTED)
            ray = refracted_ray(s, before, direction);
        else
            ray = shadow_ray(s, before, direction, kind - HITS_LIGHTS);
        if (!ray.sent)
            return;
    }
    hit_record hit = hit_record(ray.end, 0.0, 0.0, NO_ITEM, 0u);
    uint iterations = 0u;
    bool ended = true;
    // With shadows off the tracer sends no shadow ray, and the light always counts.
    if (kind >= HITS_LIGHTS && shines())
        hit.item = shines_to(ray, kind - HITS_LIGHTS, inside, ended) ? NO_ITEM : 0u;
    else if (kind < HITS_LIGHTS || (HAS_SHADOWS && wants(FEATURE_SHADOWS)))
        trace_all(ray.start, ray.aim, ray.any, hit, iterations);
    ended = ended && iterations < ITERATION_LIMIT;
    if (!first) {
        write_later(at, kind, hit, ended);
        return;
    }
    if (hit.item != NO_ITEM)
        make_surface(hit, ray.start.at, direction, s);
    write_first(at, hit, s, ended);
}
