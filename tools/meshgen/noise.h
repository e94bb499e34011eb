// Gradient noise from hashed lattice points: no tables, no state, the same on every run and thread.
#ifndef GLINT_MESHGEN_NOISE_H
#define GLINT_MESHGEN_NOISE_H

#include <stdint.h>

// The same, as a number in [0, 1).
double noise_random(int32_t x, int32_t y, uint32_t seed);

// Sum of `octaves` noises, each of half the height and twice the frequency; about -1 to 1.
double noise_fractal(double x, double y, int octaves, uint32_t seed);

// Ridges: sharp crests where a noise crosses zero, finer ones growing on the higher ones (Musgrave's ridged
// multifractal, Texturing & Modeling, ch. 16); 0 to about 1.
double noise_ridged(double x, double y, int octaves, uint32_t seed);

// 0 below a, 1 above b, smooth between.
double noise_smoothstep(double a, double b, double x);

#endif
