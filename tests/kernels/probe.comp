// Traces rays that a test gives, one by one: the closest hit, any hit, and a ray that leaves the surface.
//
// In STATE three words a ray: origin, end; direction, -; direction of the second ray, -. In OUTPUT two: t, number
// of the closest hit (NO_ITEM in `item` where none), item, 1 where the search for any hit found one too; then t,
// number, item of the second ray's closest hit, and two bits: whether it left on the side that the first one came
// from, and whether the search for any hit found one too.
// In double precision six words a ray: each vector in two, the end in the rest of the second one; and three of
// output: t, number, item of one ray, then of the other; then the two answers.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "scene.glsl"
#include "records.glsl"
#include "math.glsl"
#define POINT_BITS 0u // the middle of each light
#include "light/points.glsl"
#include "light/round.glsl"
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
#include "media.glsl"
#include "trace_all.glsl"

layout(local_size_x = TILE_PIXELS) in;

hit_record trace(ray_start start, REAL3 direction, REAL end, bool any) {
    hit_record hit = hit_record(end, 0.0, 0.0, NO_ITEM, 0u);
    uint iterations = 0u;
    trace_all(start, aim_along(direction), any, hit, iterations);
    return hit;
}

struct probe_ray {
    REAL3 origin, direction, next;
    REAL end;
};

#ifdef DOUBLE_PRECISION
probe_ray read_ray(uint index) {
    uvec4 w[6];
    for (uint i = 0u; i < 6u; i++)
        w[i] = states[6u * index + i];
    return probe_ray(double3_of(w[0], w[1].xy), double3_of(w[2], w[3].xy), double3_of(w[4], w[5].xy),
                     packDouble2x32(w[1].zw));
}
void write_first(uint index, hit_record hit, bool any) {
    pixels[3u * index] = uvec4(unpackDouble2x32(hit.t), hit.number, hit.item);
    pixels[3u * index + 2u] = uvec4(any ? 1u : 0u, 0u, 0u, 0u);
}
void write_second(uint index, hit_record hit, uint answers) {
    pixels[3u * index + 1u] = uvec4(unpackDouble2x32(hit.t), hit.number, hit.item);
    pixels[3u * index + 2u].y = answers;
}
#else
probe_ray read_ray(uint index) {
    uvec4 w0 = states[3u * index], w1 = states[3u * index + 1u], w2 = states[3u * index + 2u];
    return probe_ray(uintBitsToFloat(w0.xyz), uintBitsToFloat(w1.xyz), uintBitsToFloat(w2.xyz),
                     uintBitsToFloat(w0.w));
}
void write_first(uint index, hit_record hit, bool any) {
    pixels[2u * index] = uvec4(floatBitsToUint(hit.t), hit.number, hit.item, any ? 1u : 0u);
}
void write_second(uint index, hit_record hit, uint answers) {
    pixels[2u * index + 1u] = uvec4(floatBitsToUint(hit.t), hit.number, hit.item, answers);
}
#endif

void main() {
    uint index = gl_WorkGroupID.x * TILE_PIXELS + gl_LocalInvocationID.x;
    if (index >= dispatch.tile_count)
        return;
    probe_ray ray = read_ray(index);
    hit_record hit = trace(exact_start(ray.origin), ray.direction, ray.end, false);
    hit_record any = trace(exact_start(ray.origin), ray.direction, ray.end, true);
    write_first(index, hit, any.item != NO_ITEM);
    if (hit.item == NO_ITEM)
        return;
    surface s;
    make_surface(hit, ray.origin, ray.direction, s);
    bool same_side = dot3(ray.next, s.geometric) > 0.0;
    ray_start start = leave(s, hit, same_side ? s.geometric : -s.geometric);
    bool blocked = trace(start, ray.next, FAR_AWAY, true).item != NO_ITEM;
    write_second(index, trace(start, ray.next, FAR_AWAY, false), (same_side ? 1u : 0u) | (blocked ? 2u : 0u));
}
