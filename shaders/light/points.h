/* Points of the unit square, one for each sample of whatever has extent: a light, a lens, a rough surface.
   They look random, cover the square evenly, and are the same each time; compiled by C and by GLSL.

   The point of sample n is that of Sobol's first two dimensions (Sobol 1967), with nested random swaps of
   halves (Owen 1995) by hashes (Laine and Karras 2011; constants of Vegdahl 2021, "Building a Better LK
   Hash"); pairs of dimensions are independent by other swaps in the order of the points (Burley 2020,
   "Practical Hash-based Owen Scrambling"). Samples of neighbouring pixels are neighbours in one sequence,
   along Morton's curve, so that their errors differ and a viewer's eye averages them (Ahmed and Wonka 2020,
   "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels").
   Squares of POINT_SQUARE pixels have sequences of their own.

   What is sampled has a key: that of its path's ray, and what it is. Pure. */
#ifndef GLINT_SHADERS_LIGHT_POINTS_H
#define GLINT_SHADERS_LIGHT_POINTS_H

#ifdef __STDC_VERSION__
#include <stdint.h>
#define POINT_UINT       uint32_t
#define POINT_FUNCTION   static inline uint32_t
#define POINT_REVERSE(x) point_reverse(x)
static inline uint32_t point_reverse(uint32_t x) {
    x = x >> 16 | x << 16;
    x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
    x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    return (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
}
#else
#define POINT_UINT       uint
#define POINT_FUNCTION   uint
#define POINT_REVERSE(x) bitfieldReverse(x)
#endif

/* What is sampled at a ray's hit or start. A ray that leaves a hit has a key of its own; one that passes a
   surface unseen keeps its key. */
#define POINT_SAME      0u
#define POINT_REFLECTED 1u
#define POINT_REFRACTED 2u
#define POINT_LENS      3u
#define POINT_AMBIENT   4u
#define POINT_SKY       5u  /* of a background that lights */
#define POINT_PIXEL     6u  /* the place in the pixel, where pixels end by their error */
#define POINT_ROUGH     7u  /* a facet of the surface that it hits */
#define POINT_LIGHT     16u /* and from here on the lights */

#define POINT_SQUARE   256u       /* pixels per side, a power of two of at most 8 bits */
#define POINT_MOST     16u        /* bits of a sample's number that have places in one sequence */
#define POINT_FRACTION 0x1p-24    /* of the 24 bits of a coordinate: C */
#define POINT_DIVISOR  16777216.0 /* the same: GLSL */

/* lowbias32 of Wellons 2018, "Prospecting for Hash Functions", with the constants found since. */
POINT_FUNCTION point_hash(POINT_UINT x) {
    x ^= x >> 16;
    x *= 0x21f0aaadu;
    x ^= x >> 15;
    x *= 0xd35a2d97u;
    return x ^ x >> 15;
}

/* The key of what is sampled at a ray whose key is `ray`. */
POINT_FUNCTION point_key(POINT_UINT ray, POINT_UINT what) {
    return what == POINT_SAME ? ray : point_hash(ray + 0x9e3779b9u * what);
}

/* The key of the camera's ray. */
POINT_FUNCTION point_root(POINT_UINT x, POINT_UINT y) {
    return point_hash(point_hash(x / POINT_SQUARE) + y / POINT_SQUARE);
}

/* Each bit changes depending on the bits below it. */
POINT_FUNCTION point_swap(POINT_UINT x, POINT_UINT seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= seed >> 16 | 1u;
    x ^= x * 0x05526c56u;
    return x ^ x * 0x53a22864u;
}

/* Spreads eight bits, with one free bit after each. */
POINT_FUNCTION point_apart(POINT_UINT x) {
    x = (x | x << 4) & 0x0f0fu;
    x = (x | x << 2) & 0x3333u;
    return (x | x << 1) & 0x5555u;
}

/* Where a pixel's sample has its place in the sequence of its square. `bits`: of the numbers of a pixel's
 * samples. */
POINT_FUNCTION point_place(POINT_UINT x, POINT_UINT y, POINT_UINT n, POINT_UINT bits) {
    POINT_UINT curve = point_apart(x % POINT_SQUARE) | point_apart(y % POINT_SQUARE) << 1;
    return curve << bits | (n & ((1u << bits) - 1u));
}

/* Samples beyond `bits` get sequences of their own. */
POINT_FUNCTION point_seed(POINT_UINT key, POINT_UINT n, POINT_UINT bits) {
    return key ^ point_hash(n >> bits);
}

/* The place after nested swaps, then the two coordinates, of which the upper 24 bits count. The second is
   Sobol's: the place as a polynomial over GF(2), with 1 + t for t. */
POINT_FUNCTION point_order(POINT_UINT place, POINT_UINT seed) {
    return POINT_REVERSE(point_swap(POINT_REVERSE(place), seed));
}
POINT_FUNCTION point_first(POINT_UINT order, POINT_UINT seed) {
    return POINT_REVERSE(point_swap(order, point_hash(seed ^ 0xa511e9b3u)));
}
POINT_FUNCTION point_second(POINT_UINT order, POINT_UINT seed) {
    order ^= order >> 16 & 0x0000ffffu;
    order ^= order >> 8 & 0x00ff00ffu;
    order ^= order >> 4 & 0x0f0f0f0fu;
    order ^= order >> 2 & 0x33333333u;
    order ^= order >> 1 & 0x55555555u;
    return POINT_REVERSE(point_swap(order, point_hash(seed ^ 0x63d83595u)));
}

#endif
