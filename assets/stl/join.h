// Positions to vertices: equal ones get one number.
//
// A hash table with open addressing. Ownership: all is in the arena, which must be guarded.
// Thread safety: one table belongs to one thread.
#ifndef GLINT_ASSETS_STL_JOIN_H
#define GLINT_ASSETS_STL_JOIN_H

#include "assets/file/polygons.h"
#include "core/arena.h"

struct join {
    struct arena *arena;
    struct polygons *out; // its vertices are the result
    uint32_t *slots;      // index plus 1
    uint32_t slot_count;  // a power of two
};

// For about so many different positions; more are no fault.
void join_init(struct join *join, struct arena *arena, struct polygons *out, uint32_t expected);
// The number of the vertex at this position, which is added if it is new. No part of it is -0.
uint32_t join_vertex(struct join *join, vec3 position);

#endif
