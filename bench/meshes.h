// Large meshes for benches: generated, or read from a PLY file.
//
// Ownership: bench_mesh_finish frees. Thread safety: pure.
#ifndef GLINT_BENCH_MESHES_H
#define GLINT_BENCH_MESHES_H

#include <stdbool.h>
#include <stdint.h>

struct bench_mesh {
    float *positions;  // three a vertex
    uint32_t *corners; // three a triangle
    uint32_t vertex_count, triangle_count;
};

// What `word` names: the path of a PLY file (binary, little endian, vertices that begin with three floats and
// have no more, faces of three corners), or else about how many triangles of a closed knot with waves on it,
// as a displaced scan is: many small triangles, all over its box; `needles:N` is N long thin triangles across
// a cube. false: a line says on standard error why
// not, after `program`.
bool bench_mesh_open(const char *program, const char *word, struct bench_mesh *mesh);
void bench_mesh_finish(struct bench_mesh *mesh);

#endif
