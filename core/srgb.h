// The transfer function of sRGB (IEC 61966-2-1), both ways, of one channel in 0..1.
//
// Thread safety: pure functions.
#ifndef GLINT_CORE_SRGB_H
#define GLINT_CORE_SRGB_H

#include <stdbool.h>
#include <stdint.h>

// From a displayed value to linear light.
double srgb_decode(double displayed);
// The same of a byte, 0 to 255, without the C library's pow: the same bits on every platform, and within
// two units in the last place.
double srgb_decode_byte(uint32_t byte);
// The channels of 0xrrggbb, decoded or as they are displayed.
void srgb_of_hex(uint32_t hex, bool decodes, double out[3]);
// From linear light to a displayed value.
double srgb_encode(double linear);

#endif
