// Any bytes as a mesh that a scene shows: what fuzz_obj.c, fuzz_ply.c, fuzz_stl.c and fuzz_gltf.c share.
#ifndef GLINT_TESTS_FUZZ_MESH_H
#define GLINT_TESTS_FUZZ_MESH_H

#include "core/str.h"

// Loads `mesh` as the file `path`, and /own.mtl beside it; ends the program where a promise is broken.
void fuzz_mesh(const char *path, str mesh, str materials);

#endif
