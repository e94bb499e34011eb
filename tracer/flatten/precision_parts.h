// Inside of precision.h: what precision.c, precision_gaps.c and precision_least.c share.
#ifndef GLINT_TRACER_FLATTEN_PRECISION_PARTS_H
#define GLINT_TRACER_FLATTEN_PRECISION_PARTS_H

#include "tracer/flatten/precision.h"

#include <math.h>

struct precision_body {
    vec3 lower, upper; // box, scene units minus the origin
    double reach;      // largest |coordinate| of it
    uint32_t body;     // in IR order
};

// Below this a gap or height does not count: what touches in the file is separated by the rounding of
// numbers, of those of the scene's coordinates and of `distance`, which is relative to the origin.
static inline double precision_contact(const struct flat_input *input, double distance) {
    return fmax(0x1p-40 * distance, 0x1p-50 * (vec3_max_abs(input->origin) + distance));
}

// Keeps the lesser; equal ones by body and triangle, so that the result knows nothing of threads.
void precision_keep(struct precision_measure *least, const struct precision_measure *found);
// Fills steps from the rest, and keeps.
void precision_note(struct precision_measure *least, struct precision_measure found);

// Gaps between the bodies. false: no memory.
bool precision_gaps(const struct flat_input *input, const struct precision_body *bodies, uint32_t count,
                    struct precision_report *out);

#endif
