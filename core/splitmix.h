// Numbers that look random: SplitMix64 (Steele, Lea, Flood 2014, "Fast Splittable Pseudorandom Number
// Generators"). The same everywhere; not for secrets.
#ifndef GLINT_CORE_SPLITMIX_H
#define GLINT_CORE_SPLITMIX_H

#include <stdint.h>

#define SPLITMIX_STEP UINT64_C(0x9E3779B97F4A7C15)

// The number that follows the state `z` in the sequence. Pure: 64 random bits for each `z`.
static inline uint64_t splitmix(uint64_t z) {
    z += SPLITMIX_STEP;
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return z ^ z >> 31;
}

// The next number of a sequence. Any state is a seed.
static inline uint64_t splitmix_next(uint64_t *state) {
    const uint64_t bits = splitmix(*state);
    *state += SPLITMIX_STEP;
    return bits;
}

#endif
