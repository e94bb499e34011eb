// Everything a scene reads besides its text: meshes and the background image, and what they add to the
// materials. A fault inside a file is placed in that file with "named here" in the scene; a file that is
// missing, refused or of an unsupported kind is reported where the scene names it.
//
// The store keeps meshes and images with reference counts, keyed by path, size and time, so they outlive a
// reload. Ownership: assets hold references into the store; assets_finish releases them. Thread safety: one
// thread loads; loaded assets are immutable.
#ifndef GLINT_ASSETS_ASSETS_H
#define GLINT_ASSETS_ASSETS_H

#include "assets/file/asset_input.h"
#include "assets/mesh.h"
#include "core/limits.h"
#include "diag/diag.h"
#include "files/files.h"
#include "grammar/ir_origin.h"
#include "picture/read/picture.h"

struct ir_material;
struct ir_reference;
struct ir_scene;

struct asset_ahead;
struct meshes_ahead;
struct asset_store;
struct asset_hold;
struct timeline;

struct asset_store *asset_store_create(void); // NULL: no memory
// How many files were read for a store and found to be whole since it was created; files that it already had
// do not count.
struct asset_reads {
    uint32_t meshes, images;
};
struct asset_reads asset_store_reads(const struct asset_store *store);
// All assets that were loaded with the store must be finished before.
void asset_store_destroy(struct asset_store *store);

struct assets_model {
    const struct mesh *mesh;  // NULL if it could not be loaded (a diagnostic says why)
    uint32_t *group_material; // per mesh group: index into assets.materials
};

enum assets_image {
    ASSETS_DIFFUSE,
    ASSETS_SPECULAR,
    ASSETS_IMAGES
};

struct assets {
    struct asset_hold *hold;        // the references into the store
    const struct ir_origin *origin; // of the scene, for places in later messages
    // All materials that bodies can have: those of the scene in its order, then the default material
    // (index scene.materials.count), then those that material files of meshes add.
    struct ir_material *materials;
    uint32_t material_count;
    struct assets_model *models; // one per scene model
    uint32_t model_count;
    const struct picture *background; // NULL: none, or not loaded; without pixels unless they are kept
    // By material: the images of its diffuse and its specular colour, kept like the background; NULL: no
    // material has one.
    const struct picture *(*images)[ASSETS_IMAGES];
    bool pixels_skipped; // it has an image of which only the header was ever read
    bool pixels_later;   // its pixels are still being decoded: assets_settle
    struct asset_ahead *ahead;
    struct meshes_ahead *meshes_ahead; // while they are loaded
    uint64_t triangle_count;           // of all models
    uint64_t held_triangles;           // the same, counting each mesh once
    struct asset_uses uses;            // in the order of loading; text is in the arena of the scene
};

// What to do with the pixels of an image.
enum assets_pixels {
    ASSETS_KEEP_PIXELS,
    ASSETS_CHECK_PIXELS, // they are decoded, so that every fault is found, and dropped
    ASSETS_SKIP_PIXELS,  // only the header is read
};

// Loads everything; continues after a fault. The limits are the same whatever is done with pixels. When
// memory runs out, it jumps to the guards of input->arena and of the arenas of sources and files;
// assets_finish(out) then still releases everything taken.
void assets_load(struct asset_store *store, const struct assets_input *input, enum assets_pixels pixels,
                 struct assets *out);
// Waits for pixels that are still being decoded, and reports their faults. It needs the guards of
// assets_load. Does nothing if none are being decoded.
void assets_settle(struct assets *assets);
// Accepts zeroed, half-loaded and finished assets.
void assets_finish(struct assets *assets);
// The index in assets.materials of a body's reference.
uint32_t assets_material(const struct ir_scene *scene, const struct ir_reference *ref);
// Whether `path` has the ending of a mesh file that is read (grammar/mesh_format.h).
bool assets_is_mesh_path(str path);

#endif
