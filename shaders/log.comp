// What single rays hit and where they go on, reported in full, with the tracer's own code: the host uses it to
// follow one sample's path, ray by ray (tracer/render/render_log.c).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "scene.glsl"
#include "records.glsl"
#include "math.glsl"
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
#include "light/seen.glsl"
#include "trace_all.glsl"
#include "bits.glsl"
#include "log.h"

layout(local_size_x = TILE_PIXELS) in;

struct log_ray {
    ray_start start;
    REAL3 direction;
    RAY_CONE cone;
    media_set inside;
    uint key;
};

log_ray load_ray(uint at) {
    uvec4 a = states[at], b = states[at + 1u], c = states[at + 2u], d = states[at + 3u], e = states[at + 4u];
    ray_start start = ray_start(REAL3(number_of(a.xy), number_of(a.zw), number_of(b.xy)), number_of(d.zw), b.w,
                                number_of(e.xy), number_of(e.zw));
    return log_ray(start, REAL3(number_of(c.xy), number_of(c.zw), number_of(d.xy)),
                   REAL2(number_of(states[at + LOG_CONE].xy), number_of(states[at + LOG_CONE].zw)),
                   media_set(states[at + LOG_INSIDE], states[at + LOG_INSIDE + 1u]),
                   point_key(states[at + LOG_KEY].x, states[at + LOG_KEY].y));
}

void write_camera_ray() {
    camera_ray ray = camera_ray_of(point_pixel);
    REAL3 o = ray.at, d = ray.direction;
    states[0] = uvec4(bits_of(o.x), bits_of(o.y));
    states[1] = uvec4(bits_of(o.z), 0u, NO_ITEM);
    states[2] = uvec4(bits_of(d.x), bits_of(d.y));
    states[3] = uvec4(bits_of(d.z), 0u, 0u);
    states[4] = uvec4(0u);
    RAY_CONE cone = REAL2(0.0);
    if (HAS_FOOTPRINT)
        cone = camera_cone(d);
    states[LOG_CONE] = uvec4(bits_of(cone.x), bits_of(cone.y));
    states[LOG_INSIDE] = camera_media().a;
    states[LOG_INSIDE + 1] = camera_media().b;
    states[LOG_KEY] = uvec4(point_root(point_pixel.x, point_pixel.y), POINT_SAME, 0u, 0u);
}

hit_record load_hit(uint at) {
    uvec4 a = pixels[at], b = pixels[at + 1u];
    return hit_record(number_of(a.xy), number_of(a.zw), number_of(b.xy), b.z, b.w);
}

void write3(uint at, REAL3 v, uvec2 more) {
    pixels[at] = uvec4(bits_of(v.x), bits_of(v.y));
    pixels[at + 1u] = uvec4(bits_of(v.z), more);
}

uint material_of(hit_record hit) {
    bool sphere = (hit.item & ITEM_SPHERE) != 0u;
    uint shade = 0u;
    if (HAS_TRIANGLES && !sphere)
        shade = load_triangle(hit.item).shade;
    if (HAS_ROUND && sphere)
        shade = load_sphere(hit.item & ~ITEM_SPHERE).shade;
    return shade & TRIANGLE_MATERIAL;
}

void write_ray(uint at, ray_start start, REAL3 direction, RAY_CONE cone) {
    pixels[at + LOG_CONE] = uvec4(bits_of(cone.x), bits_of(cone.y));
    write3(at, start.at, uvec2(0u, start.left));
    write3(at + 2u, direction, bits_of(start.slack));
    pixels[at + 4u] = uvec4(bits_of(start.b1), bits_of(start.b2));
}

// The light left on the way to what the ray hits.
void write_way(uint at, log_ray ray, REAL way) {
    vec3 left = vec3(1.0);
    if (HAS_ATTENUATION && wants(FEATURE_ATTENUATION))
        left = media_left(ray.inside, way);
    pixels[at + LOG_LEFT] = uvec4(floatBitsToUint(left), ray.key);
}

void write_surface(uint at, log_ray ray, hit_record hit, surface s) {
    if (HAS_ROUGHNESS)
        roughen(ray.direction, ray.key, s);
    scatter_rays rays = scatter(ray.direction, s);
    uint flags = (s.enters ? LOG_ENTERS : 0u) | (rays.total ? LOG_TOTAL : 0u);
    if (HAS_MEDIA)
        flags |= (s.passes ? LOG_PASSES : 0u) | (s.is_over ? LOG_NESTED : 0u);
    pixels[at + 2u] = uvec4(0u, 0u, flags, pixels[at + 2u].w);
    vec3 own = HAS_MEDIA && s.passes ? vec3(0.0) : own_light(s);
    pixels[at + 3u] = uvec4(floatBitsToUint(own), material_of(hit));
    write3(at + 4u, s.point, uvec2(floatBitsToUint(rays.reflection), floatBitsToUint(rays.refraction)));
    write3(at + 6u, s.geometric, uvec2(0u));
    write3(at + 8u, s.shading, uvec2(0u));
    RAY_CONE mirrored = ray.cone, bent = ray.cone;
    if (HAS_FOOTPRINT) {
        mirrored = mirrored_cone(s, ray.cone);
        bent = bent_cone(s, ray.cone, ray.direction, rays.bent);
    }
    write_ray(at + LOG_REFLECTED, leave(s, hit, s.geometric), reflected(ray.direction, s), mirrored);
    write_ray(at + LOG_REFRACTED, leave(s, hit, -s.geometric), rays.bent, bent);
    write_way(at, ray, hit.t);
    pixels[at + LOG_COLOR] = uvec4(floatBitsToUint(HAS_REFLECTION_COLOR ? rays.color : vec3(1.0)), 0u);
    pixels[at + LOG_AFTER] = HAS_MEDIA && wants(FEATURE_MEDIA) ? s.after.a : uvec4(0u);
    pixels[at + LOG_AFTER + 1u] = HAS_MEDIA && wants(FEATURE_MEDIA) ? s.after.b : uvec4(0u);
}

