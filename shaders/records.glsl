// A struct and a loader for each record of the scene: load_x(i). Fields that a kernel does not use are not
// fetched.
#include "records.h"

#define MEMBER_VECTOR(name, word)          vec3 name;
#define MEMBER_FLOAT(name, word, component) float name;
#define MEMBER_UINT(name, word, component) uint name;
#define LOAD_VECTOR(name, word)            record.name = uintBitsToFloat(FETCH(SOURCE, at + word).xyz);
#define LOAD_FLOAT(name, word, component)  record.name = uintBitsToFloat(FETCH(SOURCE, at + word).component);
#define LOAD_UINT(name, word, component)   record.name = FETCH(SOURCE, at + word).component;

struct node_record { NODE_FIELDS(MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT) };
struct triangle_record { TRIANGLE_FIELDS(MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT) };
struct sphere_record { SPHERE_FIELDS(MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT) };
struct body_record { BODY_FIELDS(MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT) };
struct material_record { MATERIAL_FIELDS(MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT) };
struct light_record { LIGHT_FIELDS(MEMBER_VECTOR, MEMBER_FLOAT, MEMBER_UINT) };

#define DEFINE_LOADER(type, loader, words, FIELDS)                                                           \
    type loader(uint index) {                                                                                \
        uint at = index * words;                                                                             \
        type record;                                                                                         \
        FIELDS(LOAD_VECTOR, LOAD_FLOAT, LOAD_UINT)                                                           \
        return record;                                                                                       \
    }

#define SOURCE triangle_nodes
DEFINE_LOADER(node_record, load_triangle_node, NODE_WORDS, NODE_FIELDS)
#undef SOURCE
#define SOURCE sphere_nodes
DEFINE_LOADER(node_record, load_sphere_node, NODE_WORDS, NODE_FIELDS)
#undef SOURCE
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

vec3 load_normal(uint word) { return uintBitsToFloat(FETCH(normals, word).xyz); }
