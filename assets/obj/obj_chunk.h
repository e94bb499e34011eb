// Pieces of an OBJ file, for threads: whole lines, first counted, then read into their final places.
//
// Only ordinary lines are understood: `v`, `vn` and `f` without a fault, lines without effect, and other
// lines, which are only noted. A piece with anything else (a fault, a continued line, lines that end with \r,
// an index of more than ten digits) is not ordinary, and its file is left to the sequential reader, which
// reports. Thread safety: a chunk belongs to one thread; threads write to different parts of the arrays.
#ifndef GLINT_ASSETS_OBJ_OBJ_CHUNK_H
#define GLINT_ASSETS_OBJ_OBJ_CHUNK_H

#include "assets/obj/read_obj.h"

struct obj_counts {
    uint32_t vertices, normals, corners, faces;
    uint32_t others; // lines that may have an effect, besides vertices, normals and faces
    uint32_t lines;
};

// One of the others.
struct obj_other {
    const char *at; // its first word
    uint32_t line;
    uint32_t faces; // of the file, before it
};

struct obj_chunk {
    const char *begin, *end;
    bool is_ordinary;
    struct obj_counts here;   // by obj_chunk_count
    struct obj_counts before; // counts of all chunks before; set by the caller
    // By obj_chunk_read:
    uint64_t triangles;
    bool refers_forward; // as the sequential reader notes it
    struct mesh_loss_count colors;
};

void obj_chunk_count(struct obj_chunk *chunk);
// Fills the chunk's parts of the arrays of `obj` and of `others`; all faces get group 0. A face has up to
// `corners_most` corners. Where the chunk is not ordinary, its parts mean nothing.
void obj_chunk_read(struct obj_chunk *chunk, uint64_t corners_most, struct polygons *obj,
                    struct obj_other *others);

#endif
