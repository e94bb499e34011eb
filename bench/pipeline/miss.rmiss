// Nothing is hit.
#version 460
#extension GL_EXT_ray_tracing : require

layout(location = 0) rayPayloadInEXT uvec3 hit;

void main() { hit.z = 0xffffffffu; }
