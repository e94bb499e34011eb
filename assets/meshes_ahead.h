// The meshes of a scene, read in parallel before its models are loaded one after another.
//
// Only meshes that are read without any message are kept: a mesh with a fault, or with anything to report, is
// read again by assets.c, which reports it in its turn, so that messages, their order and the log of files
// are those of reading one after the other. Each mesh has the same limits as there. Texts together take at
// most 256 MiB at a time, and a mesh larger than that is left to assets.c.
//
// Errors: none; meshes that could not be read are missing. Ownership: meshes_ahead_finish frees those not
// taken. Thread safety: as assets.h; parsing uses all processors.
#ifndef GLINT_ASSETS_MESHES_AHEAD_H
#define GLINT_ASSETS_MESHES_AHEAD_H

#include "assets/loader.h"

struct meshes_ahead;

// Reads the meshes that models name and that the store does not have, if there are several. The result is in
// *out, which may be NULL, also if memory runs out and it jumps to the guards of assets_load.
void meshes_ahead_read(const struct loader *loader, struct meshes_ahead **out);
// Moves the mesh that was read from this file into *mesh; false: there is none.
bool meshes_ahead_take(struct meshes_ahead *ahead, const struct file_read *identity, struct mesh *mesh);
// NULL does nothing.
void meshes_ahead_finish(struct meshes_ahead *ahead);

#endif
