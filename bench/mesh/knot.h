// A tube around a (2, 3) torus knot with waves on it: closed, of any number of triangles, as a displaced scan
// is: many small triangles, all over its box. Pure functions.
#ifndef GLINT_BENCH_MESH_KNOT_H
#define GLINT_BENCH_MESH_KNOT_H

#include "core/vec3.h"

#include <stdint.h>

// Rows along the tube and columns around it; 2 * rows * columns triangles.
struct knot_grid {
    uint32_t rows, columns;
};

// At least `triangles`, and at most those of one more row.
struct knot_grid knot_grid(uint32_t triangles);
// Rows and columns beyond the last are the first again.
vec3 knot_point(struct knot_grid grid, uint32_t row, uint32_t column);
// The two triangles between a point and the next ones along and around, by the numbers of points: row *
// columns + column. Counter-clockwise seen from outside.
void knot_cell(struct knot_grid grid, uint32_t point, uint32_t triangles[2][3]);

#endif
