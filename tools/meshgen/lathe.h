// Bodies turned on a lathe: half of a section, swept about the y axis.
//
// A section goes from the middle of the bottom, up the outside, to the middle of the top; where it then comes
// back down it makes the inside of a vessel. Its first and its last point lie on the axis. Thread safety: as
// the mesh.
#ifndef GLINT_MESHGEN_LATHE_H
#define GLINT_MESHGEN_LATHE_H

#include "tools/meshgen/mesh.h"

struct lathe_point {
    double radius, y;
};

// A ring of `sides` corners for each point, but one vertex on the axis.
void lathe_turn(struct mesh *mesh, const struct lathe_point *section, int count, int sides);

// The same along a curve through the points (Catmull and Rom 1974), with `steps` parts from each to the next.
void lathe_turn_curve(struct mesh *mesh, const struct lathe_point *section, int count, int steps, int sides);

#endif
