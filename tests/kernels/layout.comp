// Loads record 0 of each kind and writes its fields one after another, each filled up to a word: the test
// that C structs and GLSL loaders agree (tests/unit/test_gpu.c).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "scene.glsl"
#include "records.glsl"

layout(local_size_x = 1) in;

// Doubles lie in their bits; three of them take two words.
#ifdef DOUBLE_PRECISION
#define STORE_REAL3(name, word, word64)                                                                      \
    pixels[place++] = uvec4(unpackDouble2x32(record.name.x), unpackDouble2x32(record.name.y));               \
    pixels[place++] = uvec4(unpackDouble2x32(record.name.z), 0u, 0u);
#define STORE_REAL(name, word, component, word64, half64)                                                    \
    pixels[place++] = uvec4(unpackDouble2x32(record.name), 0u, 0u);
#else
#define STORE_REAL3(name, word, word64) pixels[place++] = uvec4(floatBitsToUint(record.name), 0u);
#define STORE_REAL(name, word, component, word64, half64)                                                    \
    pixels[place++] = uvec4(floatBitsToUint(record.name), 0u, 0u, 0u);
#endif
#define STORE_FLOAT3(name, word, word64) pixels[place++] = uvec4(floatBitsToUint(record.name), 0u);
#define STORE_FLOAT(name, word, component, word64, component64)                                              \
    pixels[place++] = uvec4(floatBitsToUint(record.name), 0u, 0u, 0u);
#define STORE_UINT(name, word, component, word64, component64) pixels[place++] = uvec4(record.name, 0u, 0u, 0u);
#define STORE(type, loader, FIELDS)                                                                          \
    {                                                                                                        \
        type record = loader(0u);                                                                            \
        FIELDS(STORE_REAL3, STORE_REAL, STORE_FLOAT3, STORE_FLOAT, STORE_UINT)                               \
    }

void main() {
    uint place = 0u;
    STORE(node_record, load_triangle_node, NODE_FIELDS)
    STORE(node_record, load_sphere_node, NODE_FIELDS)
    STORE(triangle_record, load_triangle, TRIANGLE_FIELDS)
    STORE(sphere_record, load_sphere, SPHERE_FIELDS)
    STORE(body_record, load_body, BODY_FIELDS)
    STORE(material_record, load_material, MATERIAL_FIELDS)
    STORE(light_record, load_light, LIGHT_FIELDS)
    STORE(normal_record, load_normal_record, NORMAL_FIELDS)
}
