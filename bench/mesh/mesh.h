// Large meshes for benches: generated, or read from a PLY file.
//
// Ownership: bench_mesh_finish frees. Thread safety: pure.
#ifndef GLINT_BENCH_MESH_MESH_H
#define GLINT_BENCH_MESH_MESH_H

#include <stdbool.h>
#include <stdint.h>

struct bench_mesh {
    float *positions;  // three a vertex
    uint32_t *corners; // three a triangle
    uint32_t vertex_count, triangle_count;
};

// What `word` names: the path of a PLY file (see read_ply.h) of triangles, or else at least how many
// triangles of a knot (see knot.h); `needles:N` is N long thin triangles across a cube. false: a line says on
// standard error why not, after `program`.
bool bench_mesh_open(const char *program, const char *word, struct bench_mesh *mesh);
void bench_mesh_finish(struct bench_mesh *mesh);

#endif
