// A polygon mesh in memory, made by the generators and written as OBJ.
//
// Positions are rounded to the decimals that the file will hold as they are added, so that what
// verify.h proves is true of the file. A vertex may carry one normal; either all do or none does.
// Polygons are planar, convex and counter-clockwise seen from outside. Ownership: a mesh owns its
// arrays and borrows the material names (string literals). When memory ends, or a
// generator cannot go on, `failed` is set and later calls do nothing. Thread safety: one thread a mesh.
#ifndef GLINT_MESHGEN_MESH_H
#define GLINT_MESHGEN_MESH_H

#include "core/strbuf.h"
#include "core/vec3.h"

#include <stddef.h>

enum {
    MESH_DECIMALS = 5,
    MESH_CORNERS_MAX = 16,
};

struct mesh_face {
    int corners[MESH_CORNERS_MAX];
    int corner_count;
    const char *material; // NULL: the file names none
};

struct mesh {
    vec3 *positions;
    vec3 *normals; // unit; NULL where the mesh has none
    int vertex_count;
    int vertex_capacity;
    struct mesh_face *faces;
    int face_count;
    int face_capacity;
    const char *material; // of the faces added from now on
    bool failed;
};

void mesh_init(struct mesh *mesh);
void mesh_finish(struct mesh *mesh);

// The new vertex's index from 0.
int mesh_vertex(struct mesh *mesh, vec3 position);
int mesh_vertex_normal(struct mesh *mesh, vec3 position, vec3 normal);

// corner_count indices, 3 to MESH_CORNERS_MAX.
void mesh_face(struct mesh *mesh, const int *corners, int corner_count);
void mesh_triangle(struct mesh *mesh, int a, int b, int c);
void mesh_quad(struct mesh *mesh, int a, int b, int c, int d);

// Triangles after cutting each polygon into a fan.
int mesh_triangle_count(const struct mesh *mesh);

// Normal of a face (not unit: its length is twice the area), by Newell's sum over the edges.
vec3 mesh_face_normal(const struct mesh *mesh, const struct mesh_face *face);

// Appends the OBJ text. `title` becomes the first comment line; `mtllib` names the material file or is NULL.
void mesh_write_obj(const struct mesh *mesh, const char *title, const char *mtllib, struct strbuf *text);

#endif
