// Internal to precision.h: what precision.c, precision_gaps.c and precision_least.c share.
#ifndef GLINT_TRACER_FLATTEN_PRECISION_INTERNAL_H
#define GLINT_TRACER_FLATTEN_PRECISION_INTERNAL_H

#include "tracer/flatten/precision.h"

#include <math.h>

struct precision_body {
    vec3 lower, upper; // box, scene units minus the origin
    double reach;      // largest |coordinate| of it
    uint32_t body;     // in IR order
};

// Below this a gap or height does not count: bodies that touch in the file are separated by the rounding of
// the scene's coordinates and of `distance`, which is relative to the origin.
static inline double precision_contact(const struct flat_input *input, double distance) {
    return fmax(0x1p-40 * distance, 0x1p-50 * (vec3_max_abs(input->origin) + distance));
}

// Keeps the smaller; ties are broken by body and triangle, so that the result does not depend on threads.
void precision_keep(struct precision_measure *least, const struct precision_measure *found);
// Computes steps from the other fields, and keeps the measure.
void precision_note(struct precision_measure *least, struct precision_measure found);

// Gaps between the bodies. false: no memory.
bool precision_gaps(const struct flat_input *input, const struct precision_body *bodies, uint32_t count,
                    struct precision_report *out);

// ---- precision_pieces.c: a mesh that several bodies show is measured once, roughly, so that most of its
// triangles need not be looked at again in every body.

enum {
    PRECISION_PIECE = 64 // triangles
};

// Measures of some triangles of a mesh, in its space.
struct precision_piece {
    vec3 lower, upper;
    double shortest, longest; // of their edges; triangles with an edge of length 0 do not count
};

struct precision_pieces {
    const struct mesh *mesh;
    struct precision_piece *items; // of PRECISION_PIECE triangles each, the last of fewer
    uint32_t count;
    struct precision_piece whole;
};

// How a body shows a mesh, with room for rounding.
struct precision_view {
    affine3 map;        // relative to the origin
    double least, most; // by which lengths are multiplied
    double slack;       // of coordinates
    vec3 camera;        // relative to the origin
};

// false: no memory.
bool precision_pieces_make(const struct mesh *mesh, struct precision_pieces *out);
void precision_pieces_finish(struct precision_pieces *pieces);
struct precision_view precision_view_of(const struct flat_input *input, const affine3 *map,
                                        const struct mesh *mesh);
// Whether no triangle of the piece can have a shorter edge, or a lower height below the camera, than what was
// found.
bool precision_is_beyond(const struct precision_view *view, const struct precision_piece *piece,
                         const struct precision_report *found);

#endif
