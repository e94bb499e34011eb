// The bounds of `glint extremes`, from a YAML file:
//
//     all:                                       # every axis
//       - {not_finite: 0}
//     move:                                      # an axis
//       - {from: 0, to: 1.0e+6, off: 0.0005}     # for values from .. to; metrics and the most they may be
//
// Mistakes are reported at their place, as E805 and E806, and the rest is used. Ownership: the arena's.
// Thread safety: one call belongs to one thread.
#ifndef GLINT_LOAD_SETTINGS_EXTREME_BOUNDS_H
#define GLINT_LOAD_SETTINGS_EXTREME_BOUNDS_H

#include "measure/extremes/extremes.h"
#include "parser/tree/reader.h"

struct extreme_bounds {
    struct extreme_bound *items;
    uint32_t count, capacity;
};

// Reads a source that is in the set. false: no memory.
bool extreme_bounds_read(const struct reader_context *input, uint32_t source, struct extreme_bounds *out);

#endif
