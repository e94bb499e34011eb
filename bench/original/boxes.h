// A flat scene as the original's method reads it: triangles in file order, boxes around 64 of them each,
// rectangles apart.
//
// Ownership: original_boxes_finish frees everything; it takes zeroed boxes. Thread safety: plain data.
#ifndef GLINT_BENCH_ORIGINAL_BOXES_H
#define GLINT_BENCH_ORIGINAL_BOXES_H

#include "tracer/flatten/flatten.h"

struct original_boxes {
    struct flat_array boxes, triangles, rectangles; // layout.h; `triangles` as in shaders/gpu_scene.h
    uint32_t box_count, rectangle_count, triangle_count;
};

// What the method cannot show of the scene ("spheres"), or NULL.
const char *original_lacks(const struct flat_scene *flat);
// false: no memory; `out` may be finished all the same.
bool original_boxes_make(const struct flat_scene *flat, struct original_boxes *out);
void original_boxes_finish(struct original_boxes *boxes);

#endif