void add_to_log(uint at, vec3 value) {
    uvec4 sum = pixels[at + 3u], low_xy = pixels[at + 7u], low_z = pixels[at + 9u];
    vec3 total = uintBitsToFloat(sum.xyz), low = uintBitsToFloat(uvec3(low_xy.zw, low_z.z));
    add_light(value, total, low);
    uvec3 bits = floatBitsToUint(low);
    pixels[at + 3u] = uvec4(floatBitsToUint(total), sum.w);
    pixels[at + 7u] = uvec4(low_xy.xy, bits.xy);
    pixels[at + 9u] = uvec4(low_z.xy, bits.z, low_z.w);
}

// What a ray other than a shadow ray hits; a blind ray was not traced, and sees the background.
void write_hit(uint at, log_ray ray, hit_record hit, bool blind, bool ended) {
    seen_light seen = no_light(blind ? -FAR_AWAY : hit.t);
    if (HAS_SEEN_LIGHT)
        see_lights(ray.start.at, ray.direction, seen);
    if (seen.number != 0u) {
        write_way(at, ray, seen.t);
        hit.t = seen.t;
        hit.item = LOG_NOTHING;
    }
    pixels[at] = uvec4(bits_of(hit.t), bits_of(hit.b1));
    pixels[at + 1u] = uvec4(bits_of(hit.b2), hit.item, hit.number);
    pixels[at + 2u] = uvec4(0u, 0u, seen.number, ended ? 0u : 1u);
    bool nothing = hit.item == NO_ITEM || seen.number != 0u;
    surface s;
    if (nothing) {
        vec3 beyond = seen.number != 0u ? seen.radiance : seen_beyond(ray.direction);
        pixels[at + 3u] = uvec4(floatBitsToUint(beyond), LOG_NOTHING);
    } else {
        make_surface(hit, ray.start.at, ray.direction, s);
        cross_surface(ray.inside, hit, s);
        write_surface(at, ray, hit, s);
    }
}

bool trace(ray_start start, exact_aim aim, bool any, inout hit_record hit) {
    uint iterations = 0u;
    trace_all(start, aim, any, hit, iterations);
    return iterations < ITERATION_LIMIT;
}

void main() {
    uint index = gl_WorkGroupID.x * TILE_PIXELS + gl_LocalInvocationID.x;
    uint kind = dispatch.resume + OPAQUE_ZERO, at = index * LOG_WORDS;
    point_pixel = uvec2(dispatch.read_list, dispatch.pending_base);
    point_sample = dispatch.first_sample;
    if (kind == LOG_CAMERA && index == 0u)
        write_camera_ray();
    if (kind == LOG_CAMERA || index >= dispatch.tile_count)
        return;
    log_ray ray = load_ray(index * LOG_RAY_WORDS);
    bool lights = kind >= LOG_LIGHTS;
    surface_cone = ray.cone;
    hit_record hit = hit_record(FAR_AWAY, 0.0, 0.0, NO_ITEM, 0u);
    surface s;
    light_ray shadow = light_ray(vec3(0.0), ray.direction, FAR_AWAY, ray.direction);
    ray_start start = ray.start;
    exact_aim aim = aim_along(ray.direction);
    if (lights) {
        hit_record before = load_hit(at);
        if (before.item == NO_ITEM)
            return;
        make_surface(before, ray.start.at, ray.direction, s);
        cross_surface(ray.inside, before, s);
        start = leave(s, before, s.geometric);
        shadow = light_at(kind - LOG_LIGHTS, s, start.at, ray.direction, ray.key);
        hit.t = shadow.t_max;
        aim = aim_at(kind - LOG_LIGHTS, shadow);
        if (shadow.value == vec3(0.0) || (HAS_MEDIA && s.passes))
            return;
    }
    bool ended = true, blind = states[index * LOG_RAY_WORDS + 1u].z == LOG_BLIND;
    bool shadows = HAS_SHADOWS && wants(FEATURE_SHADOWS);
    vec3 left = vec3(1.0);
    if (lights && shadows && !shines())
        left = arriving_left(ray.inside, shadow);
    if (lights && shines()) {
        left = shine_all(start, kind - LOG_LIGHTS, shadow, ray.inside, ended);
        hit.item = left != vec3(0.0) ? NO_ITEM : 0u;
    } else if (lights ? shadows : !blind)
        ended = trace(start, aim, lights, hit);
    bool nothing = hit.item == NO_ITEM;
    if (lights) {
        uvec4 found = pixels[at + 2u];
        uint light = kind - LOG_LIGHTS, bit = light < min(frame.light_count, 32u) ? 1u << light : 0u;
        pixels[at + 2u] = uvec4(found.x | bit, nothing ? found.y | bit : found.y, found.z, found.w + (ended ? 0u : 1u));
        if (nothing)
            add_to_log(at, shadow.value * left);
        return;
    }
    write_hit(at, ray, hit, blind, ended);
}
