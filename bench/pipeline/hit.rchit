// What a ray hits first: the ray generation shader makes the surface of it, so that all shading is in one place.
#version 460
#extension GL_EXT_ray_tracing : require

layout(location = 0) rayPayloadInEXT uvec3 hit;
hitAttributeEXT vec2 place;

void main() { hit = uvec3(floatBitsToUint(place), uint(gl_PrimitiveID)); }
