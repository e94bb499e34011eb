// Positions in single precision to vertices: equal ones get the same number, in the order of first
// occurrence.
//
// A corner is searched for in the facet before, with which most facets share an edge, and then in a hash
// table with open addressing, whose slots hold the positions themselves, so that a lookup touches one place
// in memory (join.h, for the doubles of text, touches two). Ownership: everything is in the arena, which must
// be guarded. Thread safety: one table belongs to one thread.
#ifndef GLINT_ASSETS_STL_WELD_H
#define GLINT_ASSETS_STL_WELD_H

#include "assets/file/polygons.h"
#include "core/arena.h"

enum {
    WELD_FACETS = 16, // at once
    WELD_FLOATS = 9,  // of a facet
    WELD_CORNERS = 3,
};

// Facets whose places in the table have been prefetched. For the facet before them, and for them:
struct weld_batch {
    float positions[WELD_FLOATS * (WELD_FACETS + 1)];
    uint64_t hashes[WELD_CORNERS * (WELD_FACETS + 1)];
    uint32_t links[WELD_CORNERS * (WELD_FACETS + 1)]; // how many corners back the same corner is; 0: unknown
    struct polygon_corner *corners;                   // theirs
    uint32_t count;
};

struct weld {
    struct arena *arena;
    struct polygons *out;         // its vertices are the result
    uint64_t *slots;              // the vertex plus 1, and above it half of the hash; 0: free
    uint32_t slot_count;          // a power of two
    struct weld_batch batches[2]; // the one being filled, and the one before it
    unsigned filling;
};

// For about this many different positions; more are allowed.
void weld_init(struct weld *weld, struct arena *arena, struct polygons *out, uint32_t expected);
// Where to put the positions of the next WELD_FACETS facets, none of them -0 or NaN.
float *weld_room(struct weld *weld);
// This many facets are now there; their corners, which follow those of earlier facets, get their vertices by
// weld_finish at the latest, since the table's places arrive only some time after they are prefetched.
void weld_facets(struct weld *weld, uint32_t count, struct polygon_corner *corners);
// Frees the table. The vertices lose their spare room, if that is little.
void weld_finish(struct weld *weld);

#endif
