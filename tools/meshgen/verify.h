// Proofs that a mesh is fit to be refracting glass: closed, outward, nothing degenerate.
#ifndef GLINT_MESHGEN_VERIFY_H
#define GLINT_MESHGEN_VERIFY_H

#include "tools/meshgen/mesh.h"

struct verify_result {
    int parts;          // pieces that share no position
    int open_edges;     // directed edges that occur more or less often than their opposite
    int inward_parts;   // pieces of negative or zero signed volume
    int flat_triangles; // triangles of (nearly) no area
    int bent_faces;     // polygons that are not planar, not convex, or folded
    int bad_normals;    // corners whose normal looks into the mesh
    double volume;      // signed, of all parts
};

// Vertices at equal positions count as one, as they do for glint. false: out of memory.
bool verify_mesh(const struct mesh *mesh, struct verify_result *result);

// True where nothing is wrong.
bool verify_passed(const struct verify_result *result);

#endif
