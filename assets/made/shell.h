// The surface of a made body while it grows: vertices, normals, texture coordinates and faces.
//
// Ownership: everything is in to->arena. Thread safety: one shell belongs to one thread.
#ifndef GLINT_ASSETS_MADE_SHELL_H
#define GLINT_ASSETS_MADE_SHELL_H

#include "assets/made/made.h"
#include "assets/made/plane.h"

struct shell {
    const struct made_to *to;
    struct made *out;
};

struct shell_corner {
    uint32_t vertex, normal, coordinate;
};

// For this many faces and corners, which may not be exceeded.
void shell_begin(struct shell *shell, const struct made_to *to, struct made *out, uint64_t faces,
                 uint64_t corners);
uint32_t shell_vertex(struct shell *shell, vec3 at);
uint32_t shell_normal(struct shell *shell, vec3 normal);
uint32_t shell_coordinate(struct shell *shell, double u, double v);
// Where `count` points are in their box, from 0 to 1 along both sides; returns the first.
uint32_t shell_box_coordinates(struct shell *shell, const struct plane_box *box, const struct ir_pair *points,
                               uint32_t count);
// A face of `count` corners, counter-clockwise as seen from outside.
void shell_face(struct shell *shell, const struct shell_corner *corners, uint32_t count);
// The last step: sets the counts of triangles and vertices.
void shell_end(struct shell *shell);

#endif
