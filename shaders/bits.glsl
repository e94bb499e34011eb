// Numbers of the kernel's precision as two components: a double's halves, the lower first, or a float's bits
// and 0. So a kernel's data for the host has the same layout in both precisions.
#ifdef DOUBLE_PRECISION
uvec2 bits_of(double x) { return unpackDouble2x32(x); }
double number_of(uvec2 bits) { return packDouble2x32(bits); }
#else
uvec2 bits_of(float x) { return uvec2(floatBitsToUint(x), 0u); }
float number_of(uvec2 bits) { return uintBitsToFloat(bits.x); }
#endif
