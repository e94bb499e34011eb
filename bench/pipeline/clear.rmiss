// Nothing is between a surface and a light.
#version 460
#extension GL_EXT_ray_tracing : require

layout(location = 1) rayPayloadInEXT float seen;

void main() { seen = 1.0; }
