// One run of assets_load: what its parts share (assets.c, materials.c).
#ifndef GLINT_ASSETS_LOADER_H
#define GLINT_ASSETS_LOADER_H

#include "assets/file/asset_file.h"
#include "assets/obj/read_mtl.h"
#include "assets/store.h"
#include "core/str_map.h"

struct ir_mesh;
struct ir_model;
struct meshes_ahead;

// A mesh that models of this scene show: that of a file, or one that the scene describes.
struct loaded_mesh {
    const struct ir_mesh *made; // what the scene describes; NULL: the mesh of a file
    struct asset_file file;
    str name, part;      // as the first model that names it writes it
    uint64_t size_bytes; // of the file
    str canonical;
    const struct mesh *mesh; // NULL: it could not be loaded
    struct str_map groups;   // of the mesh: 1 + index; made when first needed
    bool part_told;          // reported that a model asks for a part of it
    bool normals_told;       // reported that some normals have no direction
    bool coordinates_read;   // coordinates were read, or found to be unreadable
    struct mesh *own;        // the same mesh, to be completed
    bool is_counted;         // its triangles are counted among those of the scene
    bool is_unfit;           // they are among those that do not fit
    bool libraries_read;
    bool library_missing; // so that the materials it would have defined are not reported as missing too
    struct str_map library_paths; // paths of the material files read so far: each is read once
    struct mtl_materials materials;
    uint32_t *group_material; // from the material files; IR_NO_INDEX: not asked for yet
    struct shared_materials {
        uint32_t *groups; // of the last model without a map; NULL: none yet
        uint32_t material;
    } shared[2]; // with the materials of the mesh, and with a material of the model's
    const uint32_t *no_refraction, *no_image; // lists of materials that were found to have none of these
    struct loaded_mesh *next;
};

// An image file that materials name.
struct loaded_image {
    struct asset_file file;
    str canonical;
    str held;                      // its bytes in a glTF document; empty: it has a file of its own
    const struct picture *picture; // NULL: it could not be loaded
    struct loaded_image *next;
};

// Where a material comes from: the scene, or a line of a material file.
struct material_source {
    struct asset_file *file;        // NULL: the scene, or a glTF file
    uint32_t line;                  // of its image
    uint32_t kd_line;               // 0: it has no Kd
    struct gltf_document *document; // NULL: of another kind
    uint32_t image;                 // of the document
};

enum {
    ASSET_TEXT_ROOM = 64, // bytes that an arena needs besides the text itself
};

// An image that the scene shows: its use, and the memory it may take.
struct image_role {
    bool is_background;  // else a surface has it, with smaller levels
    uint64_t file_bytes; // bytes of its file not already counted for another image
};

struct loader {
    const struct assets_input *input;
    struct asset_hold *hold;
    struct meshes_ahead *ahead; // meshes that were read already; NULL: none
    enum assets_pixels pixels;
    struct loaded_mesh *meshes;
    struct loaded_mesh **made; // of the scene's meshes, by index; NULL: none yet
    struct loaded_image *images;
    struct {
        struct ir_material *items;
        uint32_t count, capacity;
    } materials;
    struct {
        struct material_source *items;
        uint32_t count, capacity;
    } sources; // one for each of them
    struct {
        uint64_t bytes, file_bytes;
    } held; // memory of the images so far, and their files
    struct {
        uint32_t count;
        struct asset_file *first;
        str name;
        uint64_t first_sum, first_file_bytes; // with the first one
        uint64_t bytes;                       // of all of them
    } unfit_images;                           // images with which the scene's would exceed image-growth
    struct {
        uint32_t models;
        uint64_t triangles; // of all of them
        span first;
        uint32_t first_mesh; // triangles of the first one's mesh
        uint64_t first_sum;  // triangles of the scene with it
    } unfit;                 // models with which the scene would exceed the triangle limit
};

// A place for one more material.
struct ir_material *loader_add_material(struct loader *loader, struct material_source source);
// The entry of an image that was found under its name, read unless it was read before; NULL: no memory.
// Everything wrong with it is reported except faults of the decoder.
struct store_entry *loader_read_image(struct loader *loader, struct asset_file *file, str name,
                                      const struct file_read *identity, struct image_role role);
// The two halves of that: finding the entry, or a new one, with at least as much known as requested; and
// reading it.
struct store_entry *loader_find_image(struct loader *loader, const struct file_read *identity);
void loader_complete_image(struct loader *loader, struct asset_file *file, str name,
                           struct store_entry *entry, struct image_role role);
// Whether its memory, which is added to that of the scene's images, is within the limits. Images with which a
// scene's take too much are reported by the second, all at once.
void loader_report_unfit_images(struct loader *loader);
bool loader_image_fits(struct loader *loader, struct asset_file *file, str name,
                       const struct store_entry *entry, struct image_role role);
// The most memory that a picture takes while a scene that shows it is rendered on a processor, whose device's
// memory counts too: pixels, texels, and its decoder's needs. UINT64_MAX: beyond all.
uint64_t loader_image_memory(const struct assets_input *input, const struct picture *picture,
                             uint64_t decoder_bytes, bool is_background);
// Checks what is known of the picture once its pixels are; NULL: it cannot be used. `is_solid`: whoever names
// it says that its alpha means nothing; false: that it counts.
const struct picture *loader_judge_image(struct asset_file *file, struct store_entry *entry, bool is_solid);
// textures.c: whether the image of a material file's material is used; the images of all materials; and the
// coordinates of a model's mesh where one of its materials has one.
void loader_settle_image(struct loader *loader, uint32_t material);
void loader_load_textures(struct loader *loader, struct assets *out);
void loader_load_coordinates(struct loader *loader, const struct assets_model *model,
                             struct loaded_mesh *loaded);

// made_assets.c: whether the model names a file, not a mesh that the scene describes.
bool loader_names_file(const struct ir_model *model);
// The mesh scene.meshes[index], made when it is first asked for; one that cannot be made is
// reported once.
struct loaded_mesh *loader_made_mesh(struct loader *loader, uint32_t index);

// gltf_assets.c: the document of a mesh that is a glTF file, opened when the first model names it; its losses
// are reported at the end. The material of a group of its mesh; false: it has none.
bool loader_open_document(struct loader *loader, struct asset_file *file, const struct file_read *identity);
void loader_close_documents(struct loader *loader);
bool loader_document_material(const struct loader *loader, struct loaded_mesh *loaded, str group,
                              struct ir_material *material, struct material_source *source);
// The material of each group of the model's mesh: material_map, else material, else the material file's,
// else the default.
uint32_t *loader_group_materials(struct loader *loader, const struct ir_model *model,
                                 struct loaded_mesh *loaded);

#endif
