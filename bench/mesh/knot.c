#include "bench/mesh/knot.h"

#include <string.h>

struct knot_grid knot_grid(uint32_t triangles) {
    const uint32_t columns = (uint32_t)sqrt(triangles / 16.0) + 3;
    const uint32_t around = 2 * columns, rows = (triangles + around - 1) / around;
    return (struct knot_grid){rows < 3 ? 3 : rows, columns};
}

vec3 knot_point(struct knot_grid grid, uint32_t row, uint32_t column) {
    const double turn = 6.283185307179586;
    const double s = turn * (row % grid.rows) / grid.rows;
    const double t = turn * (column % grid.columns) / grid.columns;
    const double radius = 0.2 + 0.02 * sin(31 * s) * cos(7 * t) + 0.004 * sin(211 * s + 13 * t);
    const double out = 0.6 + 0.25 * cos(3 * s) + radius * cos(t);
    return (vec3){out * cos(2 * s), 0.25 * sin(3 * s) + radius * sin(t), out * sin(2 * s)};
}

void knot_cell(struct knot_grid grid, uint32_t point, uint32_t triangles[2][3]) {
    const uint32_t row = point / grid.columns, column = point % grid.columns;
    const uint32_t next = (row + 1) % grid.rows * grid.columns, right = (column + 1) % grid.columns;
    const uint32_t a = point, b = next + column, c = next + right, d = row * grid.columns + right;
    const uint32_t both[2][3] = {{a, c, b}, {a, d, c}};
    memcpy(triangles, both, sizeof both);
}
