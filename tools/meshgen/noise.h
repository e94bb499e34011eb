// Gradient noise from hashed lattice points: no tables, no state, the same on every run and thread.
#ifndef GLINT_MESHGEN_NOISE_H
#define GLINT_MESHGEN_NOISE_H

#include <stdint.h>

// A well mixed 32-bit hash of a lattice point.
uint32_t noise_hash(int32_t x, int32_t y, uint32_t seed);
// The same, as a number in [0, 1).
double noise_random(int32_t x, int32_t y, uint32_t seed);

// Perlin's gradient noise (Improving Noise, 2002), about -0.7 to 0.7.
double noise_gradient(double x, double y, uint32_t seed);

// Sum of `octaves` noises, each of half the height and twice the frequency; about -1 to 1.
double noise_fractal(double x, double y, int octaves, uint32_t seed);

// Ridges: sharp crests where a noise crosses zero, finer ones growing on the higher ones (Musgrave's ridged
// multifractal, Texturing & Modeling, ch. 16); 0 to about 1.
double noise_ridged(double x, double y, int octaves, uint32_t seed);

// 0 below a, 1 above b, smooth between.
double noise_smoothstep(double a, double b, double x);

#endif
