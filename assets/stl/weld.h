// Positions in single precision to vertices: equal ones get one number, in the order of where they first
// come.
//
// A corner is sought among those of the facet before, with which most facets share an edge, and then in a
// hash table with open addressing, whose slots hold the positions themselves, so that to look one up takes
// one place in memory (join.h is for the doubles of text, and needs two). Ownership: all is in the arena,
// which must be guarded. Thread safety: one table belongs to one thread.
#ifndef GLINT_ASSETS_STL_WELD_H
#define GLINT_ASSETS_STL_WELD_H

#include "assets/file/polygons.h"
#include "core/arena.h"

enum {
    WELD_FACETS = 16, // at once
    WELD_FLOATS = 9,  // of a facet
    WELD_CORNERS = 3,
};

// Facets whose places in the table have been asked for. Of the facet before them, and of theirs:
struct weld_batch {
    float positions[WELD_FLOATS * (WELD_FACETS + 1)];
    uint64_t hashes[WELD_CORNERS * (WELD_FACETS + 1)];
    uint32_t links[WELD_CORNERS * (WELD_FACETS + 1)]; // how many corners before is the same one; 0: unknown
    struct polygon_corner *corners;                   // theirs
    uint32_t count;
};

struct weld {
    struct arena *arena;
    struct polygons *out;         // its vertices are the result
    uint64_t *slots;              // the vertex plus 1, and above it half of the hash; 0: free
    uint32_t slot_count;          // a power of two
    struct weld_batch batches[2]; // that being filled, and the one before it
    unsigned filling;
};

// For about so many different positions; more are not a fault.
void weld_init(struct weld *weld, struct arena *arena, struct polygons *out, uint32_t expected);
// Where the positions of the next WELD_FACETS facets belong, none of them -0 or NaN.
float *weld_room(struct weld *weld);
// So many facets are there, whose corners, which are after those of the facets before, get their vertices: at
// the latest by weld_finish, since the table's places are in memory only a while after they were asked for.
void weld_facets(struct weld *weld, uint32_t count, struct polygon_corner *corners);
// Gives the table back. The vertices lose the room that was kept for more, if that is little.
void weld_finish(struct weld *weld);

#endif
