// The rows of binary PLY files as nearly all programs write them, with nothing to decide in the loop:
// vertices whose coordinates (and normals) are floats and that have no lists; faces with one list, whose
// length is a byte and whose items have four.
//
// The result is the same as by the general way (read_ply.c), which takes all other files, and those with a
// fault in order to report it. Ownership: the caller's arrays. Thread safety: pieces belong to one thread
// each.
#ifndef GLINT_ASSETS_PLY_PLY_PLAIN_H
#define GLINT_ASSETS_PLY_PLY_PLAIN_H

#include "assets/file/polygons.h"
#include "assets/ply/ply_rows.h"

enum {
    PLY_PLAIN_COLUMNS = 6, // x y z nx ny nz
};

struct ply_plain_vertices {
    uint32_t stride;                     // bytes of a row
    uint32_t offsets[PLY_PLAIN_COLUMNS]; // offsets in the row
    bool has_normals, is_big;
    vec3 *positions, *normals;
};

struct ply_plain_faces {
    uint32_t before, after; // bytes of a row before the list and after it
    bool is_big;
};

// Whether the rows are plain. `column_of` says for each property which column it is.
bool ply_plain_vertices(const struct ply_element *element, enum ply_form form, const uint8_t *column_of,
                        bool has_normals, struct ply_plain_vertices *out);
bool ply_plain_faces(const struct ply_element *element, enum ply_form form, uint32_t list,
                     struct ply_plain_faces *out);
// Reads rows [begin, end), which begin at `at`. false: there is a fault.
bool ply_read_plain_vertices(const struct ply_plain_vertices *plain, const char *at, size_t begin,
                             size_t end);
// The first of their corners is corners[item]; those have a normal each if `has_normals`.
bool ply_read_plain_faces(const struct ply_plain_faces *plain, const char *at, size_t begin, size_t end,
                          uint32_t vertex_count, bool has_normals, uint32_t item, struct polygons *out);

#endif
