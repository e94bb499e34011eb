// Which bodies show which mesh: those of one mesh are neighbours in a list.
//
// Input: a scene whose bodies are built. Output: the list; its memory is the caller's. Errors: none. Thread
// safety: pure.
#ifndef GLINT_SCENE_MESH_USE_H
#define GLINT_SCENE_MESH_USE_H

#include <stdint.h>

struct mesh;
struct scene;

struct mesh_use {
    const struct mesh *mesh;
    uint32_t body; // its place in the scene's bodies
};

// For qsort: by mesh, in an arbitrary order, and within a mesh in the order of the bodies.
int mesh_use_compare(const void *a, const void *b);
// Writes the bodies whose mesh has at least `triangles_least` triangles, fewer than 2^32 bodies, to `uses` in
// that order; it has room for all bodies. Returns how many there are.
uint32_t mesh_uses(const struct scene *scene, uint32_t triangles_least, struct mesh_use *uses);

#endif
