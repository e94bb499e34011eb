// Positions to vertices: equal ones get the same number.
//
// A hash table with open addressing. Ownership: everything is in the arena, which must be guarded. Thread
// safety: one table belongs to one thread.
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

// For about this many different positions; more are allowed.
void join_init(struct join *join, struct arena *arena, struct polygons *out, uint32_t expected);
// The numbers of the vertices at these positions, in order; new ones are added. No component is -0. Many at
// once are faster than one by one: their places in memory are prefetched.
void join_vertices(struct join *join, const vec3 *positions, uint32_t count, uint32_t *numbers);

#endif
