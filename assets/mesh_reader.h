// The functions that read each mesh format, as named by grammar/mesh_formats.def.
//
// Thread safety: constant data.
#ifndef GLINT_ASSETS_MESH_READER_H
#define GLINT_ASSETS_MESH_READER_H

#include "assets/file/asset_file.h"
#include "assets/file/polygons.h"

struct mesh_reader {
    // Reads file->text into polygons, which are in the scratch arena. Faults are reported and counted in
    // file->errors; after one the result must not be used.
    void (*polygons)(struct asset_file *file, struct arena *scratch, struct polygons *out);
    // Reads it again for texture coordinates; NULL: the format has none.
    void (*coordinates)(struct asset_file *file, struct arena *scratch, struct textured_faces *out);
};

// Chosen by the ending of the path, which must be that of a mesh file.
const struct mesh_reader *mesh_reader_of(str path);

#endif
