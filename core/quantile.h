// Medians and other quantiles of measured numbers.
//
// Ownership: the caller's arrays. Thread safety: pure.
#ifndef GLINT_CORE_QUANTILE_H
#define GLINT_CORE_QUANTILE_H

#include <stddef.h>

// Sorts in place, ascending; NaN comes last.
void quantile_sort(double *values, size_t count);
// Of sorted values, with linear interpolation: 0 is the least, 1 the largest, 0.5 the median. `count` is
// at least 1.
double quantile(const double *sorted, size_t count, double share);

#endif
