// What each kernel begins with: bindings, specialization constants and the only access to the scene's words.
//
// WORDS are texel buffers on CPU devices (lavapipe loads a texel in one piece, but a storage buffer lane by
// lane) and storage buffers on GPUs; on web pages they are parts of one buffer. FETCH hides which.
#extension GL_EXT_spirv_intrinsics : require
// SignedZeroInfNanPreserve, else a compiler may assume that NaN does not occur; stripped if a device lacks
// it; tools/spirv_exact requests it for doubles too.
spirv_execution_mode(extensions = ["SPV_KHR_float_controls"], capabilities = [4466], 4461, 32);

#include "features.h"
#include "frame.h"
#include "gpu_scene.h"
#include "real.h"
#ifdef WEBGPU
#include "web.h"
#endif

layout(constant_id = CONSTANT_FEATURES) const uint FEATURES = 0xffffffffu;
layout(constant_id = CONSTANT_MORE_FEATURES) const uint MORE_FEATURES = 0xffffffffu;
layout(constant_id = CONSTANT_TRIANGLE_STACK) const uint TRIANGLE_STACK = 32u;
layout(constant_id = CONSTANT_SPHERE_STACK) const uint SPHERE_STACK = 32u;
layout(constant_id = CONSTANT_PACKED_GROUPS) const bool PACKED_GROUPS = false;

const bool HAS_TRIANGLES = (FEATURES & FEATURE_TRIANGLES) != 0u;
const bool HAS_SPHERES = (FEATURES & FEATURE_SPHERES) != 0u;
const bool HAS_DIFFUSE = (FEATURES & FEATURE_DIFFUSE) != 0u;
const bool HAS_SPECULAR = (FEATURES & FEATURE_SPECULAR) != 0u;
const bool HAS_REFLECTION = (FEATURES & FEATURE_REFLECTION) != 0u;
const bool HAS_REFRACTION = (FEATURES & FEATURE_REFRACTION) != 0u;
const bool HAS_BRANCHES = HAS_REFLECTION && HAS_REFRACTION;
const bool HAS_SHADOWS = (FEATURES & FEATURE_SHADOWS) != 0u;
const bool HAS_SMOOTH = (FEATURES & FEATURE_SMOOTH) != 0u;
const bool HAS_CHECKER = (FEATURES & FEATURE_CHECKER) != 0u;
const bool HAS_POINT_LIGHT = (FEATURES & FEATURE_POINT_LIGHT) != 0u;
const bool HAS_DIRECTION_LIGHT = (FEATURES & FEATURE_DIRECTION_LIGHT) != 0u;
const bool HAS_INVERSE_SQUARE = (FEATURES & FEATURE_INVERSE_SQUARE) != 0u;
const bool HAS_BACKGROUND_IMAGE = (FEATURES & FEATURE_BACKGROUND_IMAGE) != 0u;
const bool HAS_DEPTH_BLACK = (FEATURES & FEATURE_DEPTH_BLACK) != 0u;
const bool HAS_SLICES = (FEATURES & FEATURE_SLICES) != 0u;
const bool HAS_MANY_LIGHTS = (FEATURES & FEATURE_MANY_LIGHTS) != 0u;
const bool BEGINS = (FEATURES & FEATURE_BEGINS) != 0u;
const bool HAS_MEDIA = (FEATURES & FEATURE_MEDIA) != 0u;
const bool HAS_ATTENUATION = (FEATURES & FEATURE_ATTENUATION) != 0u; // only with HAS_MEDIA
const bool HAS_FRESNEL = (FEATURES & FEATURE_FRESNEL) != 0u;
const bool HAS_ROUGHNESS = (FEATURES & FEATURE_ROUGHNESS) != 0u;
const bool HAS_CLEAR_SHADOWS = (FEATURES & FEATURE_CLEAR_SHADOWS) != 0u;
const bool HAS_TEXTURES = (FEATURES & FEATURE_TEXTURES) != 0u;
const bool HAS_FOOTPRINT = (FEATURES & FEATURE_FOOTPRINT) != 0u;
const bool HAS_SOFT_LIGHT = (FEATURES & FEATURE_SOFT_LIGHT) != 0u;
const bool HAS_AMBIENT = (FEATURES & FEATURE_AMBIENT) != 0u;
const bool HAS_OCCLUSION = (FEATURES & FEATURE_OCCLUSION) != 0u; // only with HAS_AMBIENT
const bool HAS_EMISSION = (FEATURES & FEATURE_EMISSION) != 0u;
const bool HAS_CAMERA = (FEATURES & FEATURE_CAMERA) != 0u;
const bool HAS_SKY_LIGHT = (FEATURES & FEATURE_SKY_LIGHT) != 0u;
const bool HAS_SEEN_LIGHT = (MORE_FEATURES & FEATURE_SEEN_LIGHT.y) != 0u;
const bool HAS_CONES = (MORE_FEATURES & FEATURE_CONES.y) != 0u;
const bool HAS_TURNED = (MORE_FEATURES & FEATURE_TURNED.y) != 0u;
const bool HAS_SPOT = (MORE_FEATURES & FEATURE_SPOT.y) != 0u;
const bool HAS_REFLECTION_COLOR = (MORE_FEATURES & FEATURE_REFLECTION_COLOR.y) != 0u;
const bool HAS_TINT = HAS_ATTENUATION || HAS_REFLECTION_COLOR; // the channels of a path are weakened apart
// What a path and its waiting rays carry with them.
const bool CARRIES = HAS_MEDIA || HAS_REFLECTION_COLOR;
const uint CARRIED_WORDS = HAS_MEDIA ? MEDIA_WORDS : HAS_REFLECTION_COLOR ? TINT_WORDS : 0u;
const bool HAS_ROUND = HAS_SPHERES || HAS_CONES; // the tree of spheres has something
const bool HAS_PLACES = HAS_SOFT_LIGHT || HAS_OCCLUSION || HAS_SKY_LIGHT; // shadow rays know where they end
const bool HAS_SIDES = HAS_MEDIA || HAS_FRESNEL; // surfaces know the indices on both sides
const bool HAS_COUNTERS = (FEATURES & FEATURE_COUNTERS) != 0u;
// Of this invocation, with HAS_COUNTERS.
uint counted_nodes = 0u, counted_items = 0u, counted_unseen = 0u;

