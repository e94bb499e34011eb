// The contents of a mesh file as the file has them: the polygons that every reader makes from its format,
// before they become triangles (assets/mesh_build.h).
//
// Units: those of the file; texture coordinates go to the right and upwards, an image from 0 to 1. Ownership:
// everything is in one arena and may point into the file's text. Thread safety: plain data.
#ifndef GLINT_ASSETS_FILE_POLYGONS_H
#define GLINT_ASSETS_FILE_POLYGONS_H

#include "core/str.h"
#include "core/vec3.h"
#include "grammar/ir_value.h"

// The faces of one `usemtl` name (or of none: an empty name), in the order of their first face. Their
// material depends on the model: struct assets_model.
struct mesh_group {
    str name;
    uint32_t line; // of the first `usemtl` of this name; 0 for the empty name
};

// A `mtllib` line: one name, or several.
struct mesh_library {
    str names; // the text after the word, trimmed
    uint32_t line;
};

// Contents of a mesh file that no picture shows as they are.
enum mesh_loss {
    MESH_LOSS_NOT_FACES, // points, lines, curves and surfaces
    MESH_LOSS_COLORS,    // of vertices
    MESH_LOSS_IMAGES,    // of faces
    MESH_LOSS_SCANNED,   // colours of vertices or faces, in formats whose programs write them unasked
    MESH_LOSS_REST,      // bytes after the last face
    MESH_LOSS_BENT,      // faces that are not flat
    MESH_LOSS_NORMALS,   // corners of faces whose normal has length 0
    MESH_LOSS_COUNT
};

struct mesh_loss_count {
    uint32_t count;
    uint32_t line; // of the first; 0: of the whole file
};

static inline void mesh_lose(struct mesh_loss_count *losses, enum mesh_loss what, uint32_t line) {
    if (losses[what].count++ == 0)
        losses[what].line = line;
}

struct polygon_corner {
    uint32_t vertex; // into vertices
    uint32_t normal; // into normals; IR_NO_INDEX: none
};

struct polygon_face {
    uint32_t first; // into corners; the next face's first ends it
    uint32_t line;
    uint32_t group; // into groups
};

struct polygons {
    struct {
        vec3 *items;
        uint32_t count, capacity;
    } vertices;
    struct {
        vec3 *items;
        uint32_t count, capacity;
    } normals; // as written, not unit
    struct {
        struct polygon_corner *items;
        uint32_t count, capacity;
    } corners;
    struct {
        struct polygon_face *items;
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
    bool is_joined;                                 // no two vertices are at the same position
    bool is_binary;                                 // a line is the number of a face, from 1
    uint64_t triangle_count;                        // how many triangles the faces will give
    struct mesh_loss_count losses[MESH_LOSS_COUNT]; // losses that have lines of their own
};

// Texture coordinates, read separately and only if an image needs them.
struct textured_corner {
    uint32_t vertex;     // as in polygons
    uint32_t coordinate; // into coordinates; IR_NO_INDEX: none
};

struct textured_faces {
    uint32_t vertex_count;
    struct {
        struct ir_pair *items;
        uint32_t count, capacity;
    } coordinates;
    struct {
        struct textured_corner *items;
        uint32_t count, capacity;
    } corners;
    struct {
        uint32_t *items; // the first corner of each, in the order of the polygons
        uint32_t count, capacity;
    } faces;
};

#define MESH_COORDINATE_MAX 1e18 // the largest that a vertex may have

#endif
