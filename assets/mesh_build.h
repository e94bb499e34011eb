// From the polygons of a file to a mesh: triangles, merged positions, closedness, the outward side.
//
// Thread safety: one call belongs to one thread.
#ifndef GLINT_ASSETS_MESH_BUILD_H
#define GLINT_ASSETS_MESH_BUILD_H

#include "assets/file/asset_file.h"
#include "assets/mesh.h"

// Builds the mesh of file->text, as the next function does; faults are reported and counted in file->errors.
// The cap applies to its own memory and the scratch arena's together.
void mesh_read(struct asset_file *file, struct arena *scratch, struct mesh *mesh);
// Fills a zeroed mesh whose arena is set up; everything that stays is there, `scratch` may be freed. Both
// arenas must be guarded. `polygons` is used up: its vertices become the mesh's positions, if all of them are
// used, and its corners and faces are overwritten.
void mesh_build(struct polygons *polygons, str path, struct arena *scratch, struct mesh *mesh);

// Memory for the steps after triangulation. Memory touched before is used first: a new page costs more than
// the work done in it.
struct mesh_room {
    struct {
        char *at;
        size_t left;
    } used[2];
    struct arena *scratch;
};

// The steps after triangulation, in this order (mesh_topology.c).
// mesh->merged, from the bits of the positions.
void mesh_merge_positions(struct mesh *mesh, struct mesh_room *room);
// closed, open_edges and open_line: over merged positions, every directed edge as often as its opposite.
void mesh_find_edges(struct mesh *mesh, struct mesh_room *room);
// volume, and a closed mesh of negative volume turned.
void mesh_turn_outward(struct mesh *mesh);

#endif
