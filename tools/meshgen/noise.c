#include "tools/meshgen/noise.h"

#include <math.h>

// A well mixed 32-bit hash of a lattice point.
static uint32_t noise_hash(int32_t x, int32_t y, uint32_t seed) {
    uint32_t h = seed * 0x9e3779b9u + (uint32_t)x * 0x85ebca6bu + (uint32_t)y * 0xc2b2ae35u;
    h ^= h >> 15;
    h *= 0x7feb352du;
    return h ^ h >> 16;
}

double noise_random(int32_t x, int32_t y, uint32_t seed) {
    return noise_hash(x, y, seed) * (1.0 / 4294967296.0);
}

// One of 16 directions, picked by 4 bits, dotted with the way from the lattice point.
static double slope(uint32_t bits, double dx, double dy) {
    static const double along[20] = {1,       0.9239, 0.7071,  0.3827,  0,       -0.3827, -0.7071,
                                     -0.9239, -1,     -0.9239, -0.7071, -0.3827, 0,       0.3827,
                                     0.7071,  0.9239, 1,       0.9239,  0.7071,  0.3827};
    uint32_t direction = bits & 15;
    return along[direction + 4] * dx + along[direction] * dy;
}

static double fade(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

// floor() is a call into the library on the oldest processors, and this is the innermost loop.
static int32_t floor_to_int(double x) {
    int32_t i = (int32_t)x;
    return i - (x < i);
}

// Perlin's gradient noise (Improving Noise, 2002), about -0.7 to 0.7.
static double noise_gradient(double x, double y, uint32_t seed) {
    int32_t i = floor_to_int(x), j = floor_to_int(y);
    double dx = x - i, dy = y - j, u = fade(dx), v = fade(dy);
    double a = slope(noise_hash(i, j, seed), dx, dy), b = slope(noise_hash(i + 1, j, seed), dx - 1, dy);
    double c = slope(noise_hash(i, j + 1, seed), dx, dy - 1),
           d = slope(noise_hash(i + 1, j + 1, seed), dx - 1, dy - 1);
    double low = a + u * (b - a), high = c + u * (d - c);
    return low + v * (high - low);
}

// Each octave is turned, so that the lattice's directions do not add up.
static void next_octave(double *x, double *y) {
    double turned_x = 1.6 * *x + 1.2 * *y;
    *y = 1.6 * *y - 1.2 * *x;
    *x = turned_x;
}

double noise_fractal(double x, double y, int octaves, uint32_t seed) {
    double sum = 0, height = 0.75;
    for (int i = 0; i < octaves; i++) {
        sum += height * noise_gradient(x, y, seed + (uint32_t)i);
        height *= 0.5;
        next_octave(&x, &y);
    }
    return sum;
}

double noise_ridged(double x, double y, int octaves, uint32_t seed) {
    double sum = 0, height = 0.5, weight = 1;
    for (int i = 0; i < octaves; i++) {
        double ridge = 1 - fabs(1.6 * noise_gradient(x, y, seed + (uint32_t)i));
        ridge = fmax(0, ridge);
        ridge *= ridge * weight;
        weight = fmin(1, 2 * ridge);
        sum += height * ridge;
        height *= 0.5;
        next_octave(&x, &y);
    }
    return sum;
}

double noise_smoothstep(double a, double b, double x) {
    double t = (x - a) / (b - a);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return t * t * (3 - 2 * t);
}
