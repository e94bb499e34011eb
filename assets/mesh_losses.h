// Contents of a mesh file that no picture shows, reported as warnings, one per kind and file.
//
// Input: a mesh that was read, now or for an earlier scene. Output: diagnostics in the file's sink. Thread
// safety: that of the sink.
#ifndef GLINT_ASSETS_MESH_LOSSES_H
#define GLINT_ASSETS_MESH_LOSSES_H

#include "assets/file/asset_file.h"
#include "assets/mesh.h"

void mesh_losses_report(struct asset_file *file, const struct mesh *mesh);
// The code for a mesh whose faces are not all flat.
diag_code mesh_losses_bend(const struct mesh *mesh);
// For a mesh that a smooth model shows: its normals without a direction.
void mesh_losses_report_normals(struct asset_file *file, const struct mesh *mesh);

#endif
