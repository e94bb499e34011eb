// A glTF file, or a part of it, as polygons: what its nodes show, at the place they give it.
//
// file->part says what: nothing the whole default scene; the name of a mesh, or "mesh 3", that mesh in its
// own coordinates; "node 7" the mesh of that node where the file places it. Each material's faces are a
// group. Input: file->document, which must be set. Errors: reported by the document or the file, and counted
// in file->errors. Ownership: the scratch arena's, guarded like the document's. Thread safety: one thread.
#ifndef GLINT_ASSETS_GLTF_READ_GLTF_H
#define GLINT_ASSETS_GLTF_READ_GLTF_H

#include "assets/file/asset_file.h"
#include "assets/file/polygons.h"

void read_gltf(struct asset_file *file, struct arena *scratch, struct polygons *out);
// Reads the coordinates that the images of its materials use.
void read_gltf_coordinates(struct asset_file *file, struct arena *scratch, struct textured_faces *out);

#endif
