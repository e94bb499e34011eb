// Binary little-endian PLY, as scans of meshes come: positions, and faces as lists of corners; what else a
// vertex or a face has is skipped.
//
// Ownership: ply_finish frees the bytes; it takes a zeroed ply. Errors: NULL, or one line that says what is
// wrong. Thread safety: one thread a file.
#ifndef GLINT_BENCH_MESH_READ_PLY_H
#define GLINT_BENCH_MESH_READ_PLY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    PLY_PROPERTIES_MOST = 32,
};

struct ply_property {
    uint32_t count_bytes; // of the length before a list; 0: one value
    uint32_t value_bytes;
    char axis; // 'x', 'y', 'z': a position; 'i': corners; 0: another
    bool is_float;
};

struct ply_element {
    uint32_t count, property_count;
    struct ply_property properties[PLY_PROPERTIES_MOST];
};

struct ply {
    unsigned char *bytes;
    size_t size, at; // `at`: what is read next
    struct ply_element vertex, face;
};

const char *ply_open(struct ply *ply, const char *path);
void ply_finish(struct ply *ply);
// The next vertex; then, after all of them, the next face: `corners` has room for `most`. false: the file
// ends too early, or a face has more corners.
bool ply_vertex(struct ply *ply, double position[3]);
bool ply_face(struct ply *ply, uint32_t *corners, uint32_t most, uint32_t *count);

#endif
