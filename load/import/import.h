// A glTF file as a scene of the language: models for its nodes, cameras, lights and, where they are asked
// for, materials with their images.
//
// Each node that shows a mesh becomes one model. Nodes with the same mesh are models of the same part of the
// file, which glint keeps once. What occurs again is an object (repeated.h). If a node's matrix is not a
// scale, rotation and translation, its model is in an instance with this matrix; one that is pressed flat
// refers to the node as the file places it. docs/gltf.md says what becomes of what.
//
// Input: an open document without errors. Output: a scene whose rows are marked as written, for
// grammar/print/. What has no counterpart is counted in the document's losses. Ownership: the arena's, which
// must be guarded as the document's is. Units: lights of the language have no unit; candela and lux are
// divided by pi, as a white surface does. Thread safety: one thread.
#ifndef GLINT_LOAD_IMPORT_IMPORT_H
#define GLINT_LOAD_IMPORT_IMPORT_H

#include "assets/gltf/asset_gltf.h"

struct ir_scene;

// What a file lacks is taken from the scene around a single mesh (load/around/).
enum import_lack {
    IMPORT_LACKS_CAMERA = 1,
    IMPORT_LACKS_LIGHT = 2,
};

struct import_options {
    const struct ir_scene *around; // NULL: nothing is taken
    str mesh;                      // the file, as the scene is to name it
    const str
        *images; // by image of the file, as the scene is to name it; NULL: materials are left in the file
};

// Opens the file at a path; errors go to the input's sink. NULL: it cannot be read, or no memory.
struct gltf_document *import_open(const struct assets_input *input, str path);
unsigned import_lacks(const struct gltf_document *document);
void import_gltf(struct gltf_document *document, const struct import_options *options, struct arena *arena,
                 struct ir_scene *out);
// Which images the materials of the scene show: a flag for each image of the file.
bool *import_images(struct gltf_document *document, struct arena *arena);
// Tells what was lost, and how strong lights were taken to be.
void import_report(struct gltf_document *document);

#endif
