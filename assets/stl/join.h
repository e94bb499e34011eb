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

// For about so many different positions; more are not a fault.
void join_init(struct join *join, struct arena *arena, struct polygons *out, uint32_t expected);
// The numbers of the vertices at these positions, in turn; those that are new are added. No part of them is
// -0. Many at once are faster than one: where they are in memory is asked for before it is needed.
void join_vertices(struct join *join, const vec3 *positions, uint32_t count, uint32_t *numbers);

#endif
