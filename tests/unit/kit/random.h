// Random numbers that are the same in every run. Any state is a seed.
#ifndef GLINT_TESTS_UNIT_RANDOM_H
#define GLINT_TESTS_UNIT_RANDOM_H

#include "core/splitmix.h"
#include "core/vec3.h"

#include <stdint.h>

static inline uint64_t random_bits(uint64_t *state) {
    return splitmix_next(state);
}

// From 0 to below 1.
static inline double random_unit(uint64_t *state) {
    return (double)(random_bits(state) >> 11) * 0x1p-53;
}

// On the unit sphere.
static inline vec3 random_direction(uint64_t *state) {
    double z = 2 * random_unit(state) - 1;
    double angle = 6.283185307179586 * random_unit(state);
    double r = sqrt(1 - z * z);
    return (vec3){r * cos(angle), r * sin(angle), z};
}

#endif
