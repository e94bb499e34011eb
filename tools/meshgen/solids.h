// Building blocks of low-polygon figures: lofts through rings, and small convex lumps.
//
// Every block is a closed part of its own and comes out with its faces outward, whatever the order or
// the handedness of the frame that it was given. Thread safety: as the mesh.
#ifndef GLINT_MESHGEN_SOLIDS_H
#define GLINT_MESHGEN_SOLIDS_H

#include "tools/meshgen/mesh.h"

// A ring of corners about `centre`: corner k lies at cos(angle) * u + sin(angle) * v, the first at
// angle_deg. A ring of zero axes is a point and closes the loft there.
struct solids_ring {
    vec3 centre, u, v;
    const char *material; // of the faces between this ring and the next
    const char *second;   // of those faces whose middle has a negative v part; NULL: `material`
};

// Rings of `sides` corners joined by triangles, with flat lids where an end is not a point.
void solids_loft(struct mesh *mesh, const struct solids_ring *rings, int ring_count, int sides,
                 double angle_deg);

// An octahedron with half axes x, y, z.
void solids_octahedron(struct mesh *mesh, vec3 centre, vec3 half_axes);

#endif
