// Padded boxes of what the leaves hold. Thread safety: pure.
//
// A box is widened on all sides by two units in the last place of the primitive's largest coordinate
// (Ize 2013): a watertight test answers for the triangle that it sees, whose edges lie off the stored ones
// by the rounding of products of the triangle's extent, also across an axis where its coordinates are 0.
#ifndef GLINT_TRACER_BVH_ITEMS_H
#define GLINT_TRACER_BVH_ITEMS_H

#include "tracer/bvh/bvh.h"

// `words`: TRIANGLE_WORDS of a triangle, SPHERE_WORDS of a sphere, finite.
struct bvh_item bvh_triangle_item(const struct gpu_word *words, uint32_t index);
struct bvh_item bvh_sphere_item(const struct gpu_word *words, uint32_t index);
// The same of records in double precision: the pad is by their ulp, the box rounded outward to float.
struct bvh_item bvh_triangle64_item(const struct gpu_word *words, uint32_t index);
struct bvh_item bvh_sphere64_item(const struct gpu_word *words, uint32_t index);

#endif
