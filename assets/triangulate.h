// Polygons to triangles.
//
// A polygon of n corners always becomes n - 2 triangles that use only its corners, in its own sense of
// rotation, so that a mesh closed in polygons is closed in triangles. Convex polygons become fans; others are
// cut by ear clipping (Meisters 1975; the reflex corners in a grid) in the plane of the largest component of
// Newell's normal. Corners that repeat a position, collinear ones, and polygons that touch or cross
// themselves are cut as well as possible; work is bounded by a multiple of n.
// Thread safety: one triangulator belongs to one thread. Results depend only on the positions.
#ifndef GLINT_ASSETS_TRIANGULATE_H
#define GLINT_ASSETS_TRIANGULATE_H

#include "core/arena.h"
#include "core/vec3.h"

#include <stdint.h>

struct triangulate_link;
struct triangulate_point;

struct triangulator {
    struct arena *arena; // for memory that is reused from polygon to polygon
    uint32_t capacity;   // corners
    struct triangulate_point *points;
    struct triangulate_link *links;
    uint32_t *cell_first; // the grid: for each cell the first of its entries in cell_items
    uint32_t *cell_items;
    uint32_t *queue;
    uint64_t work_left;
};

void triangulate_init(struct triangulator *t, struct arena *arena);
// Corner numbers of the n - 2 triangles into `out` (3 * (n - 2)); n is at least 3.
void triangulate(struct triangulator *t, const vec3 *corners, uint32_t n, uint32_t *out);

#endif
