// Which nodes of a glTF file are shown again, with all that is below them: what becomes an object of the
// scene.
//
// Two nodes are of one kind if they show the same, and nodes of the same kinds stand below them in the same
// places. A kind is an object if it is met twice or more in what is written, an object counting once; if it
// has two bodies, or one that is below; and if it can be placed by an instance: with no camera, and with
// ordinary scales.
//
// Ownership: the arena. Thread safety: one thread.
#ifndef GLINT_LOAD_IMPORT_REPEATED_H
#define GLINT_LOAD_IMPORT_REPEATED_H

#include "assets/gltf/gltf.h"
#include "core/limits.h"

bool import_has_faces(const struct gltf *gltf, uint32_t mesh);
// By node: its kind, from 1, if that is an object; else 0.
const uint32_t *import_repeated(const struct gltf *gltf, const struct limits *limits, struct arena *arena);

#endif
