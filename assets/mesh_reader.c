#include "assets/mesh_reader.h"

#include "assets/gltf/read_gltf.h"
#include "assets/obj/read_obj.h"
#include "assets/ply/read_ply.h"
#include "assets/stl/read_stl.h"
#include "grammar/mesh_format.h"

#include <assert.h>

static const struct mesh_reader readers[MESH_FORMAT_COUNT] = {
#define ITEMS(...)                    __VA_ARGS__
#define MESH_FORMAT(id, readers, ...) [MESH_FORMAT_##id] = {ITEMS readers},
#include "grammar/mesh_formats.def"
#undef MESH_FORMAT
};

const struct mesh_reader *mesh_reader_of(str path) {
    const enum mesh_format_id id = mesh_format_of_path(path);
    assert(id != MESH_FORMAT_COUNT);
    return &readers[id];
}
