// A struct and a loader for each record of the scene: load_x(i). Fields that a kernel does not use are not
// fetched.
#include "records.h"

#define MEMBER_VECTOR(name, word)          vec3 name;
#define MEMBER_FLOAT(name, word, component) float name;
#define MEMBER_UINT(name, word, component) uint name;
#define LOAD_VECTOR(name, word)            record.name = uintBitsToFloat(FETCH(SOURCE, at + word).xyz);
#define LOAD_FLOAT(name, word, component)  record.name = uintBitsToFloat(FETCH(SOURCE, at + word).component);
#define LOAD_UINT(name, word, component)   record.name = FETCH(SOURCE, at + word).component;

#define DEFINE_LOADER(type, loader, words, FIELDS)                                                           \
    type loader(uint index) {                                                                                \
        uint at = index * words;                                                                             \
        type record;                                                                                         \
        FIELDS(LOAD_VECTOR, LOAD_FLOAT, LOAD_UINT)                                                           \
        return record;                                                                                       \
    }

struct node_record { NODE_FIELDS(MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT) };
#define SOURCE triangle_nodes
DEFINE_LOADER(node_record, load_triangle_node, NODE_WORDS, NODE_FIELDS)
#undef SOURCE
#define SOURCE sphere_nodes
DEFINE_LOADER(node_record, load_sphere_node, NODE_WORDS, NODE_FIELDS)
#undef SOURCE

#ifdef DOUBLE_PRECISION
dvec3 double3_of(uvec4 a, uvec2 b) {
    return dvec3(packDouble2x32(a.xy), packDouble2x32(a.zw), packDouble2x32(b));
}
#define MEMBER_REAL3(name, word)      dvec3 name;
#define MEMBER_REAL(name, word, half) double name;
#define LOAD_REAL3(name, word)                                                                               \
    record.name = double3_of(FETCH(SOURCE, at + word), FETCH(SOURCE, at + word + 1u).xy);
#define LOAD_REAL(name, word, half) record.name = packDouble2x32(FETCH(SOURCE, at + word).half);
#define MEMBERS(FIELDS)             FIELDS(MEMBER_REAL3, MEMBER_REAL, MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT)
#define DEFINE_LOADER64(type, loader, words, FIELDS)                                                         \
    type loader(uint index) {                                                                                \
        uint at = index * words;                                                                             \
        type record;                                                                                         \
        FIELDS(LOAD_REAL3, LOAD_REAL, LOAD_VECTOR, LOAD_FLOAT, LOAD_UINT)                                    \
        return record;                                                                                       \
    }

struct triangle_record { MEMBERS(TRIANGLE64_FIELDS) };
struct sphere_record { MEMBERS(SPHERE64_FIELDS) };
struct normal_record { MEMBERS(NORMAL64_FIELDS) };
struct body_record { MEMBERS(BODY64_FIELDS) };
struct material_record { MEMBERS(MATERIAL64_FIELDS) };
struct light_record { MEMBERS(LIGHT64_FIELDS) };
#define SOURCE triangles
DEFINE_LOADER64(triangle_record, load_triangle, TRIANGLE64_WORDS, TRIANGLE64_FIELDS)
#undef SOURCE
#define SOURCE spheres
DEFINE_LOADER64(sphere_record, load_sphere, SPHERE64_WORDS, SPHERE64_FIELDS)
#undef SOURCE
#define SOURCE normals
DEFINE_LOADER64(normal_record, load_normal_record, NORMAL64_WORDS, NORMAL64_FIELDS)
#undef SOURCE
#define SOURCE bodies
DEFINE_LOADER64(body_record, load_body, BODY64_WORDS, BODY64_FIELDS)
#undef SOURCE
#define SOURCE materials
DEFINE_LOADER64(material_record, load_material, MATERIAL64_WORDS, MATERIAL64_FIELDS)
#undef SOURCE
#define SOURCE lights
DEFINE_LOADER64(light_record, load_light, LIGHT64_WORDS, LIGHT64_FIELDS)
#undef SOURCE

dvec3 load_normal(uint index) { return load_normal_record(index).unit; }
#else
struct triangle_record { TRIANGLE_FIELDS(MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT) };
struct sphere_record { SPHERE_FIELDS(MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT) };
struct body_record { BODY_FIELDS(MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT) };
struct material_record { MATERIAL_FIELDS(MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT) };
struct light_record { LIGHT_FIELDS(MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT) };
#define SOURCE triangles
DEFINE_LOADER(triangle_record, load_triangle, TRIANGLE_WORDS, TRIANGLE_FIELDS)
#undef SOURCE
#define SOURCE spheres
DEFINE_LOADER(sphere_record, load_sphere, SPHERE_WORDS, SPHERE_FIELDS)
#undef SOURCE
#define SOURCE bodies
DEFINE_LOADER(body_record, load_body, BODY_WORDS, BODY_FIELDS)
#undef SOURCE
#define SOURCE materials
DEFINE_LOADER(material_record, load_material, MATERIAL_WORDS, MATERIAL_FIELDS)
#undef SOURCE
#define SOURCE lights
DEFINE_LOADER(light_record, load_light, LIGHT_WORDS, LIGHT_FIELDS)
#undef SOURCE

vec3 load_normal(uint index) { return uintBitsToFloat(FETCH(normals, index).xyz); }
#endif
