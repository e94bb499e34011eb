// Loads record 0 of each kind and writes its fields one after another, each filled up to a word: the test
// that C structs and GLSL loaders agree (tests/unit/tracer/test_gpu.c).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "scene.glsl"
#include "records.glsl"

layout(local_size_x = 1) in;

// Vectors of doubles take two words.
#define STORE_REAL3(name, word)                                                                              \
    pixels[place++] = uvec4(unpackDouble2x32(record.name.x), unpackDouble2x32(record.name.y));               \
    pixels[place++] = uvec4(unpackDouble2x32(record.name.z), 0u, 0u);
#define STORE_REAL(name, word, half)       pixels[place++] = uvec4(unpackDouble2x32(record.name), 0u, 0u);
#define STORE_VECTOR(name, word)           pixels[place++] = uvec4(floatBitsToUint(record.name), 0u);
#define STORE_FLOAT(name, word, component) pixels[place++] = uvec4(floatBitsToUint(record.name), 0u, 0u, 0u);
#define STORE_UINT(name, word, component)  pixels[place++] = uvec4(record.name, 0u, 0u, 0u);
#define STORE(type, loader, FIELDS)                                                                          \
    {                                                                                                        \
        type record = loader(0u);                                                                            \
        FIELDS(STORE_REAL3, STORE_REAL, STORE_VECTOR, STORE_FLOAT, STORE_UINT)                               \
    }

void main() {
    uint place = 0u;
    STORE(node_record, load_triangle_node, NODE_FIELDS)
    STORE(node_record, load_sphere_node, NODE_FIELDS)
    STORE(triangle_record, load_triangle, FIELDS_OF(TRIANGLE))
    STORE(sphere_record, load_sphere, FIELDS_OF(SPHERE))
    STORE(body_record, load_body, FIELDS_OF(BODY))
    STORE(material_record, load_material, FIELDS_OF(MATERIAL))
    STORE(light_record, load_light, FIELDS_OF(LIGHT))
#ifdef DOUBLE_PRECISION
    STORE(normal_record, load_normal_record, NORMAL64_FIELDS)
#else
    pixels[place++] = uvec4(floatBitsToUint(load_normal(0u)), 0u);
#endif
}
