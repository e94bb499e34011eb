// Flat shapes bounded by lines and arcs, and their triangles.
//
// A shape is one outer contour, counter-clockwise, and any holes, clockwise: the inside lies left of the
// way. Contours are polylines; arcs are cut where they are added. Sizes are fixed: an outline that passes
// OUTLINE_POINTS_MAX is a programmer's mistake. Thread safety: one thread an outline.
#ifndef GLINT_MESHGEN_OUTLINE_H
#define GLINT_MESHGEN_OUTLINE_H

enum {
    OUTLINE_POINTS_MAX = 512,
    OUTLINE_CONTOURS_MAX = 4,
    OUTLINE_TRIANGLES_MAX = OUTLINE_POINTS_MAX + 2 * OUTLINE_CONTOURS_MAX,
};

typedef struct {
    double x, y;
} vec2;

struct outline {
    vec2 points[OUTLINE_POINTS_MAX];
    int starts[OUTLINE_CONTOURS_MAX + 1]; // contour c holds points starts[c] to starts[c + 1] - 1
    int contour_count;
};

void outline_init(struct outline *outline);

// Adds points to the contour that is open; a point where the last one stands is left out.
void outline_point(struct outline *outline, double x, double y);
// Angles in degrees, counter-clockwise from +x where to_deg is the larger, else clockwise.
void outline_arc(struct outline *outline, vec2 centre, double radius, double from_deg, double to_deg);
// Ends the contour; a last point where its first one stands is left out.
void outline_close(struct outline *outline);

// The point after i, or before it, round the contour of i.
int outline_next(const struct outline *outline, int i);
int outline_previous(const struct outline *outline, int i);

// Unit normal, to the outside, of the edge from point i to the next.
vec2 outline_edge_normal(const struct outline *outline, int i);

// Which way, and how far for an inset of 1, point i moves when every edge moves inward by the same amount.
vec2 outline_inset_direction(const struct outline *outline, int i);

// Cuts the shape with points moved inward by `inset` into triangles of point indices, counter-clockwise, by
// ear clipping; holes are joined to the outside first. Returns their number, -1 where the shape cannot
// be cut (it crosses itself).
int outline_triangulate(const struct outline *outline, double inset, int triangles[][3]);

#endif
