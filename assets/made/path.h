// Profiles and outlines as chains of straight pieces, with the directions of the true curve at both ends of
// each.
//
// Input: points as the scene has them. Output: struct path. Curves are cut by the second difference of their
// control points, so that no piece is farther from its curve than `tolerance` (Wang 1984; Sederberg 2005,
// "Computer Aided Geometric Design", 10.6). Units: those of the points; `tolerance` as well. Errors: struct
// made_fault. Ownership: the arena's. Thread safety: pure.
#ifndef GLINT_ASSETS_MADE_PATH_H
#define GLINT_ASSETS_MADE_PATH_H

#include "assets/made/made.h"
#include "assets/made/plane.h"

struct path_piece {
    struct ir_pair from, to;
    struct ir_pair along_from, along_to; // directions of the curve there, of length 1
    double length_before, length_after;  // of the path, up to the piece's ends
    uint32_t source;                     // the point that the curve's piece begins at
};

struct path {
    struct path_piece *pieces;
    uint32_t count, capacity;
    double length;
    uint32_t knot_count; // different points, as far as neighbours go
};

struct path_curve {
    const struct ir_pair *points;
    uint32_t count;
    bool smooth;
    bool is_closed;   // the last point joins the first, or repeats it
    bool is_mirrored; // a curve crosses the line u = 0 at right angles, if it has a point there
    double tolerance;
};

// The pieces of a path; none if it has fewer than two different points. false: more than MADE_POINTS_MOST.
bool path_make(const struct path_curve *curve, struct arena *arena, struct path *out);
// Adds the pieces of a cubic Bézier curve; all have the source. false: as above.
bool path_add_cubic(struct path *path, struct arena *arena, const struct ir_pair control[4], double tolerance,
                    uint32_t source);
// Adds a straight piece, unless its ends are the same.
bool path_add_line(struct path *path, struct arena *arena, struct ir_pair from, struct ir_pair to,
                   uint32_t source);

// Whether all numbers are finite and at most MESH_COORDINATE_MAX; if not, the fault names the first that is
// not.
bool path_check_numbers(const struct ir_pair *points, uint32_t count, struct made_fault *fault);

#endif
