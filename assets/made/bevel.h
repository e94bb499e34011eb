// The sides of a region moved inward by one distance, their corners mitred.
//
// Output: a region whose point i is the corner at the end of side i, and whose edge i is side i. Ownership:
// the arena's. Thread safety: pure.
#ifndef GLINT_ASSETS_MADE_BEVEL_H
#define GLINT_ASSETS_MADE_BEVEL_H

#include "assets/made/region.h"

// false: a side vanishes or two cross; `inset` must not be used then.
bool bevel_make(const struct region *region, double distance, struct region *inset);
// The largest distance up to `most` that fits, found by halving; a little less than the true one.
double bevel_largest(const struct region *region, double most);

#endif
