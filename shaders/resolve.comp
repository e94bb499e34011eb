// Makes a picture from samples traced at once: their sum, in the order of the samples, by rows of pixels; and the number
// of pixels with faults. The numbers are the same, bit for bit, as when each sample is added to those before it.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "scene.glsl"
#include "records.glsl"
#include "math.glsl"
#include "camera.glsl"
#include "picture.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(set = 0, binding = BINDING_SUMS, std430) restrict buffer sum_words { uvec4 sums[]; };

uvec4 add_sample(uvec4 before, uvec4 next) {
    vec3 sum = uintBitsToFloat(before.xyz) + uintBitsToFloat(next.xyz);
    bool finite = is_finite3(sum);
    uint fault = finite ? next.w : FAULT_NOT_FINITE << FAULT_KIND_SHIFT | (next.w & FAULT_NUMBER);
    return uvec4(finite ? floatBitsToUint(sum) : before.xyz, kind_of(before.w) != FAULT_NONE ? before.w : fault);
}

void main() {
    uint group = gl_WorkGroupID.y * dispatch.grid_width + gl_WorkGroupID.x;
    uint slot = group * TILE_PIXELS + gl_LocalInvocationID.x, slots = dispatch.tile_count * TILE_PIXELS;
    if (slot >= slots)
        return;
    uvec2 pixel = pixel_in_order(slot);
    if (pixel.x >= frame.width || pixel.y >= frame.height)
        return;
    uvec4 sum = dispatch.sample_index > OPAQUE_ZERO ? sums[slot] : uvec4(0u);
    for (uint k = 0u; k < dispatch.samples; k++)
        sum = add_sample(sum, pixels[k * slots + slot]);
    uint at = pixel.y * frame.width + pixel.x, kind = kind_of(sum.w);
    if (dispatch.read_list == RESOLVE_ADD)
        sums[slot] = sum;
    if (dispatch.read_list == RESOLVE_SHOW)
        show(pixel, sum);
    if (dispatch.read_list == RESOLVE_FIND && kind != FAULT_NONE && counters[COUNTER_FAULT_FIRST + kind] == ~at)
        counters[COUNTER_FAULT_WORD + kind] = sum.w;
}
