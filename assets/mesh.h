// Meshes in double precision, as their files have them: triangles in file order, with line numbers.
//
// Ownership: a mesh lives in its own arena (mesh.arena) and belongs to the asset store.
// Thread safety: immutable once loaded.
#ifndef GLINT_ASSETS_MESH_H
#define GLINT_ASSETS_MESH_H

#include "assets/file/polygons.h"
#include "core/arena.h"
#include "core/vec3.h"
#include "grammar/ir_value.h"

struct mesh_triangle {
    uint32_t corners[3]; // into positions
    uint32_t normals[3]; // into normals; IR_NO_INDEX: the file has none for this corner
    uint32_t group;      // into groups
    uint32_t line;       // the face's line in the file, from 1; in a binary file, its number
};

struct mesh {
    struct arena arena;
    str path;        // as shown to people
    vec3 *positions; // in mesh space; only those that faces use; never -0
    uint32_t position_count;
    uint32_t *merged; // per position: the lowest index of a bit-equal position
    vec3 *normals;    // unit, from the file
    uint32_t normal_count;
    struct ir_pair *coordinates; // of textures; NULL: not read (mesh_coordinates.h)
    uint32_t coordinate_count;
    uint32_t (*textured)[3]; // by triangle: into coordinates; IR_NO_INDEX: the file has none for this corner
    struct mesh_triangle *triangles;
    uint32_t triangle_count;
    struct mesh_group *groups; // each has a face
    uint32_t group_count;
    struct mesh_library *libraries;
    uint32_t library_count;
    bool is_made;        // the scene or the program describes it: no file has it
    bool is_binary;      // the file has no lines: a face's line is its number, from 1
    bool closed;         // bit-equal positions merged, every directed edge occurs as often as its opposite
    bool turned;         // a closed mesh of negative volume: `triangles` were turned outward
    double volume;       // signed, before turning; 0 if open
    uint32_t open_edges; // directed edges without their opposite
    uint32_t open_line;  // face line of the first of them
    uint32_t face_count; // polygons in the file, before triangulation
    uint32_t zero_area;  // triangles without area; kept here, dropped by flattening
    struct mesh_loss_count losses[MESH_LOSS_COUNT];
    double bent_most;   // greatest distance of a corner from its face's plane, as a share of the face's size
    uint32_t bent_line; // the face of that corner; 0: none
    vec3 lower, upper;  // bounds of the positions
};

// The word for what mesh_triangle.line counts.
static inline const char *mesh_place_word(const struct mesh *mesh) {
    return mesh->is_binary ? "face" : "line";
}
// Whether the triangle's area is not 0 (in double, without underflow).
bool mesh_has_area(const struct mesh *mesh, uint32_t triangle);

// Whether a corner of a face has no normal in the file.
bool mesh_lacks_normals(const struct mesh *mesh);

// Shading normals of smooth models: three unit vectors per triangle (corner order), 3 * triangle_count.
// A corner with a normal in the file has that; else unit face normals weighted by their angle at the
// corner are summed over all corners at bit-equal positions (Thürmer and Wüthrich 1998). Below 180 degrees of
// `crease_angle` (0..180) only those faces are summed which one reaches from the corner's own over edges at
// which normals differ by at most that, with 0.001 degrees to spare. Zero vectors if they cancel. `arena`
// owns the result.
vec3 *mesh_smooth_normals(const struct mesh *mesh, double crease_angle, struct arena *arena);

#endif
