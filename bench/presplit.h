// Triangles cut into boxes before a tree is built over them, to see what that is worth: long triangles across
// the axes have boxes that are mostly empty. Thread safety: pure.
#ifndef GLINT_BENCH_PRESPLIT_H
#define GLINT_BENCH_PRESPLIT_H

#include "bench/mesh/mesh.h"
#include "tracer/bvh/bvh.h"

// Items of all triangles, `extra` times as many besides at most (0.3: a third more): each with its triangle's
// number. Cuts go where a triangle's box is larger than the triangle (Karras and Aila 2013, section 4.4).
// NULL: no memory. The caller frees.
struct bvh_item *presplit(const struct bench_mesh *mesh, double extra, uint32_t *count);

#endif
