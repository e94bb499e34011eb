// PLY, ascii and binary of both orders: text or bytes to polygons, as the file has them.
//
// Read: from `vertex`, x y z, normals (nx ny nz) and texture coordinates (u v, s t, texture_u texture_v);
// from `face`, its list vertex_indices (or vertex_index) and its own texture coordinates (texcoord); from
// `tristrips`, its strips, which end with -1. Values have any type; other elements and properties are passed
// over. Counted as losses: colours of vertices, edges, bytes after the last element. A normal that is not
// finite counts as one of length 0. Errors: every fault, at its line, or at its byte in a binary file;
// counted in file->errors, after which the result must not be used. Ownership: all is in the scratch arena.
// Thread safety: one call belongs to one thread; it reads on all processors, with the same result.
#ifndef GLINT_ASSETS_PLY_READ_PLY_H
#define GLINT_ASSETS_PLY_READ_PLY_H

#include "assets/file/asset_file.h"
#include "assets/file/polygons.h"

void read_ply(struct asset_file *file, struct arena *scratch, struct polygons *out);
// Reads it again for texture coordinates: those of vertices or, if faces have their own, of faces.
void read_ply_coordinates(struct asset_file *file, struct arena *scratch, struct textured_faces *out);

#endif
