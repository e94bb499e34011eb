// Wavefront OBJ: text to polygons, as the file has them.
//
// Read: v (three numbers), vn, f (v, v/vt, v//vn, v/vt/vn; negative indices; vertices that follow later),
// usemtl, mtllib. Ignored: vt, vp, o, g, s and the like. Counted as losses: colours of vertices, images of
// faces; points, lines, curves and surfaces. Every fault is reported, at its place. Ownership:
// everything is in the scratch arena and points into the text. Thread safety: one call belongs to one thread.
#ifndef GLINT_ASSETS_READ_OBJ_H
#define GLINT_ASSETS_READ_OBJ_H

#include "assets/asset_file.h"
#include "assets/mesh.h"

struct obj_corner {
    uint32_t vertex; // into vertices
    uint32_t normal; // into normals; IR_NO_INDEX: none
};

struct obj_face {
    uint32_t first; // into corners; the next face's first ends it
    uint32_t line;
    uint32_t group; // into groups
};

struct obj {
    struct {
        vec3 *items;
        uint32_t count, capacity;
    } vertices;
    struct {
        vec3 *items;
        uint32_t count, capacity;
    } normals; // as written, not unit
    struct {
        struct obj_corner *items;
        uint32_t count, capacity;
    } corners;
    struct {
        struct obj_face *items;
        uint32_t count, capacity;
    } faces;
    struct {
        struct mesh_group *items;
        uint32_t count, capacity;
    } groups;
    struct {
        struct mesh_library *items;
        uint32_t count, capacity;
    } libraries;
    uint64_t triangle_count;                        // that the faces will give
    struct mesh_loss_count losses[MESH_LOSS_COUNT]; // of what is in lines of their own
};

#define OBJ_COORDINATE_MAX 1e18 // the largest that a vertex may have

// Reads file->text, on all processors. Faults are counted in file->errors; after one the result must not be
// used.
void read_obj(struct asset_file *file, struct arena *scratch, struct obj *out);

// The two ways in which it does, with the same result to the bit; for tests and benches.
// By one thread, from the first line to the last.
void read_obj_in_order(struct asset_file *file, struct arena *scratch, struct obj *out);
// In pieces of about so many bytes, at least 1, on all processors. false: the file has something that only
// the other way understands or reports, and nothing was reported.
bool read_obj_in_chunks(struct asset_file *file, struct arena *scratch, size_t chunk_bytes, struct obj *out);

#endif
