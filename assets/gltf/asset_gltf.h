// A glTF file that is open, as an asset: its buffers and images are found beside it, and its faults are
// reported at their place, with notes up to the scene that names it.
//
// One document serves all models that show parts of the file. Errors: diagnostics, and document->file.errors;
// a document with errors shows nothing. Ownership: on the heap, freed by gltf_documents_finish; the results
// of its functions live as long. Thread safety: one thread.
#ifndef GLINT_ASSETS_GLTF_ASSET_GLTF_H
#define GLINT_ASSETS_GLTF_ASSET_GLTF_H

#include "assets/file/asset_file.h"
#include "assets/gltf/gltf.h"
#include "core/str_map.h"

struct ir_material;

struct gltf_means {
    bool is_known;
    double metal, roughness;
};

struct gltf_document {
    struct gltf_document *next;
    struct arena arena;
    struct asset_file file; // its text is the JSON, also of a GLB file
    struct file_read identity;
    struct gltf gltf;
    struct gltf_report report;
    struct str_map material_numbers; // by name: 1 + the first that has it; made when first needed
    bool buffers_read;
    struct gltf_means *means; // of images that say metal and roughness
};

// Reads the JSON of a file that was found. NULL: no memory, which was reported. It may have errors.
struct gltf_document *gltf_document_open(const struct asset_file *file, const struct file_read *identity);
void gltf_documents_finish(struct gltf_document *first);
// Loads the buffers, once; false: the document has errors.
bool gltf_document_buffers(struct gltf_document *document);
// Runs work that allocates from the document's arena, and from `others` (NULL at the end, two at most); lack
// of memory is reported.
void gltf_document_guarded(struct gltf_document *document, struct arena *const *others, arena_work *work,
                           void *context);

// The bytes of an image inside the file or beside it. `file` gets its path and identity.
bool gltf_document_image(struct gltf_document *document, uint32_t image, struct asset_file *file,
                         struct file_read *identity);
// Whether an image is inside of the file, or in its buffers.
bool gltf_document_holds(const struct gltf_document *document, uint32_t image);
// The material, with the means of its textures; is_linear: as struct gltf_wording. false: the document has
// errors.
bool gltf_document_material(struct gltf_document *document, uint32_t material, bool is_linear,
                            struct ir_material *out);

#endif
