// A flat shape made solid: flat front and back, straight sides, rounded edges, normals to match.
#ifndef GLINT_MESHGEN_EXTRUDE_H
#define GLINT_MESHGEN_EXTRUDE_H

#include "tools/meshgen/mesh.h"
#include "tools/meshgen/outline.h"

struct extrude_profile {
    double half_depth;  // the solid reaches from -half_depth to half_depth along z
    double edge_radius; // of the quarter round between side and face; less than any inner radius of the shape
};

// Moves the shape by shift_x. Sides are smooth where the outline turns by less than 30 degrees and sharp
// elsewhere. A shape that cannot be cut into triangles sets mesh->failed.
void extrude_outline(struct mesh *mesh, const struct outline *outline, double shift_x,
                     const struct extrude_profile *profile);

#endif
