// From the polygons of a file to a mesh: triangles, merged positions, closedness, the outward side.
//
// Thread safety: one call belongs to one thread.
#ifndef GLINT_ASSETS_MESH_BUILD_H
#define GLINT_ASSETS_MESH_BUILD_H

#include "assets/mesh.h"
#include "assets/read_obj.h"

// The mesh of file->text, as the next function does; faults are reported and counted in file->errors. Its own
// memory and the scratch arena's together take no more than the cap, which is that of both.
void mesh_read(struct asset_file *file, struct arena *scratch, struct mesh *mesh);
// Fills a zeroed mesh whose arena is set up; everything that stays is there, `scratch` may be freed. Both
// arenas must be guarded.
void mesh_build(const struct obj *obj, str path, struct arena *scratch, struct mesh *mesh);

// The steps after triangulation, in this order (mesh_topology.c).
// mesh->merged, from the bits of the positions.
void mesh_merge_positions(struct mesh *mesh, struct arena *scratch);
// closed, open_edges and open_line: over merged positions, every directed edge as often as its opposite.
void mesh_find_edges(struct mesh *mesh, struct arena *scratch);
// volume, and a closed mesh of negative volume turned.
void mesh_turn_outward(struct mesh *mesh);

#endif
