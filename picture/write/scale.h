// A picture of another size: bilinear, between the middles of pixels, its border repeated.
//
// Values are taken as they are, linear or displayed. Ownership: the caller's arrays. Thread safety: works on
// as many threads as there are processors.
#ifndef GLINT_PICTURE_WRITE_SCALE_H
#define GLINT_PICTURE_WRITE_SCALE_H

#include <stdint.h>

// For pixel `at` of `to` in a row: the two of `from` around its middle, and how far it is from the first.
double scale_around(uint32_t at, uint32_t from, uint32_t to, uint32_t places[2]);
// Three values per pixel, rows from the top.
void scale_picture(const float *in, uint32_t width, uint32_t height, float *out, uint32_t to_width,
                   uint32_t to_height);

#endif
