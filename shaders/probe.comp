// Traces rays that a test gives, one by one: the closest hit, any hit, and a ray that leaves the surface.
//
// In STATE three words a ray: origin, end; direction, -; direction of the second ray, -. In OUTPUT two: t, number
// of the closest hit (NO_ITEM in `item` where none), item, 1 where the search for any hit found one too; then t,
// number, item of the second ray's closest hit, and whether it left on the side that the first one came from.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_spirv_intrinsics : require
spirv_execution_mode(extensions = ["SPV_KHR_float_controls"], capabilities = [4466], 4461, 32);

#include "scene.glsl"
#include "records.glsl"
#include "math.glsl"
#include "tree.glsl"
#include "triangles.glsl"
#include "spheres.glsl"
#include "surface.glsl"

layout(local_size_x = TILE_PIXELS) in;

hit_record trace(vec3 origin, vec3 direction, float end, bool any) {
    hit_record hit = hit_record(end, 0.0, 0.0, NO_ITEM, 0u);
    uint iterations = 0u;
    if (HAS_SPHERES)
        trace_spheres(origin, direction, any, hit, iterations);
    if (HAS_TRIANGLES)
        trace_triangles(origin, direction, any, hit, iterations);
    return hit;
}

void main() {
    uint index = gl_WorkGroupID.x * TILE_PIXELS + gl_LocalInvocationID.x;
    if (index >= dispatch.tile_count)
        return;
    uvec4 w0 = states[3u * index], w1 = states[3u * index + 1u], w2 = states[3u * index + 2u];
    vec3 origin = uintBitsToFloat(w0.xyz), direction = uintBitsToFloat(w1.xyz), next = uintBitsToFloat(w2.xyz);
    hit_record hit = trace(origin, direction, uintBitsToFloat(w0.w), false);
    hit_record any = trace(origin, direction, uintBitsToFloat(w0.w), true);
    pixels[2u * index] = uvec4(floatBitsToUint(hit.t), hit.number, hit.item, any.item != NO_ITEM ? 1u : 0u);
    if (hit.item == NO_ITEM)
        return;
    surface s;
    make_surface(hit, origin, direction, s);
    bool same_side = dot3(next, s.geometric) > 0.0;
    vec3 start = ray_start(s.point, s.error, same_side ? s.geometric : -s.geometric);
    hit_record second = trace(start, next, FAR_AWAY, false);
    pixels[2u * index + 1u] =
        uvec4(floatBitsToUint(second.t), second.number, second.item, same_side ? 1u : 0u);
}
