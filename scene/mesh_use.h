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

// By mesh, in no order that means anything, and those of one mesh in the order of the bodies: for qsort.
int mesh_use_compare(const void *a, const void *b);
// The bodies of at least `triangles_least` triangles of a mesh, which are fewer than 2^32, into `uses`, which
// has room for all bodies, in that order. Returns how many there are.
uint32_t mesh_uses(const struct scene *scene, uint32_t triangles_least, struct mesh_use *uses);

#endif
