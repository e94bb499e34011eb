// The transfer function of sRGB (IEC 61966-2-1), both ways, of one channel in 0..1.
//
// Thread safety: pure functions.
#ifndef GLINT_CORE_SRGB_H
#define GLINT_CORE_SRGB_H

// From a displayed value to linear light.
double srgb_decode(double displayed);
// From linear light to a displayed value.
double srgb_encode(double linear);

#endif
