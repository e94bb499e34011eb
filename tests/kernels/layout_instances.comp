// As layout.comp, of the records of scenes with instances: record 0 of each, its fields one after another, each
// filled up to a word (tests/unit/tracer/test_gpu.c).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "scene.glsl"
#include "records.glsl"
#include "math.glsl"
#include "tree.glsl"
#include "wide.glsl"
#include "triangles.glsl"

layout(local_size_x = 1) in;

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
#define STORE_DOUBLE(name, word, half64)    pixels[place++] = uvec4(unpackDouble2x32(record.name), 0u, 0u);
#define STORE_WHOLE(name, word, component)  pixels[place++] = uvec4(record.name, 0u, 0u, 0u);

void main() {
    uint place = 0u;
    {
        placed_record record = load_placed(0u);
        PLACED_FIELDS(STORE_DOUBLE, STORE_WHOLE)
    }
    {
        entry_record record = load_entry(0u);
        ENTRY_FIELDS(STORE_REAL3, STORE_REAL, STORE_FLOAT3, STORE_FLOAT, STORE_UINT)
    }
    {
        instance_record record = load_instance(0u);
        INSTANCE_FIELDS(STORE_DOUBLE, STORE_WHOLE)
    }
}