#ifdef FETCH_TEXELS
#define WORDS(number, name) layout(set = 0, binding = number) uniform usamplerBuffer name;
#define FETCH(name, index)  texelFetch(name, int(index))
#elif defined(WEBGPU)
#define WORDS(number, name)
#define FETCH_OF(name, index) all_words[dispatch.begin_##name + (index)]
#define FETCH(name, index)    FETCH_OF(name, index)
layout(set = 0, binding = BINDING_WORDS, std430) readonly restrict buffer word_block { uvec4 all_words[]; };
#else
#define WORDS(number, name)                                                                                  \
    layout(set = 0, binding = number, std430) readonly restrict buffer name##_words { uvec4 name[]; };
#define FETCH(name, index) name[index]
#endif

// A loop that often has nothing to do. lavapipe leaves a loop only at the end of its body: it runs the body of a
// `while` once more with all lanes off. So there the body first tests whether it is wanted, and the loop ends at its
// condition; an unwanted body may fetch from outside a buffer, which reads as some number (tracer/gpu/gpu_device.c).
#ifdef FETCH_TEXELS
#define WHILE(condition)     do {
#define END_WHILE(condition) } while (condition);
#define IS_WANTED(condition) (condition)
#else
#define WHILE(condition)     while (condition) {
#define END_WHILE(condition) }
#define IS_WANTED(condition) true
#endif

WORDS(BINDING_TRIANGLE_NODES, triangle_nodes)
WORDS(BINDING_TRIANGLES, triangles)
WORDS(BINDING_NORMALS, normals)
WORDS(BINDING_SPHERE_NODES, sphere_nodes)
WORDS(BINDING_SPHERES, spheres)
WORDS(BINDING_BODIES, bodies)
WORDS(BINDING_MATERIALS, materials)
WORDS(BINDING_LIGHTS, lights)
WORDS(BINDING_PAINTS, paints)
#ifdef INSTANCES
WORDS(BINDING_INSTANCES, instances)
#endif
#ifndef WEBGPU
layout(set = 0, binding = BINDING_BACKGROUND) uniform samplerBuffer background_texels;
#endif
layout(set = 0, binding = BINDING_OUTPUT, std430) restrict buffer output_words { uvec4 pixels[]; };
layout(set = 0, binding = BINDING_STATE, std430) restrict buffer state_words { uvec4 states[]; };
layout(set = 0, binding = BINDING_COUNTERS, std430) restrict buffer counter_words { uint counters[]; };

#define VECTOR_FIELD(name) vec3 name;
#define FLOAT_FIELD(name)  float name;
#define UINT_FIELD(name)   uint name;
#ifdef DOUBLE_PRECISION
#define DOUBLE_FIELD(name) double name;
layout(set = 0, binding = BINDING_FRAME, std140) uniform frame_block {
    FRAME_FIELDS(VECTOR_FIELD, FLOAT_FIELD, UINT_FIELD)
    FRAME_DOUBLE_FIELDS(DOUBLE_FIELD)
} frame;
#define CAMERA(name) dvec3(frame.double_##name##_x, frame.double_##name##_y, frame.double_##name##_z)
#define BACKGROUND_TURN dvec2(frame.double_background_cos, frame.double_background_sin)
#else
layout(set = 0, binding = BINDING_FRAME, std140) uniform frame_block {
    FRAME_FIELDS(VECTOR_FIELD, FLOAT_FIELD, UINT_FIELD)
} frame;
#define CAMERA(name) frame.camera_##name
#define BACKGROUND_TURN vec2(frame.background_cos, frame.background_sin)
#endif
#ifdef WEBGPU
layout(set = 0, binding = BINDING_DISPATCH, std140) uniform dispatch_block {
    DISPATCH_FIELDS(FLOAT_FIELD, UINT_FIELD)
    WEB_FIELDS(UINT_FIELD)
} dispatch;
#else
layout(push_constant) uniform dispatch_block {
    DISPATCH_FIELDS(FLOAT_FIELD, UINT_FIELD)
} dispatch;
#endif

// The z of every dispatch's workgroups, which no compiler knows. lavapipe recompiles a kernel for each value
// of a uniform that alone decides a branch or a loop's end: such conditions are mixed with this.
#define OPAQUE_ZERO gl_WorkGroupID.z

// Whether the scene needs a feature of the kernel: a general kernel serves scenes that need less.
bool wants(uint feature) { return (frame.features & feature) > OPAQUE_ZERO; }
