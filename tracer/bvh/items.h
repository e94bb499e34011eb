// Padded boxes of the leaves' items. Thread safety: pure.
//
// A box is widened on all sides by two units in the last place of the primitive's largest coordinate (Ize
// 2013): a watertight test is exact for the triangle that it sees, whose edges differ from the stored ones by
// the rounding of products of the triangle's extent, even along an axis where its coordinates are 0.
#ifndef GLINT_TRACER_BVH_ITEMS_H
#define GLINT_TRACER_BVH_ITEMS_H

#include "core/vec3.h"
#include "tracer/bvh/bvh.h"

// As kernels see the numbers: rounded to float unless is_double. The pad is in units in the last place of
// that precision, and the box is rounded outward to float.
struct bvh_item bvh_triangle_item(const vec3 corners[3], bool is_double, uint32_t index);
struct bvh_item bvh_sphere_item(vec3 center, double radius, bool is_double, uint32_t index);
// Of a box that holds things of any kind.
struct bvh_item bvh_box_item(vec3 lower, vec3 upper, bool is_double, uint32_t index);
// Of a box that is already wide enough.
struct bvh_item bvh_wide_item(vec3 lower, vec3 upper, uint32_t index);
// How much wider boxes are, as a fraction of their largest coordinate.
double bvh_pad(bool is_double);

#endif
