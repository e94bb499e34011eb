// The texture coordinates of a mesh, read only if one of its materials has an image: its format's reader
// walks over the file a second time, so meshes without images cost no time or memory for it.
//
// Input: the file of a mesh that was read. Output: mesh->coordinates and mesh->textured, in the mesh's arena.
// Units: those of the file; u to the right, v upwards, an image from 0 to 1. Errors: faults in coordinates
// and in the indices of faces that name them, at their place, and E604 for a file that has changed meanwhile;
// the mesh is then left without. Thread safety: as assets.h.
#ifndef GLINT_ASSETS_MESH_COORDINATES_H
#define GLINT_ASSETS_MESH_COORDINATES_H

#include "assets/file/asset_file.h"
#include "assets/mesh.h"

// Reads file->text. Both arenas must be guarded.
void mesh_read_coordinates(struct asset_file *file, struct arena *scratch, struct mesh *mesh);
// The same from faces that are at hand: those that the mesh was built of.
void mesh_assign_coordinates(const struct textured_faces *faces, struct arena *scratch, struct mesh *mesh);

#endif
