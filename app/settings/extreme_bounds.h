// The bounds of `glint extremes`, from a YAML file:
//
//     all:                                       # every axis
//       - {not_finite: 0}
//     move:                                      # an axis
//       - {from: 0, to: 1.0e+6, off: 0.0005}     # for values from .. to; metrics and the most they may be
//
// What is wrong is reported at its place, E805 and E806, and the rest counts. Ownership: the arena's. Thread
// safety: one call belongs to one thread.
#ifndef GLINT_APP_SETTINGS_EXTREME_BOUNDS_H
#define GLINT_APP_SETTINGS_EXTREME_BOUNDS_H

#include "core/limits.h"
#include "diag/diag.h"
#include "diag/source.h"
#include "measure/extremes/extremes.h"

struct extreme_bounds {
    struct extreme_bound *items;
    uint32_t count, capacity;
};

struct extreme_bounds_input {
    struct source_set *sources;
    struct arena *arena;
    struct diag_sink *sink;
    const struct limits *limits;
};

// Reads a source that is in the set. false: no memory.
bool extreme_bounds_read(const struct extreme_bounds_input *input, uint32_t source,
                         struct extreme_bounds *out);

#endif
