// One run of assets_load: what its parts share (assets.c, materials.c).
#ifndef GLINT_ASSETS_LOADER_H
#define GLINT_ASSETS_LOADER_H

#include "assets/asset_file.h"
#include "assets/read_mtl.h"
#include "assets/store.h"
#include "core/str_map.h"

struct ir_model;
struct meshes_ahead;

// A mesh file that models of this scene name.
struct loaded_mesh {
    struct asset_file file;
    str name; // as the first model that names it does
    str canonical;
    const struct mesh *mesh; // NULL: it could not be loaded
    struct str_map groups;   // of the mesh: 1 + index; made when first needed
    bool normals_told;       // that some have no direction
    bool is_counted;         // its triangles are, among those of the scene
    bool is_unfit;           // they are among those that do not fit
    bool libraries_read;
    bool library_missing;         // so that what it would have defined is not reported as missing again
    struct str_map library_paths; // of the material files that were read: each is read once
    struct mtl_materials materials;
    uint32_t *group_material; // from the material files; IR_NO_INDEX: not asked for yet
    struct loaded_mesh *next;
};

enum {
    ASSET_TEXT_ROOM = 64,  // that an arena needs besides the text itself
    ASSET_TEXEL_BYTES = 16 // a device may get each pixel as four floats
};

struct loader {
    const struct assets_input *input;
    struct asset_hold *hold;
    struct meshes_ahead *ahead; // meshes that were read already; NULL: none
    struct loaded_mesh *meshes;
    struct {
        struct ir_material *items;
        uint32_t count, capacity;
    } materials;
    struct {
        uint32_t models;
        uint64_t triangles; // of all of them
        span first;
        uint32_t first_mesh; // triangles of the first one's mesh
        uint64_t first_sum;  // triangles of the scene with it
    } unfit;                 // models with which the scene would have more triangles than the limit
};

// The material of each group of the model's mesh: material_map, else material, else the material file's,
// else the default.
uint32_t *loader_group_materials(struct loader *loader, const struct ir_model *model,
                                 struct loaded_mesh *loaded);

#endif
