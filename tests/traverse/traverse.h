// The tracer's traversal of triangle trees on the processor: the buffers of shaders/gpu_scene.h, the same
// single-precision arithmetic, one ray at a time.
//
// Watertight triangle test: Woop, Benthin, Wald 2013, with all edges part of the triangle, so that it needs
// no second try in double. Of hits at one distance the lowest triangle number wins. Thread safety: pure.
#ifndef GLINT_TESTS_TRAVERSE_TRAVERSE_H
#define GLINT_TESTS_TRAVERSE_TRAVERSE_H

#include "tracer/bvh/bvh.h"
#include "tracer/gpu_word.h"

#include <stdbool.h>
#include <stdint.h>

struct traverse_scene {
    const struct gpu_word *nodes, *triangles;
};

struct traverse_ray {
    float origin[3], direction[3]; // flat units; the direction need not be of unit length
    float far;                     // hits lie before, in multiples of the direction
};

struct traverse_hit {
    float distance;      // in multiples of the direction
    float weights[3];    // of the vertices as stored; they add to about 1
    uint32_t item;       // leaf item
    uint32_t triangle;   // its number
    uint32_t nodes_read; // work that it took, and
    uint32_t items_read; // triangles tested
};

// The nearest hit; false: none (then only the work is set).
bool traverse_closest(const struct traverse_scene *scene, const struct traverse_ray *ray,
                      struct traverse_hit *hit);
// Whether there is any hit; stops at the first that it finds.
bool traverse_any(const struct traverse_scene *scene, const struct traverse_ray *ray);

// The padded box of a triangle's record in single precision, for a tree over such records.
struct bvh_item traverse_item(const struct gpu_word *words, uint32_t index);

#endif
