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

// Reads file->text. Faults are counted in file->errors; after one the result must not be used.
void read_obj(struct asset_file *file, struct arena *scratch, struct obj *out);

#endif
