// The surface that a path in the half plane of radius and height sweeps about the y axis.
//
// Input: a checked path, of radii of at least 0, that neither crosses nor touches itself. Output: a shell,
// closed if the path is a ring or both of its ends are on the axis. Thread safety: as made.h.
#ifndef GLINT_ASSETS_MADE_REVOLVE_H
#define GLINT_ASSETS_MADE_REVOLVE_H

#include "assets/made/path.h"

struct revolve {
    const struct path *path; // u: radius, v: y
    bool is_ring;            // the last piece joins the first
    double angle;            // degrees
    uint32_t columns;
};

// The number of columns whose chords are at most `share` of the radius inside the circle.
uint32_t revolve_columns(double angle, double share);
bool revolve_build(const struct revolve *revolve, const struct made_to *to, struct made *out);

#endif
