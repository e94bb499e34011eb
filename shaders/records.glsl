// A struct and a loader for each record of the scene: load_x(i). Fields that a kernel does not use are not
// fetched.
#include "records.h"

#define MEMBER_REAL3(name, word)            dvec3 name;
#define MEMBER_REAL(name, word, half)       double name;
#define MEMBER_VECTOR(name, word)           vec3 name;
#define MEMBER_FLOAT(name, word, component) float name;
#define MEMBER_UINT(name, word, component)  uint name;
#define MEMBERS(FIELDS) FIELDS(MEMBER_REAL3, MEMBER_REAL, MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT)

#define LOAD_REAL3(name, word)                                                                               \
    record.name = double3_of(FETCH(SOURCE, at + word), FETCH(SOURCE, at + word + 1u).xy);
#define LOAD_REAL(name, word, half)       record.name = packDouble2x32(FETCH(SOURCE, at + word).half);
#define LOAD_VECTOR(name, word)           record.name = uintBitsToFloat(FETCH(SOURCE, at + word).xyz);
#define LOAD_FLOAT(name, word, component) record.name = uintBitsToFloat(FETCH(SOURCE, at + word).component);
#define LOAD_UINT(name, word, component)  record.name = FETCH(SOURCE, at + word).component;
#define DEFINE_LOADER(type, loader, words, FIELDS)                                                           \
    type loader(uint index) {                                                                                \
        uint at = index * words;                                                                             \
        type record;                                                                                         \
        FIELDS(LOAD_REAL3, LOAD_REAL, LOAD_VECTOR, LOAD_FLOAT, LOAD_UINT)                                    \
        return record;                                                                                       \
    }

// The list and the size of a record that has one of each precision.
#ifdef DOUBLE_PRECISION
dvec3 double3_of(uvec4 a, uvec2 b) {
    return dvec3(packDouble2x32(a.xy), packDouble2x32(a.zw), packDouble2x32(b));
}
#define FIELDS_OF(record) record##64_FIELDS
#define WORDS_OF(record)  record##64_WORDS
#else
#define FIELDS_OF(record) record##_FIELDS
#define WORDS_OF(record)  record##_WORDS
#endif

struct node_record { MEMBERS(NODE_FIELDS) };
struct triangle_record { MEMBERS(FIELDS_OF(TRIANGLE)) };
struct sphere_record { MEMBERS(FIELDS_OF(SPHERE)) };
struct body_record { MEMBERS(FIELDS_OF(BODY)) };
struct material_record { MEMBERS(FIELDS_OF(MATERIAL)) };
struct light_record { MEMBERS(FIELDS_OF(LIGHT)) };
#define SOURCE triangle_nodes
DEFINE_LOADER(node_record, load_triangle_node, NODE_WORDS, NODE_FIELDS)
#undef SOURCE
#define SOURCE sphere_nodes
DEFINE_LOADER(node_record, load_sphere_node, NODE_WORDS, NODE_FIELDS)
#undef SOURCE
#define SOURCE triangles
DEFINE_LOADER(triangle_record, load_triangle, WORDS_OF(TRIANGLE), FIELDS_OF(TRIANGLE))
#undef SOURCE
#define SOURCE spheres
DEFINE_LOADER(sphere_record, load_sphere, WORDS_OF(SPHERE), FIELDS_OF(SPHERE))
#undef SOURCE
#define SOURCE bodies
DEFINE_LOADER(body_record, load_body, WORDS_OF(BODY), FIELDS_OF(BODY))
#undef SOURCE
#define SOURCE materials
DEFINE_LOADER(material_record, load_material, WORDS_OF(MATERIAL), FIELDS_OF(MATERIAL))
#undef SOURCE
#define SOURCE lights
DEFINE_LOADER(light_record, load_light, WORDS_OF(LIGHT), FIELDS_OF(LIGHT))
#undef SOURCE

// Normals in single precision are no records, but words.
#ifdef DOUBLE_PRECISION
struct normal_record { MEMBERS(NORMAL64_FIELDS) };
#define SOURCE normals
DEFINE_LOADER(normal_record, load_normal_record, NORMAL64_WORDS, NORMAL64_FIELDS)
#undef SOURCE
dvec3 load_normal(uint index) { return load_normal_record(index).unit; }
#else
vec3 load_normal(uint index) { return uintBitsToFloat(FETCH(normals, index).xyz); }
#endif
