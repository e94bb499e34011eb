// A struct and a loader for each record of the scene: load_x(i). Fields that a kernel does not use are not
// fetched.
#include "records.h"

#define MEMBER_REAL3(name, word, word64)                              REAL3 name;
#define MEMBER_REAL(name, word, component, word64, half64)            REAL name;
#define MEMBER_FLOAT3(name, word, word64)                             vec3 name;
#define MEMBER_FLOAT(name, word, component, word64, component64)      float name;
#define MEMBER_UINT(name, word, component, word64, component64)       uint name;
#define MEMBERS(FIELDS) FIELDS(MEMBER_REAL3, MEMBER_REAL, MEMBER_FLOAT3, MEMBER_FLOAT, MEMBER_UINT)

#ifdef DOUBLE_PRECISION
dvec3 double3_of(uvec4 a, uvec2 b) {
    return dvec3(packDouble2x32(a.xy), packDouble2x32(a.zw), packDouble2x32(b));
}
#define LOAD_REAL3(name, word, word64)                                                                       \
    record.name = double3_of(FETCH(SOURCE, at + word64), FETCH(SOURCE, at + word64 + 1u).xy);
#define LOAD_REAL(name, word, component, word64, half64)                                                     \
    record.name = packDouble2x32(FETCH(SOURCE, at + word64).half64);
// A double from its leading float and its last bits: for a float converted to double those are 0.
double split_double(float first, uint rest) {
    return packDouble2x32(unpackDouble2x32(double(first)) | uvec2(rest, 0u));
}
dvec3 split_double3(vec3 first, uvec3 rest) {
    return dvec3(split_double(first.x, rest.x), split_double(first.y, rest.y), split_double(first.z, rest.z));
}
#define LOAD_SPLIT3(name, word, word64)                                                                      \
    record.name = split_double3(uintBitsToFloat(FETCH(SOURCE, at + word64).xyz),                             \
                                FETCH(SOURCE, at + word64 + TRIANGLE_REST).xyz);
#define WORD_OF(word, word64)       word64
#define PART_OF(component, part64)  part64
#define WORDS_OF(record)            record##64_WORDS
#else
#define LOAD_REAL3(name, word, word64) record.name = uintBitsToFloat(FETCH(SOURCE, at + word).xyz);
#define LOAD_REAL(name, word, component, word64, half64)                                                     \
    record.name = uintBitsToFloat(FETCH(SOURCE, at + word).component);
#define LOAD_SPLIT3                 LOAD_REAL3
#define WORD_OF(word, word64)       word
#define PART_OF(component, part64)  component
#define WORDS_OF(record)            record##_WORDS
#endif
#define LOAD_FLOAT3(name, word, word64)                                                                      \
    record.name = uintBitsToFloat(FETCH(SOURCE, at + WORD_OF(word, word64)).xyz);
#define LOAD_FLOAT(name, word, component, word64, component64)                                               \
    record.name = uintBitsToFloat(FETCH(SOURCE, at + WORD_OF(word, word64)).PART_OF(component, component64));
#define LOAD_UINT(name, word, component, word64, component64)                                                \
    record.name = FETCH(SOURCE, at + WORD_OF(word, word64)).PART_OF(component, component64);
#define DEFINE_LOADER_OF(type, loader, words, FIELDS, LOAD_PLACE)                                            \
    type loader(uint index) {                                                                                \
        uint at = index * words;                                                                             \
        type record;                                                                                         \
        FIELDS(LOAD_PLACE, LOAD_REAL, LOAD_FLOAT3, LOAD_FLOAT, LOAD_UINT)                                     \
        return record;                                                                                       \
    }
#define DEFINE_LOADER(type, loader, words, FIELDS) DEFINE_LOADER_OF(type, loader, words, FIELDS, LOAD_REAL3)

struct node_record { MEMBERS(NODE_FIELDS) };
struct triangle_record { MEMBERS(TRIANGLE_FIELDS) };
struct outline_record { MEMBERS(OUTLINE_FIELDS) };
struct sphere_record { MEMBERS(SPHERE_FIELDS) };
struct body_record { MEMBERS(BODY_FIELDS) };
struct material_record { MEMBERS(MATERIAL_FIELDS) };
struct light_record { MEMBERS(LIGHT_FIELDS) };
struct paint_record { MEMBERS(PAINT_FIELDS) };
struct extent_record { MEMBERS(EXTENT_FIELDS) };
struct seen_record { MEMBERS(SEEN_FIELDS) };
struct frustum_record { MEMBERS(FRUSTUM_FIELDS) };
struct normal_record { MEMBERS(NORMAL_FIELDS) };
#define SOURCE triangle_nodes
DEFINE_LOADER(node_record, load_triangle_node, NODE_WORDS, NODE_FIELDS)
#undef SOURCE
#define SOURCE sphere_nodes
DEFINE_LOADER(node_record, load_sphere_node, NODE_WORDS, NODE_FIELDS)
#undef SOURCE
#ifndef INSTANCES
#define SOURCE triangles
DEFINE_LOADER_OF(triangle_record, load_triangle, WORDS_OF(TRIANGLE), TRIANGLE_FIELDS, LOAD_SPLIT3)
DEFINE_LOADER(outline_record, load_outline, WORDS_OF(TRIANGLE), OUTLINE_FIELDS)
#undef SOURCE
#endif
#define SOURCE spheres
const uint SPHERE_STRIDE = HAS_CONES ? WORDS_OF(FRUSTUM) : WORDS_OF(SPHERE);
DEFINE_LOADER(sphere_record, load_sphere, SPHERE_STRIDE, SPHERE_FIELDS)
DEFINE_LOADER(frustum_record, load_frustum, WORDS_OF(FRUSTUM), FRUSTUM_FIELDS)
bool is_frustum(uint item) { return (load_sphere(item).shade & FRUSTUM_SHADE) != 0u; }
#undef SOURCE
#define SOURCE bodies
DEFINE_LOADER(body_record, load_body, WORDS_OF(BODY), BODY_FIELDS)
#undef SOURCE
#define SOURCE materials
DEFINE_LOADER(material_record, load_material, WORDS_OF(MATERIAL), MATERIAL_FIELDS)
#undef SOURCE
#define SOURCE lights
DEFINE_LOADER(light_record, load_light, WORDS_OF(LIGHT), LIGHT_FIELDS)
#define AFTER_LIGHTS WORDS_OF(EXTENT) + frame.light_count * WORDS_OF(LIGHT)
DEFINE_LOADER(extent_record, load_extent, AFTER_LIGHTS, EXTENT_FIELDS)
#define FROM_SEEN_TABLE WORDS_OF(SEEN) + frame.seen_table
DEFINE_LOADER(seen_record, load_seen, FROM_SEEN_TABLE, SEEN_FIELDS)
#undef SOURCE
#define SOURCE paints
DEFINE_LOADER(paint_record, load_paint, WORDS_OF(PAINT), PAINT_FIELDS)
#undef SOURCE

#ifndef INSTANCES
#define SOURCE normals
DEFINE_LOADER(normal_record, load_normal_record, WORDS_OF(NORMAL), NORMAL_FIELDS)
#undef SOURCE
REAL3 load_normal(body_record body, uint index) { return load_normal_record(index).unit; }
#endif
