// What the files in this folder share.
//
// Thread safety: as gltf.h.
#ifndef GLINT_ASSETS_GLTF_INTERNAL_H
#define GLINT_ASSETS_GLTF_INTERNAL_H

#include "assets/gltf/fields.h"

// The JSON of a GLB file, and gltf->chunk. false: the fault was reported.
bool gltf_take_chunks(struct gltf *gltf, str bytes, str *text);

// Each fills its lists from the root of the JSON, in this order; faults are reported.
void gltf_read_buffers(struct gltf *gltf); // buffers, views, accessors
void gltf_read_images(struct gltf *gltf);  // images, samplers, textures
void gltf_read_materials(struct gltf *gltf);
void gltf_read_meshes(struct gltf *gltf);
void gltf_read_cameras(struct gltf *gltf); // and lights
void gltf_read_nodes(struct gltf *gltf);   // and the default scene
// Bytes of a component.
uint32_t gltf_component_bytes(unsigned component);
// Bytes of an element, including the padding of matrix columns.
uint32_t gltf_element_bytes(const struct gltf_accessor *accessor);
// Bytes from one element to the next.
uint32_t gltf_stride(const struct gltf *gltf, const struct gltf_accessor *accessor);

#endif
