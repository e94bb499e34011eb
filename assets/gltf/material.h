// glTF's materials in the words of the scene language: metal and roughness, glass, emission.
//
// Base colour becomes the diffuse colour, or an image; metal becomes a mirror, more diffuse the duller it is,
// since mirrors have no colour; roughness the size of highlights; transmission refraction, with Fresnel's
// shares and the volume's colour where the body has a thickness. docs/gltf.md has the table. Anything without
// a counterpart is counted as a loss.
//
// Ownership: names and images belong to the document. Thread safety: one thread.
#ifndef GLINT_ASSETS_GLTF_MATERIAL_H
#define GLINT_ASSETS_GLTF_MATERIAL_H

#include "assets/gltf/gltf.h"

struct ir_material;

// How a material is written.
struct gltf_wording {
    bool is_linear; // the scene's numbers are linear light ('transfer: srgb'), as glTF's are
    double metal,
        roughness; // the means of the texture that multiplies the two numbers; 1 where there is none
};

// The images of a material; GLTF_NONE: none, or one that glint does not use.
struct gltf_images {
    uint32_t base;
    uint32_t metal; // roughness in its green channel, metal in its blue
};
struct gltf_images gltf_material_images(const struct gltf *gltf, uint32_t material);

// Fills an initialized material with all rows that differ from the default; `file` of its image is left to
// the caller.
void gltf_to_material(struct gltf *gltf, uint32_t material, struct gltf_wording wording,
                      struct ir_material *out);

// The name for a mesh's faces with this material: the material's own name if no other has it.
str gltf_material_name(const struct gltf *gltf, uint32_t material);

#endif
