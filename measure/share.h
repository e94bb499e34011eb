// What a sample of a picture's pixels tells about the share among all of them: the bounds of Clopper and
// Pearson (1934).
//
// Errors: none. Thread safety: pure.
#ifndef GLINT_MEASURE_SHARE_H
#define GLINT_MEASURE_SHARE_H

#include <stdint.h>

// The least share such that `off` or fewer of `pixels` occur with a probability of at most `risk`, and the
// greatest such that `off` or more do. `pixels` is at least 1.
double share_bound(uint32_t off, uint32_t pixels, double risk);
double share_floor(uint32_t off, uint32_t pixels, double risk);

#endif
