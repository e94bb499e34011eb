// What the mutants of tests/mutation/run.sh put around a value: as a float would hold it. Of another type
// than these it does not compile, and the mutant does not count.
#ifndef GLINT_TESTS_MUTATION_ROUNDED_H
#define GLINT_TESTS_MUTATION_ROUNDED_H

#include "core/vec3.h"

static inline double mutant_double(double value) {
    return (double)(float)value;
}
static inline vec3 mutant_vec3(vec3 v) {
    return (vec3){mutant_double(v.x), mutant_double(v.y), mutant_double(v.z)};
}
static inline mat3 mutant_mat3(mat3 m) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m.m[i][j] = mutant_double(m.m[i][j]);
    return m;
}
#define MUTANT_FLOAT(value)                                                                                  \
    (_Generic((value), double : mutant_double, vec3 : mutant_vec3, mat3 : mutant_mat3)(value))

#endif
